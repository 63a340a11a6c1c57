// Makes pictures of any size; pictures larger than a drawing buffer are drawn in tiles.
import { Vector2, type PerspectiveCamera, type WebGLRenderer } from "three";

const tile = 2048; // pixels; every WebGL 2 has it

// Columns of a picture, on the screen or saved; show() makes the shapes of these columns visible.
export interface Part {
  left: number; // pixels
  width: number;
  show: () => void;
}

interface Wish {
  renderer: WebGLRenderer;
  camera: PerspectiveCamera;
  width: number;
  height: number;
  parts: readonly Part[]; // side by side, as wide as all
  draw: () => void;
}

// Returns a PNG of width times height pixels with a transparent
// background. Restores size and camera; the canvas must be drawn again.
export async function takePicture({ renderer, camera, width, height, parts, draw }: Wish): Promise<Blob> {
  const page = document.createElement("canvas");
  page.width = width;
  page.height = height;
  const paper = page.getContext("2d");
  if (!paper) throw new Error("this browser cannot make a picture");
  const size = renderer.getSize(new Vector2());
  const ratio = renderer.getPixelRatio();
  const aspect = camera.aspect;
  renderer.setPixelRatio(1);
  renderer.setScissorTest(false);
  for (const part of parts) {
    part.show();
    camera.aspect = part.width / height;
    for (let y = 0; y < height; y += tile) {
      for (let x = 0; x < part.width; x += tile) {
        const w = Math.min(tile, part.width - x);
        const h = Math.min(tile, height - y);
        renderer.setSize(w, h, false);
        renderer.setViewport(0, 0, w, h);
        camera.setViewOffset(part.width, height, x, y, w, h);
        draw();
        paper.drawImage(renderer.domElement, part.left + x, y);
      }
    }
  }
  camera.clearViewOffset();
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
  renderer.setPixelRatio(ratio);
  renderer.setSize(size.x, size.y);
  return new Promise((done, fail) => {
    page.toBlob((blob) => (blob ? done(blob) : fail(new Error("the picture is too large"))));
  });
}
