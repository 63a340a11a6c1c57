import { expect, it } from "vitest";
import { encodeBinary } from "../src/binary";
import { decodeViewData, fromBase64 } from "../src/viewdata";
import { makeModel, setDegree, valuesFor } from "../src/viewer/model";

function sphere(degree: number, meta: Record<string, unknown> = {}): Uint8Array {
  const coefficients = new Float64Array(2 * (degree + 1) ** 2);
  coefficients[0] = Math.sqrt(4 * Math.PI);
  if (degree > 0) coefficients[degree + 1] = 0.1;
  return encodeBinary(
    [{ name: "coefficients", shape: [2, degree + 1, degree + 1], values: coefficients }],
    meta,
  );
}

it("data come back from their bytes, by way of base64 too", () => {
  const bytes = sphere(3, {
    title: "Bennu",
    unit: "km",
    expansion: { degree: 3, function: "radius", center: [1, 2, 3] },
    error: [[3, 0.1, null]],
    tail: { strength: 2 },
  });
  const data = decodeViewData(fromBase64(`\n${Buffer.from(bytes).toString("base64")}\n`));
  expect(data.title).toBe("Bennu");
  expect(data.expansion.degree).toBe(3);
  expect(data.expansion.center).toEqual([1, 2, 3]);
  expect(data.error).toEqual([[3, 0.1, null]]);
  expect(data.tail).toEqual({ strength: 2 });
  expect(data.mesh).toBeNull();
  expect(data.power.map((e) => Number(e.toFixed(12)))).toEqual([
    Number((4 * Math.PI).toFixed(12)),
    0.01,
    0,
    0,
  ]);
});

it("what may be left out has a meaning", () => {
  const data = decodeViewData(sphere(0));
  expect(data.expansion).toMatchObject({ degree: 0, function: "radius", center: [0, 0, 0] });
  expect(data.unit).toBe("");
});

it("coefficients that are no two squares are refused", () => {
  const wrong = encodeBinary([{ name: "coefficients", shape: [7], values: new Float64Array(7) }]);
  expect(() => decodeViewData(wrong)).toThrow("no two squares");
  expect(() => decodeViewData(encodeBinary([]))).toThrow("missing");
});

it("a mesh whose faces have no such vertices is refused", () => {
  const wrong = encodeBinary([
    { name: "coefficients", shape: [2], values: new Float64Array(2) },
    { name: "positions", shape: [1, 3], values: new Float32Array(3) },
    { name: "triangles", shape: [1, 3], values: new Uint32Array([0, 0, 1]) },
  ]);
  expect(() => decodeViewData(wrong)).toThrow("no such vertex");
});

it("at degree 0 the difference from all is what degree 1 adds", () => {
  const model = makeModel(decodeViewData(sphere(1)));
  setDegree(model, 0);
  const difference = valuesFor(model, "difference");
  const most = 0.1 * Math.sqrt(3 / (4 * Math.PI)); // at the poles
  expect(difference?.range.max).toBeCloseTo(most, 12);
  expect(difference?.range.min).toBeCloseTo(-most, 12);
  expect(Math.hypot(...model.surface.positions.slice(0, 3))).toBeCloseTo(1, 6);
  setDegree(model, 1);
  expect(valuesFor(model, "difference")?.range.max).toBe(0);
  expect(valuesFor(model, "plain")).toBeNull();
});
