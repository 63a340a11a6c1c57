// The canvas: one or two shapes, light, camera, rings. Only this folder uses three.js.
import { signal } from "@preact/signals";
import CameraControls from "camera-controls";
import {
  AmbientLight,
  Box3,
  DirectionalLight,
  Matrix4,
  PerspectiveCamera,
  Plane,
  Quaternion,
  Raycaster,
  Scene,
  Sphere,
  Spherical,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderer,
} from "three";
import type { Rgb } from "../geometry/colors";
import { mapColors, type Range } from "../geometry/colors";
import { ballAround } from "../geometry/normals";
import { views, type Up, type ViewName } from "../geometry/up";
import type { Surface } from "../protocol";
import { Markers, ringFrame, type Ring } from "./markers";
import { takePicture, type Part } from "./picture";
import { listenToPointer, type PointerTool } from "./pointer";
import {
  disposeShape,
  dropSeams,
  makeShape,
  markFaces,
  moveShape,
  moveSome,
  paintLabels,
  paintOne,
  setOpacity,
  touchShape,
  type Shape,
  type Touch,
} from "./shape";
import { axisOf, sightOf, type Sight } from "./sight";

CameraControls.install({
  THREE: {
    Box3,
    Matrix4,
    Quaternion,
    Raycaster,
    Sphere,
    Spherical,
    Vector2,
    Vector3,
    Vector4,
  },
});

export type Which = "main" | "other";
export type Layout = "one" | "side" | "over"; // "side": other left, main right; "over": both at one place

const fieldOfView = 32; // degrees; chosen: weak perspective
// Slightly above the equator, as in pictures of the program.
const firstLook = { azimuth: Math.PI / 6, polar: 0.4 * Math.PI };

export class NoWebGlError extends Error {}

export class View {
  pointer: PointerTool | null = null;
  readonly sight = signal<Sight | null>(null);
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.01, 100);
  private readonly controls: CameraControls;
  private readonly markers = new Markers();
  private readonly watch: ResizeObserver;
  private shapes: Record<Which, Shape | null> = { main: null, other: null };
  private layout: Layout = "one";
  private dirty = true;
  private moving = true;
  private ended = false;
  private waiting: (() => void)[] = [];
  private last = performance.now();

  // Throws NoWebGlError if the browser has no WebGL 2.
  constructor(private readonly host: HTMLElement) {
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true });
    } catch (error) {
      throw new NoWebGlError("This browser has no WebGL 2.", { cause: error });
    }
    const canvas = this.renderer.domElement;
    canvas.setAttribute("role", "img");
    canvas.tabIndex = 0;
    host.append(canvas);
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    const key = new DirectionalLight(0xffffff, 2.7);
    key.position.set(-0.6, 0.9, 1);
    this.camera.add(key);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1), this.markers.group);
    // Added before the camera listens to the same events.
    listenToPointer(canvas, {
      tool: () => this.pointer,
      touch: (event) => this.touch(event),
      camera: (on) => (this.controls.enabled = on),
    });
    this.camera.up.set(0, 0, 1);
    this.controls = new CameraControls(this.camera, canvas);
    void this.controls.rotateTo(firstLook.azimuth, firstLook.polar, false);
    this.controls.smoothTime = 0.08;
    this.controls.draggingSmoothTime = 0.02;
    this.controls.dollyToCursor = true;
    this.watch = new ResizeObserver(() => this.resize());
    this.watch.observe(host);
    this.resize();
    requestAnimationFrame(() => this.frame());
  }

  // Shows a surface, or removes it. The camera does not move.
  show(which: Which, surface: Surface | null): void {
    const before = this.shapes[which];
    if (before) {
      this.scene.remove(before.group);
      disposeShape(before);
    }
    const shape = surface && makeShape(surface);
    this.shapes[which] = shape;
    if (shape) this.scene.add(shape.group);
    this.dirty = true;
  }

  has(which: Which): boolean {
    return this.shapes[which] !== null;
  }

  surface(which: Which): Surface | null {
    return this.shapes[which]?.surface ?? null;
  }

  move(positions: Float32Array, normals: Float32Array | null): void {
    this.change("main", (shape) => moveShape(shape, positions, normals));
  }

  // Moves these vertices; all others are where the surface has them.
  moveSome(indices: Uint32Array, positions: Float32Array): void {
    this.change("main", (shape) => moveSome(shape, indices, positions));
  }

  paint(which: Which, color: Rgb): void {
    this.recolor(which, (shape) => paintOne(shape, color));
  }

  // Colours the vertices by values.
  paintValues(range: Range, values: ArrayLike<number>): void {
    this.recolor("main", (shape) => mapColors(range, values, shape.colors.array as Float32Array));
  }

  // Lets `fill` write colours [n, 3].
  paintBy(which: Which, fill: (colors: Float32Array) => void): void {
    this.recolor(which, (shape) => fill(shape.colors.array as Float32Array));
  }

  // Paints one colour per label of vertices.
  paintLabels(labels: Uint32Array): void {
    this.recolor("main", (shape) => paintLabels(shape, labels));
  }

  mark(faces: Uint32Array | null): void {
    this.change("main", (shape) => markFaces(shape, faces));
  }

  arrange(layout: Layout, opacity = 1): void {
    this.layout = layout;
    this.change("other", (shape) => setOpacity(shape, opacity));
    this.resize();
  }

  rings(rings: readonly Ring[]): void {
    this.markers.show(rings);
    this.dirty = true;
  }

  // Brings all shapes into view, without turning the camera.
  fit(smoothly = true): void {
    const { main, other } = this.shapes;
    const balls = [main, this.layout === "over" ? other : null].flatMap((shape) => shape?.ball ?? []);
    const { center, radius } = ballAround(balls);
    this.camera.near = radius / 100;
    this.camera.far = radius * 100;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = radius / 20;
    this.controls.maxDistance = radius * 50;
    void this.controls.fitToSphere(new Sphere(new Vector3(...center), radius * 1.05), smoothly);
    this.dirty = true;
  }

  // Sets the axis that points up on the screen, and resets the direction of the camera.
  setUp(up: Up): void {
    this.camera.up.copy(axisOf(up));
    this.controls.updateCameraUp();
    void this.controls.rotateTo(firstLook.azimuth, firstLook.polar, false);
    this.dirty = true;
  }

  // Looks from the front, from above and so on.
  lookFrom(wanted: ViewName): void {
    const found = views.find(([name]) => name === wanted);
    if (!found) return;
    this.controls.normalizeRotations();
    void this.controls.rotateTo(found[2], found[3], true);
  }

  turn(azimuth: number, polar: number): void {
    void this.controls.rotate(azimuth, polar, true);
  }

  zoom(factor: number): void {
    void this.controls.dollyTo(this.controls.distance / factor, true);
  }

  describe(text: string): void {
    this.renderer.domElement.setAttribute("aria-label", text);
  }

  // True while the camera moves, or the current state is not drawn yet.
  get busy(): boolean {
    return this.dirty || this.waiting.length > 0 || this.moving;
  }

  // Resolves when the next frame is on its way to the screen.
  drawn(): Promise<void> {
    this.dirty = true;
    return new Promise((done) => this.waiting.push(done));
  }

  picture(width: number, height: number): Promise<Blob> {
    const { renderer, scene, camera } = this;
    const draw = () => renderer.render(scene, camera);
    const parts = this.parts(width);
    this.dirty = true;
    return takePicture({ renderer, camera, width, height, parts, draw });
  }

  // Returns the pointer's angle (radians) and distance from the ring's centre, in the ring's plane.
  inPlane(ring: Ring, event: PointerEvent): { angle: number; distance: number } | null {
    const normal = new Vector3(...ring.normal).normalize();
    const plane = new Plane().setFromNormalAndCoplanarPoint(normal, new Vector3(...ring.center));
    const at = this.caster(event).ray.intersectPlane(plane, new Vector3());
    if (!at) return null;
    at.sub(new Vector3(...ring.center)).applyQuaternion(ringFrame(ring).invert());
    return { angle: Math.atan2(at.y, at.x), distance: Math.hypot(at.x, at.y) };
  }

  dispose(): void {
    this.ended = true;
    this.watch.disconnect();
    this.show("main", null);
    this.show("other", null);
    this.markers.dispose();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.domElement.remove();
  }

  private change(which: Which, work: (shape: Shape) => void): void {
    const shape = this.shapes[which];
    if (!shape) return;
    work(shape);
    this.dirty = true;
  }

  private recolor(which: Which, work: (shape: Shape) => void): void {
    this.change(which, (shape) => {
      dropSeams(shape);
      work(shape);
      shape.colors.needsUpdate = true;
    });
  }

  private caster(event: PointerEvent): Raycaster {
    const box = this.renderer.domElement.getBoundingClientRect();
    const side = this.layout === "side";
    const width = side ? box.width / 2 : box.width;
    const left = side && event.clientX - box.left > width ? box.left + width : box.left;
    const caster = new Raycaster();
    const x = (2 * (event.clientX - left)) / width - 1;
    caster.setFromCamera(new Vector2(x, 1 - (2 * (event.clientY - box.top)) / box.height), this.camera);
    return caster;
  }

  private touch(event: PointerEvent): Touch | null {
    const shape = this.shapes.main;
    return shape && touchShape(shape, this.caster(event).ray);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = (this.layout === "side" ? width / 2 : width) / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  private frame(): void {
    if (this.ended) return;
    const now = performance.now();
    this.moving = this.controls.update((now - this.last) / 1000);
    this.last = now;
    if (this.moving || this.dirty) this.render();
    requestAnimationFrame(() => this.frame());
  }

  // Returns the columns of a picture of this width, with the shapes that each shows.
  private parts(width: number): Part[] {
    const { main, other } = this.shapes;
    const showing = (showMain: boolean, showOther: boolean) => () => {
      if (main) main.group.visible = showMain;
      if (other) other.group.visible = showOther;
    };
    if (this.layout !== "side" || !other) {
      return [{ left: 0, width, show: showing(true, this.layout === "over") }];
    }
    const half = Math.floor(width / 2);
    return [
      { left: 0, width: half, show: showing(false, true) },
      { left: half, width: width - half, show: showing(true, false) },
    ];
  }

  private render(): void {
    this.dirty = false;
    const size = this.renderer.getSize(new Vector2());
    for (const { left, width, show } of this.parts(size.x)) {
      show();
      this.renderer.setViewport(left, 0, width, size.y);
      this.renderer.setScissor(left, 0, width, size.y);
      this.renderer.setScissorTest(true);
      this.renderer.render(this.scene, this.camera);
    }
    this.tellSight(size.y);
    const done = this.waiting;
    this.waiting = [];
    if (done.length) setTimeout(() => done.forEach((tell) => tell()));
  }

  private tellSight(height: number): void {
    const high = 2 * this.controls.distance * Math.tan((fieldOfView * Math.PI) / 360);
    const sight = sightOf(this.camera, high / height);
    if (JSON.stringify(this.sight.peek()) !== JSON.stringify(sight)) this.sight.value = sight;
  }
}
