// Forwards the pointer on the canvas to the tool of a panel, or to the camera.
import type { Touch } from "./shape";

export type PointerKind = "down" | "move" | "up" | "leave";
// Returns true if the tool uses the pointer, so that the camera does not
// move. `touch` searches the touched point of the shape only when called.
export type PointerTool = (kind: PointerKind, touch: () => Touch | null, event: PointerEvent) => boolean;

interface Canvas {
  tool: () => PointerTool | null;
  touch: (event: PointerEvent) => Touch | null;
  camera: (on: boolean) => void;
}

export function listenToPointer(canvas: HTMLCanvasElement, { tool, touch, camera }: Canvas): void {
  let taken = false;
  const tell = (kind: PointerKind) => (event: PointerEvent) => {
    const turning = kind === "move" && event.buttons !== 0 && !taken;
    const otherButton = kind === "down" && event.pointerType === "mouse" && event.button > 0;
    const use = tool();
    if (!use || turning || otherButton) return;
    const wants = use(kind, () => (kind === "leave" ? null : touch(event)), event);
    if (kind === "down" && wants) {
      taken = true;
      camera(false);
      canvas.setPointerCapture(event.pointerId);
    }
    if (kind === "up") {
      taken = false;
      camera(true);
    }
  };
  canvas.addEventListener("pointerdown", tell("down"));
  canvas.addEventListener("pointermove", tell("move"));
  canvas.addEventListener("pointerup", tell("up"));
  canvas.addEventListener("pointercancel", tell("up"));
  canvas.addEventListener("pointerleave", tell("leave"));
  // The wheel with Alt changes the brush.
  canvas.addEventListener("wheel", (event) => event.altKey && event.stopImmediatePropagation());
}
