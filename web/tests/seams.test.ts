import { expect, it } from "vitest";
import { atPieces, seamsOf } from "../src/geometry/seams";

// Returns a plane of n by n squares of two triangles each.
function plane(n: number): { positions: Float32Array; triangles: Uint32Array } {
  const at = (i: number, j: number) => i * (n + 1) + j;
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let i = 0; i <= n; ++i) for (let j = 0; j <= n; ++j) positions.push(i / n, j / n, 0);
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      triangles.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

const n = 32;
const { positions, triangles } = plane(n);
const labelsBy = (label: (x: number, y: number) => number) =>
  Uint32Array.from({ length: positions.length / 3 }, (_, v) => label(positions[3 * v] ?? 0, positions[3 * v + 1] ?? 0));

function area(p: ArrayLike<number>, i: number): number {
  const x = (k: number) => p[i + k] ?? 0;
  return ((x(3) - x(0)) * (x(7) - x(1)) - (x(4) - x(1)) * (x(6) - x(0))) / 2;
}

it("one label has no seams", () => {
  const seams = seamsOf(triangles, labelsBy(() => 4));
  expect(seams.pieceLabels).toHaveLength(0);
  expect(new Set(seams.labels)).toEqual(new Set([4]));
});

it("pieces fill the triangles that have several labels, and no others", () => {
  const seams = seamsOf(triangles, labelsBy((x, y) => (x > 0.5 ? 2 : y > 0.6 ? 1 : 0)));
  const pieces = atPieces(seams, positions);
  let filled = 0;
  for (let i = 0; i < pieces.length; i += 9) {
    expect(area(pieces, i)).toBeGreaterThanOrEqual(0);
    filled += area(pieces, i);
  }
  let mixed = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const own = Array.from(triangles.subarray(t, t + 3), (v) => seams.labels[v]);
    if (new Set(own).size > 1) mixed += 1 / (2 * n * n);
  }
  expect(filled).toBeCloseTo(mixed, 6);
  expect(new Set(seams.pieceLabels)).toEqual(new Set([0, 1, 2]));
});

it("a border across the edges of the mesh has no teeth", () => {
  const slope = 0.37;
  const from = 0.3;
  const seams = seamsOf(triangles, labelsBy((x, y) => Number(y > from + slope * x)));
  const pieces = atPieces(seams, positions);
  // Corners within the plane that are no vertices lie on the border.
  let far = 0;
  let found = 0;
  for (let i = 0; i < pieces.length; i += 3) {
    const [x, y] = [pieces[i] ?? 0, pieces[i + 1] ?? 0];
    const vertex = [x, y].every((c) => Math.abs(c * n - Math.round(c * n)) < 1e-4);
    if (vertex || Math.min(x, 1 - x) < 0.25) continue;
    far = Math.max(far, Math.abs(y - from - slope * x) / Math.hypot(1, slope));
    found += 1;
  }
  expect(found).toBeGreaterThan(20);
  expect(far).toBeLessThan(0.5 / n); // a zigzag would be as high as an edge is long
});
