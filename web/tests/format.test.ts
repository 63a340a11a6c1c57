import { expect, it } from "vitest";
import {
  bytes,
  count,
  fromPlace,
  number,
  percent,
  shortened,
  shortNames,
  stem,
  toPlace,
  typedNumber,
  withUnit,
} from "../src/format";
import { percentile } from "../src/latency";
import { spectrumCurves } from "../src/plots/spectrum";

it("numbers have three digits", () => {
  expect(number(0)).toBe("0");
  expect(number(Math.PI)).toBe("3.14");
  expect(number(123456)).toBe("123000");
  expect(number(1.5e9)).toBe("1.50e9");
  expect(number(-2e-5)).toBe("-2.00e-5");
  expect(number(NaN)).toBe("not known");
  expect(number(null)).toBe("not known");
  expect(withUnit(null, "mm")).toBe("not known");
  expect(count(1234567)).toBe("1\u202f234\u202f567");
  expect(withUnit(2, "km")).toBe("2 km");
  expect(withUnit(2, "")).toBe("2");
});

it("numbers are typed with either decimal mark, and as percents of a whole", () => {
  expect(typedNumber(" 2.5 ")).toBe(2.5);
  expect(typedNumber("2,5")).toBe(2.5);
  expect(typedNumber("25 %", 8)).toBe(2);
  expect(typedNumber("12,5%", 8)).toBe(1);
  for (const text of ["", " ", "%", "x", "1 2", "5 %"]) expect(typedNumber(text), text).toBeNaN();
  expect(typedNumber("%", 8)).toBeNaN();
  expect(percent(0.01)).toBe("1\u00a0%");
  expect(percent(0.12345)).toBe("12.3\u00a0%");
});

it("bytes have the largest unit below them", () => {
  expect(bytes(0)).toBe("0 bytes");
  expect(bytes(999)).toBe("999 bytes");
  expect(bytes(1234)).toBe("1.23 kB");
  expect(bytes(5e12)).toBe("5000 GB");
});

it.each(["linear", "log", "root"] as const)("a %s slider comes back to its value", (scale) => {
  for (const value of [0.01, 0.1, 0.37, 10]) {
    expect(fromPlace(scale, toPlace(scale, value, 0.01, 10), 0.01, 10)).toBeCloseTo(value, 12);
  }
  expect(toPlace(scale, 3, 3, 3)).toBe(0);
});

it("a slider of degrees gives the low ones room", () => {
  expect(fromPlace("log", 0.5, 1, 100)).toBeCloseTo(10, 12);
  expect(toPlace("root", 20, 0, 180)).toBeCloseTo(1 / 3, 12);
  expect(fromPlace("root", 0, 0, 180)).toBe(0);
  expect(fromPlace("root", 1, 0, 180)).toBe(180);
});

it("long names are shortened, and stay different", () => {
  const long = "a-very-long-name-of-a-scan";
  const names = ["a.ply", `${long}-A-final-decimated-mesh.ply`, `${long}-B-final-decimated-mesh.ply`, "a.ply"];
  const short = shortNames(names, 24);
  expect(short[0]).toBe("a.ply");
  expect(short[3]).toBe("a.ply (2)");
  expect(new Set(short).size).toBe(4);
  for (const name of short) expect(Array.from(name).length).toBeLessThanOrEqual(24 + 4);
  expect(short[1]).toContain("A-final");
  expect(shortNames(["b-long-name-with-its-end.ply"], 20)).toEqual(["b-long-nam…s-end.ply"]);
  // One name is the beginning of the other.
  expect(new Set(shortNames([`${long}${long}.ply`, `${long}${long}${long}.ply`], 16)).size).toBe(2);
});

it("of a long message the first sentence is said at once", () => {
  expect(shortened("It is open. Repair it.")).toEqual({ first: "It is open. Repair it.", rest: "" });
  const rest = "Then more, ".repeat(20).trim();
  expect(shortened(`The mesh is 0.5 off; ${rest}`)).toEqual({ first: "The mesh is 0.5 off.", rest });
  const lines = `a.ply: it ends. ${rest}\nThe other one is open.`;
  expect(shortened(lines)).toEqual({ first: "a.ply: it ends.\nThe other one is open.", rest: lines });
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
