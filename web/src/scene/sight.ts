// Orientation and scale of the view.
import { Vector3, type Camera } from "three";
import type { Up } from "../geometry/up";

type Seen = [right: number, up: number, nearer: number];

export interface Sight {
  axes: Record<Up, Seen>; // unit vectors x, y, z on the screen
  perPixel: number; // length of a pixel at the distance of the camera's target
}

export function axisOf(up: Up): Vector3 {
  return new Vector3(Number(up === "x"), Number(up === "y"), Number(up === "z"));
}

export function sightOf(camera: Camera, perPixel: number): Sight {
  const turned = camera.quaternion.clone().invert();
  const seen = (up: Up): Seen => axisOf(up).applyQuaternion(turned).toArray();
  return { axes: { x: seen("x"), y: seen("y"), z: seen("z") }, perPixel };
}
