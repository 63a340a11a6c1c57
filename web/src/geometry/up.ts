// Guesses the upward axis, which files do not contain.
export const ups = ["x", "y", "z"] as const;
export type Up = (typeof ups)[number];

export interface Box {
  min: [number, number, number];
  max: [number, number, number];
}

export function boxOf(positions: ArrayLike<number>): Box {
  const box: Box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
  for (let i = 0; i < positions.length; ++i) {
    const k = (i % 3) as 0 | 1 | 2;
    const x = positions[i] ?? 0;
    if (x < box.min[k]) box.min[k] = x;
    if (x > box.max[k]) box.max[k] = x;
  }
  return box;
}

const onGround = 0.01; // share of the height; chosen: a shape placed on the plane through 0 ends within it
const aboutMiddle = 0.1; // share of an extent; chosen: distance of the middle from 0 after placing by hand
const flat = 0.25; // share of the other extents; chosen: plates and landscapes, not discs
const tall = 1.15; // ratio to the other extents; chosen: standing figures, not nearly round shapes

// Returns z, as used for machines and maps, unless the box indicates y, as in animation and for scanned
// figures. The box indicates y if the shape stands on the plane y = 0, is flat along y, or is tallest along y.
export function guessUp({ min, max }: Box): Up {
  const size = max.map((high, k) => high - (min[k] ?? 0));
  const extent = (k: number) => size[k] ?? 0;
  const others = (k: number) => [0, 1, 2].filter((other) => other !== k);
  const stands = (k: number) =>
    Math.abs(min[k] ?? 0) <= onGround * extent(k) &&
    others(k).every((o) => Math.abs((min[o] ?? 0) + (max[o] ?? 0)) / 2 <= aboutMiddle * extent(o));
  const isFlat = (k: number) => others(k).every((o) => extent(k) < flat * extent(o));
  const isTall = (k: number) => others(k).every((o) => extent(k) > tall * extent(o));
  for (const speaks of [stands, isFlat]) {
    if (speaks(2)) return "z";
    if (speaks(1)) return "y";
  }
  return isTall(1) ? "y" : "z";
}

// Directions of views, in radians: the angle about the upward axis from the front, and the angle from that axis.
export const views = [
  ["front", "Front", 0, Math.PI / 2],
  ["right", "Right", Math.PI / 2, Math.PI / 2],
  ["back", "Back", Math.PI, Math.PI / 2],
  ["left", "Left", -Math.PI / 2, Math.PI / 2],
  ["top", "Top", 0, 0],
  ["bottom", "Bottom", 0, Math.PI],
] as const;
export type ViewName = (typeof views)[number][0];

// Returns the largest of 1, 2, 5 times a power of ten that is at most `most`; 0 if there is none.
export function roundLength(most: number): number {
  if (!(most > 0) || !Number.isFinite(most)) return 0;
  const power = 10 ** Math.floor(Math.log10(most));
  const digit = [5, 2, 1].find((one) => one * power <= most) ?? 0.5;
  return Number((digit * power).toPrecision(3));
}
