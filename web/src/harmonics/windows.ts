// Gains of degrees 0 ... L: the filters of include/rholm/filter.h, and an equaliser's bands.

export const windows = [
  ["lanczos", "Lanczos"],
  ["ideal", "Sharp"],
  ["gaussian", "Gaussian"],
  ["heat", "Heat"],
] as const;
export type Window = (typeof windows)[number][0];

// The factor of degree l of a low-pass filter of degree `cutoff`; 0 above it, but for heat.
function gain(l: number, cutoff: number, window: Window): number {
  if (l === 0) return 1;
  const ratio = cutoff > 0 ? (l * (l + 1)) / (cutoff * (cutoff + 1)) : Infinity;
  if (window === "heat") return Math.exp(-Math.LN2 * ratio);
  if (l > cutoff) return 0;
  if (window === "gaussian") return Math.exp(-2.4 * ratio);
  if (window === "ideal") return 1;
  const x = (Math.PI * l) / (cutoff + 1);
  return Math.sin(x) / x;
}

export function lowPass(cutoff: number, degree: number, window: Window): number[] {
  return Array.from({ length: degree + 1 }, (_, l) => gain(l, cutoff, window));
}

// Degrees from cutoff >= 1 on; 0 is kept, so that a surface stays.
export function highPass(cutoff: number, degree: number, window: Window): number[] {
  return lowPass(cutoff - 1, degree, window).map((g, l) => (l === 0 ? 1 : 1 - g));
}

// Unsharp masking by a low-pass filter.
export function sharpen(cutoff: number, degree: number, window: Window, amount: number): number[] {
  return lowPass(cutoff, degree, window).map((g) => 1 + amount * (1 - g));
}

export interface Band {
  from: number;
  to: number; // both are in it
}

// Degrees 1 ... L in octaves: 1, 2, 3-4, 5-8, ... Degree 0 is the size and in no band.
export function octaves(degree: number): Band[] {
  const bands: Band[] = [];
  for (let from = 1, to = 1; from <= degree; from = to + 1, to = 2 * to) {
    bands.push({ from, to: Math.min(to, degree) });
  }
  return bands;
}

export function bandGains(bands: readonly Band[], values: readonly number[], degree: number): number[] {
  const gains = new Array<number>(degree + 1).fill(1);
  bands.forEach(({ from, to }, k) => gains.fill(values[k] ?? 1, from, to + 1));
  return gains;
}

// The mean gain of each band.
export function bandMeans(bands: readonly Band[], gains: readonly number[]): number[] {
  return bands.map(({ from, to }) => {
    const within = gains.slice(from, to + 1);
    return within.reduce((sum, g) => sum + g, 0) / within.length;
  });
}

// Without the zeros at the end: what degree they reach.
export function trimmed(gains: readonly number[]): { degree: number; gains: number[] } {
  const degree = Math.max(0, gains.findLastIndex((g) => g !== 0));
  return { degree, gains: gains.slice(0, degree + 1) };
}
