import { expect, it } from "vitest";
import { bandGains, bandMeans, highPass, octaves, sharpen, trimmed } from "../src/harmonics/bands";

const low = [1, 0.9, 0.4, 0];

it("high pass is what low pass leaves, but for the size", () => {
  const high = highPass(low);
  expect(high[0]).toBe(1);
  high.slice(1).forEach((g, k) => expect(g + (low[k + 1] ?? NaN)).toBeCloseTo(1, 14));
});

it("sharpening by 0 changes nothing, and never the size", () => {
  expect(sharpen(low, 0)).toEqual([1, 1, 1, 1]);
  expect(sharpen(low, 2)[0]).toBe(1);
  expect(sharpen(low, 2)[3]).toBe(3);
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
