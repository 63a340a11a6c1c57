// Colours in linear light with sRGB's primaries, and the colour maps of the program's pictures.
// Equal steps of a value are equal steps in Oklab (src/report/picture/color.cpp has the choices).

export type Rgb = [r: number, g: number, b: number]; // 0 ... 1, linear

// Converts from Oklab's lightness (0 ... 1), chroma and hue (degrees): Ottosson
// 2020, "A perceptual color space for image processing". Clipped to 0 ... 1.
export function fromOklch(lightness: number, chroma: number, hue: number): Rgb {
  const angle = (hue * Math.PI) / 180;
  const a = chroma * Math.cos(angle);
  const b = chroma * Math.sin(angle);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const clip = (x: number) => Math.min(1, Math.max(0, x));
  return [
    clip(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    clip(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    clip(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

// Convert between a linear component and its sRGB encoding (IEC 61966-2-1), 0 ... 1.
export function toSrgb(linear: number): number {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
}
export function fromSrgb(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

export function cssColor(color: Rgb): string {
  return `rgb(${color.map((x) => Math.round(255 * toSrgb(x))).join(" ")})`;
}

// Maps 0 ... 1 to colours from violet through teal to yellow, at constant speed in Oklab.
export function sequential(t: number): Rgb {
  return fromOklch(0.34 + 0.58 * t, 0.095, 300 - 195 * t);
}

// Maps -1 ... 1 to straight lines in Oklab from a near-white to blue and to red.
export function diverging(t: number): Rgb {
  const a = Math.abs(t);
  return fromOklch(0.95 - 0.45 * a, 0.155 * a, t < 0 ? 255 : 28);
}

export interface Range {
  min: number;
  max: number;
}

// Returns the range of the finite values; 0 ... 0 if there are none.
export function rangeOf(values: Iterable<number>): Range {
  let min = Infinity;
  let max = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < min) min = value;
    if (value > max) max = value;
  }
  return min <= max ? { min, max } : { min: 0, max: 0 };
}

// Returns true if the range has 0 inside; its diverging map has 0 in the middle.
export function isDiverging(range: Range): boolean {
  return range.min < 0 && range.max > 0;
}

// Returns the colour of a value; values outside the range have the colour of its end.
export function mapColor(range: Range, value: number): Rgb {
  const x = Math.min(range.max, Math.max(range.min, value));
  if (isDiverging(range)) return diverging(x / Math.max(-range.min, range.max));
  return sequential(range.max > range.min ? (x - range.min) / (range.max - range.min) : 0);
}

const steps = 256; // chosen: below a step of 8-bit colours

// Computes colours [n, 3] of values, by a table of `steps` colours.
export function mapColors(range: Range, values: ArrayLike<number>, out: Float32Array): void {
  const span = range.max - range.min || 1;
  const table = new Float32Array(3 * (steps + 1));
  for (let k = 0; k <= steps; ++k) table.set(mapColor(range, range.min + (span * k) / steps), 3 * k);
  for (let i = 0; i < values.length; ++i) {
    const t = ((values[i] ?? range.min) - range.min) / span;
    const k = 3 * Math.round(steps * Math.min(1, Math.max(0, t || 0)));
    out[3 * i] = table[k] ?? 0;
    out[3 * i + 1] = table[k + 1] ?? 0;
    out[3 * i + 2] = table[k + 2] ?? 0;
  }
}

// Returns the colour of a cap: consecutive numbers have very different hues.
export function labelColor(label: number): Rgb {
  return fromOklch(0.74, 0.11, (label * 137.50776405) % 360); // the golden angle
}

// Computes colours of points from their normals, slightly lit from above. `up`: the axis, 0 ... 2.
export function shadePoints(normals: Float32Array, up: number, out: Float32Array): void {
  for (let i = 0; i < normals.length; i += 3) {
    const light = 0.75 + 0.25 * (normals[i + up] ?? 0);
    for (let k = 0; k < 3; ++k) out[i + k] = light * (dotted[k] ?? 0);
  }
}

export const plain = fromOklch(0.78, 0.03, 80); // a warm stone
export const dotted = fromOklch(0.6, 0.07, 60); // points without a shade of their own
export const second = fromOklch(0.7, 0.1, 245); // the other shape of two
export const marked = fromOklch(0.62, 0.24, 350); // faces not seen from the centre
export const painted = fromOklch(0.72, 0.16, 55); // under the brush
export const ringed = fromOklch(0.38, 0.11, 45); // the brush's rim
export const placed = fromOklch(0.68, 0.14, 160); // the target of a texture
