import { describe, expect, it } from "vitest";
import { arrayOf, decodeBinary, encodeBinary, needArray, surfaceOf } from "../src/binary";

const arrays = [
  { name: "positions", shape: [2, 3], values: new Float32Array([0, 1, 2, 3, 4, 5]) },
  { name: "numbers", shape: [3], values: new Float64Array([Math.PI, -0, 1e300]) },
  { name: "faces", shape: [1], values: new Uint32Array([4294967295]) },
  { name: "bytes", shape: [3], values: new Uint8Array([1, 2, 255]) },
];

describe("arrays as bytes", () => {
  it("come back as they were", () => {
    const { arrays: read, meta } = decodeBinary(encodeBinary(arrays, { unit: "µm" }));
    expect(meta).toEqual({ unit: "µm" });
    for (const { name, shape, values } of arrays) {
      expect(read.get(name)).toEqual({ shape, values });
    }
  });

  it("begin at multiples of 8", () => {
    const bytes = encodeBinary(arrays);
    const length = new DataView(bytes.buffer).getUint32(8, true);
    const said = JSON.parse(new TextDecoder().decode(bytes.subarray(12, 12 + length))) as {
      arrays: { offset: number }[];
    };
    expect((12 + length) % 8).toBe(0);
    expect(said.arrays.map(({ offset }) => offset % 8)).toEqual([0, 0, 0, 0]);
  });

  it("are read where they lie in larger bytes, aligned or not", () => {
    const bytes = encodeBinary(arrays);
    for (const shift of [8, 3]) {
      const larger = new Uint8Array(bytes.length + shift);
      larger.set(bytes, shift);
      const read = decodeBinary(larger.subarray(shift));
      expect(needArray(read, "numbers", Float64Array)).toEqual(arrays[1]?.values);
    }
  });

  it("are refused when cut off anywhere", () => {
    const bytes = encodeBinary(arrays);
    const end = bytes.length - 5; // the last byte of the last array: 3 of 8 are used
    for (let length = 0; length < end; ++length) {
      expect(() => decodeBinary(bytes.slice(0, length))).toThrow();
    }
    expect(() => decodeBinary(bytes.slice(0, end))).not.toThrow();
  });

  it("are refused with shapes and places that cannot be", () => {
    const said = (entry: object) => {
      const text = JSON.stringify({ arrays: [{ name: "a", type: "f32", shape: [1], offset: 512, ...entry }] });
      const bytes = new Uint8Array(1024);
      bytes.set(new TextEncoder().encode("RHOLM1\0\0"));
      new DataView(bytes.buffer).setUint32(8, text.length, true);
      bytes.set(new TextEncoder().encode(text), 12);
      return () => decodeBinary(bytes);
    };
    expect(said({})).not.toThrow();
    for (const wrong of [
      { type: "f16" },
      { type: "constructor" },
      { shape: [-1] },
      { shape: [1e300] },
      { shape: ["1"] },
      { shape: [1000] },
      { offset: 4 },
      { offset: 1021 },
      { name: 7 },
    ]) {
      expect(said(wrong), JSON.stringify(wrong)).toThrow();
    }
  });

  it("have the type that is asked for", () => {
    const read = decodeBinary(encodeBinary(arrays));
    expect(() => arrayOf(read, "numbers", Float32Array)).toThrow("another type");
    expect(arrayOf(read, "none", Float32Array)).toBeNull();
    expect(() => needArray(read, "none", Float32Array)).toThrow("missing");
  });
});

describe("a surface", () => {
  const of = (triangles: number[]) =>
    surfaceOf(
      decodeBinary(
        encodeBinary([
          { name: "positions", shape: [3, 3], values: new Float32Array(9) },
          { name: "triangles", shape: [triangles.length / 3, 3], values: new Uint32Array(triangles) },
        ]),
      ),
    );
  it("has only vertices that are there", () => {
    expect(of([0, 1, 2]).triangles).toEqual(new Uint32Array([0, 1, 2]));
    expect(() => of([0, 1, 3])).toThrow("no such vertex");
  });
  it("is points when it has no triangles", () => {
    expect(of([]).triangles).toBeNull();
  });
});
