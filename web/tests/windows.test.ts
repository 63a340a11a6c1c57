import { describe, expect, it } from "vitest";
import {
  bandGains,
  bandMeans,
  highPass,
  lowPass,
  octaves,
  sharpen,
  trimmed,
  windows,
} from "../src/harmonics/windows";

describe.each(windows.map(([key]) => key))("the %s window", (window) => {
  it("falls from 1 and never rises", () => {
    const gains = lowPass(12, 40, window);
    expect(gains).toHaveLength(41);
    expect(gains[0]).toBe(1);
    gains.slice(1).forEach((g, l) => expect(g).toBeLessThanOrEqual(gains[l] ?? NaN));
    if (window !== "heat") expect(gains.slice(13)).toEqual(new Array(28).fill(0));
  });
  it("high pass is what low pass leaves, but for the size", () => {
    const low = lowPass(7, 20, window);
    const high = highPass(8, 20, window);
    expect(high[0]).toBe(1);
    high.slice(1).forEach((g, k) => expect(g + (low[k + 1] ?? NaN)).toBeCloseTo(1, 14));
  });
  it("sharpening by 0 changes nothing, and never the size", () => {
    expect(sharpen(5, 9, window, 0)).toEqual(new Array(10).fill(1));
    expect(sharpen(5, 9, window, 2)[0]).toBe(1);
    if (window !== "heat") expect(sharpen(5, 9, window, 2)[9]).toBe(3);
  });
});

it("values of the windows are those of their formulas", () => {
  expect(lowPass(3, 3, "lanczos")[2]).toBeCloseTo(2 / Math.PI, 14); // sin(pi/2) / (pi/2)
  expect(lowPass(8, 8, "heat")[8]).toBeCloseTo(0.5, 14);
  expect(lowPass(8, 8, "gaussian")[8]).toBeCloseTo(Math.exp(-2.4), 14);
});

it("octaves hold each degree from 1 to L once", () => {
  for (const top of [1, 2, 3, 8, 37, 512]) {
    const degrees = octaves(top).flatMap(({ from, to }) =>
      Array.from({ length: to - from + 1 }, (_, k) => from + k),
    );
    expect(degrees).toEqual(Array.from({ length: top }, (_, k) => k + 1));
  }
  expect(octaves(0)).toEqual([]);
});

it("gains of bands have the means they were made of", () => {
  const bands = octaves(20);
  const values = bands.map((_, k) => k / 2);
  const gains = bandGains(bands, values, 20);
  expect(gains[0]).toBe(1);
  expect(bandMeans(bands, gains)).toEqual(values);
});

it("zeros at the end are trimmed, those before are not", () => {
  expect(trimmed([1, 0, 2, 0, 0])).toEqual({ degree: 2, gains: [1, 0, 2] });
  expect(trimmed([0, 0])).toEqual({ degree: 0, gains: [0] });
});
