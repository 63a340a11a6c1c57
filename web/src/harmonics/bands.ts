// Gains of degrees 0 ... L: derived from a low-pass filter, and the bands of an equaliser.

// Takes the low-pass filter of the degree below; degree 0 is kept, so that a surface stays.
export function highPass(low: readonly number[]): number[] {
  return low.map((g, l) => (l === 0 ? 1 : 1 - g));
}

// Unsharp masking.
export function sharpen(low: readonly number[], amount: number): number[] {
  return low.map((g) => 1 + amount * (1 - g));
}

export interface Band {
  from: number;
  to: number; // inclusive
}

// Returns degrees 1 ... L in octaves: 1, 2, 3-4, 5-8, ... Degree 0 is the size and in no band.
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

// Returns the mean gain of each band.
export function bandMeans(bands: readonly Band[], gains: readonly number[]): number[] {
  return bands.map(({ from, to }) => {
    const within = gains.slice(from, to + 1);
    return within.reduce((sum, g) => sum + g, 0) / within.length;
  });
}

// Removes the zeros at the end, and returns the degree of the last nonzero gain.
export function trimmed(gains: readonly number[]): { degree: number; gains: number[] } {
  const degree = Math.max(0, gains.findLastIndex((g) => g !== 0));
  return { degree, gains: gains.slice(0, degree + 1) };
}
