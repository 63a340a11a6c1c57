// Surface on the grid of a synthesis: x = center + r u.
import type { Grid } from "./synthesis";

// Returns unit directions [rings * meridians + 2, 3] of the grid, the poles last.
export function gridDirections({ rings, meridians }: Grid): Float32Array {
  const directions = new Float32Array(3 * (rings * meridians + 2));
  for (let j = 0; j < rings; ++j) {
    const theta = ((j + 0.5) * Math.PI) / rings;
    for (let k = 0; k < meridians; ++k) {
      const phi = (2 * Math.PI * k) / meridians;
      const sin = Math.sin(theta);
      directions.set(
        [sin * Math.cos(phi), sin * Math.sin(phi), Math.cos(theta)],
        3 * (j * meridians + k),
      );
    }
  }
  directions.set([0, 0, 1, 0, 0, -1], 3 * rings * meridians);
  return directions;
}

// Returns triangles [m, 3], counter-clockwise seen from outside, closed at the poles.
export function gridTriangles({ rings, meridians }: Grid): Uint32Array {
  const triangles = new Uint32Array(6 * rings * meridians);
  const north = rings * meridians;
  let at = 0;
  const add = (a: number, b: number, c: number) => {
    triangles[at++] = a;
    triangles[at++] = b;
    triangles[at++] = c;
  };
  for (let k = 0; k < meridians; ++k) {
    const next = (k + 1) % meridians;
    const last = (rings - 1) * meridians;
    add(north, k, next);
    add(north + 1, last + next, last + k);
    for (let j = 0; j + 1 < rings; ++j) {
      const up = j * meridians;
      const low = up + meridians;
      add(up + k, low + k, low + next);
      add(up + k, low + next, up + next);
    }
  }
  return triangles;
}

// Returns the function that converts values of the expanded function to radii.
export function radiusOf(name: string): (value: number) => number {
  if (name === "gauge") return (q) => 1 / q;
  return name === "log radius" ? Math.exp : (r) => r;
}

export function placeVertices(
  directions: Float32Array,
  radii: Float64Array | Float32Array,
  center: readonly [number, number, number],
  out: Float32Array,
): void {
  for (let i = 0; i < radii.length; ++i) {
    const r = radii[i] ?? 0;
    for (let k = 0; k < 3; ++k) out[3 * i + k] = (center[k] ?? 0) + r * (directions[3 * i + k] ?? 0);
  }
}
