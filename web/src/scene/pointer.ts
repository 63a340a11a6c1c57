// The pointer on the canvas: for the tool of a panel, or for the camera.
import type { Touch } from "./shape";

export type PointerKind = "down" | "move" | "up" | "leave";
// Says whether the pointer is taken, so that the camera stays. Where it touches the shape is looked for
// if it is asked.
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
  // Alt and the wheel are the brush's.
  canvas.addEventListener("wheel", (event) => event.altKey && event.stopImmediatePropagation());
}
