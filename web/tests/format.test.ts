import { expect, it } from "vitest";
import { bytes, count, fromLog, number, stem, toLog, withUnit } from "../src/format";
import { percentile } from "../src/latency";
import { spectrumCurves } from "../src/plots/spectrum";

it("numbers have three digits", () => {
  expect(number(0)).toBe("0");
  expect(number(Math.PI)).toBe("3.14");
  expect(number(123456)).toBe("123000");
  expect(number(1.5e9)).toBe("1.50e9");
  expect(number(-2e-5)).toBe("-2.00e-5");
  expect(number(NaN)).toBe("–");
  expect(number(null)).toBe("–");
  expect(count(1234567)).toBe("1\u202f234\u202f567");
  expect(withUnit(2, "km")).toBe("2 km");
  expect(withUnit(2, "")).toBe("2");
});

it("bytes have the largest unit below them", () => {
  expect(bytes(0)).toBe("0 bytes");
  expect(bytes(999)).toBe("999 bytes");
  expect(bytes(1234)).toBe("1.23 kB");
  expect(bytes(5e12)).toBe("5000 GB");
});

it("a logarithmic slider comes back to its value", () => {
  for (const value of [0.01, 0.1, 0.37, 10]) {
    expect(fromLog(toLog(value, 0.01, 10), 0.01, 10)).toBeCloseTo(value, 12);
  }
  expect(fromLog(0.5, 1, 100)).toBeCloseTo(10, 12);
});

it("stems of names", () => {
  expect(stem("a.b.ply")).toBe("a.b");
  expect(stem(".ply")).toBe("shape");
  expect(stem("shape")).toBe("shape");
});

it("percentiles are of the nearest rank", () => {
  expect(percentile([4, 1, 3, 2], 0.5)).toBe(2);
  expect(percentile([4, 1, 3, 2], 0.95)).toBe(4);
  expect(percentile([], 0.5)).toBeNaN();
});

it("the predicted tail falls with the fourth power", () => {
  const { x, curves } = spectrumCurves([1, 1, 1, 1, 0], { strength: Math.PI });
  expect(x).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
  expect(curves[0]?.values).toEqual([1, 1, 1, null, null, null, null, null]);
  expect(curves[1]?.values[1]).toBeCloseTo(1 / 16, 14);
  expect(curves[1]?.values[7]).toBeCloseTo(1 / 4096, 14);
  expect(spectrumCurves([1, 1, 1], null).x).toEqual([1, 2]);
});
