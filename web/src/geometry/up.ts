// Which way is up: files do not say it.
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

const onGround = 0.01; // of the height; chosen: a shape that was put on the plane through 0 ends there
const aboutMiddle = 0.1; // of an extent; chosen: how far the middle of what was put there by hand is from 0
const flat = 0.25; // of the other two extents; chosen: plates and landscapes, not discs
const tall = 1.15; // of the other two; chosen: figures that stand, not shapes as good as round

// z, as for machines and maps, unless the box speaks for y, as in animation and of scanned figures: a shape stands on
// the plane y = 0, is flat along y, or is tallest along y.
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

// Directions from which shapes are looked at: angles about the axis that is up, from the front, and from that axis,
// radians.
export const views = [
  ["front", "Front", 0, Math.PI / 2],
  ["right", "Right", Math.PI / 2, Math.PI / 2],
  ["back", "Back", Math.PI, Math.PI / 2],
  ["left", "Left", -Math.PI / 2, Math.PI / 2],
  ["top", "Top", 0, 0],
  ["bottom", "Bottom", 0, Math.PI],
] as const;
export type ViewName = (typeof views)[number][0];

// The largest of 1, 2, 5 times a power of ten that is at most so long; 0 of nothing.
export function roundLength(most: number): number {
  if (!(most > 0) || !Number.isFinite(most)) return 0;
  const power = 10 ** Math.floor(Math.log10(most));
  const digit = [5, 2, 1].find((one) => one * power <= most) ?? 0.5;
  return Number((digit * power).toPrecision(3));
}
