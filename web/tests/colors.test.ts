import { describe, expect, it } from "vitest";
import {
  diverging,
  fromSrgb,
  mapColor,
  mapColors,
  rangeOf,
  sequential,
  toSrgb,
  type Rgb,
} from "../src/geometry/colors";

// Ottosson's forward transform, the inverse of the tested one.
function oklab([r, g, b]: Rgb): [number, number, number] {
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function steps(map: (t: number) => Rgb, from: number, to: number): number[] {
  const at = Array.from({ length: 65 }, (_, k) => oklab(map(from + ((to - from) * k) / 64)));
  return at.slice(1).map((lab, k) => Math.hypot(...lab.map((x, i) => x - (at[k]?.[i] ?? NaN))));
}

describe("colour maps", () => {
  it.each([
    ["sequential", sequential, 0, 1],
    ["diverging below 0", diverging, -1, 0],
    ["diverging above 0", diverging, 0, 1],
  ] as const)("%s: equal steps are equal to the eye", (_, map, from, to) => {
    const sizes = steps(map, from, to);
    // Clipping to sRGB may shorten the ends slightly.
    expect(Math.max(...sizes) / Math.min(...sizes)).toBeLessThan(1.05);
  });

  it("the sequential one grows lighter all the way", () => {
    const light = Array.from({ length: 65 }, (_, k) => oklab(sequential(k / 64))[0]);
    expect(light).toEqual([...light].sort((a, b) => a - b));
  });

  it("a range with 0 inside has the neutral colour there", () => {
    expect(mapColor({ min: -1, max: 3 }, 0)).toEqual(diverging(0));
    expect(mapColor({ min: 1, max: 3 }, 3)).toEqual(sequential(1));
  });

  it("values outside a range, and a range of one value, have colours", () => {
    expect(mapColor({ min: 0, max: 1 }, 7)).toEqual(sequential(1));
    expect(mapColor({ min: 2, max: 2 }, 2)).toEqual(sequential(0));
  });

  it("the table of colours is the map", () => {
    const range = { min: -2, max: 2 };
    const values = [-2, -1, 0, 1, 2, 5];
    const out = new Float32Array(18);
    mapColors(range, values, out);
    values.forEach((value, i) => {
      mapColor(range, value).forEach((x, k) => expect(out[3 * i + k]).toBeCloseTo(x, 6));
    });
  });
});

it("sRGB's encoding is undone by its inverse", () => {
  for (let x = 0; x <= 1; x += 1 / 64) expect(fromSrgb(toSrgb(x))).toBeCloseTo(x, 6);
});

it("a range is of finite numbers", () => {
  expect(rangeOf([3, NaN, -1, Infinity])).toEqual({ min: -1, max: 3 });
  expect(rangeOf([])).toEqual({ min: 0, max: 0 });
});
