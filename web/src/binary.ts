// Arrays as bytes: "RHOLM1\0\0", u32 length of a JSON text, the text, arrays at multiples of 8.
import type { Surface } from "./protocol";

export type Numbers = Float32Array | Float64Array | Uint32Array | Uint8Array;
export interface NamedArray {
  shape: number[];
  values: Numbers;
}
export interface Binary {
  arrays: Map<string, NamedArray>;
  meta: Record<string, unknown>;
}

const magic = "RHOLM1\0\0";
const headLength = magic.length + 4;
const types = { f32: Float32Array, f64: Float64Array, u32: Uint32Array, u8: Uint8Array };

interface Entry {
  name: string;
  type: keyof typeof types;
  shape: number[];
  offset: number;
}

function isCount(value: unknown): value is number {
  return Number.isSafeInteger(value) && (value as number) >= 0;
}

function isEntry(value: unknown): value is Entry {
  const entry = value as Partial<Entry> | null;
  return (
    typeof entry?.name === "string" &&
    typeof entry.type === "string" &&
    Object.hasOwn(types, entry.type) &&
    Array.isArray(entry.shape) &&
    entry.shape.every(isCount) &&
    isCount(entry.offset)
  );
}

// Returns views of `bytes` where they are aligned, otherwise
// copies. Throws Error for incomplete or inconsistent bytes.
export function decodeBinary(bytes: Uint8Array): Binary {
  const head = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = String.fromCharCode(...bytes.subarray(0, magic.length));
  if (bytes.length < headLength || start !== magic) throw new Error("these bytes are no arrays");
  const textEnd = headLength + head.getUint32(magic.length, true);
  if (textEnd > bytes.length) throw new Error("arrays are cut off in their head");
  const text = new TextDecoder().decode(bytes.subarray(headLength, textEnd));
  const said = JSON.parse(text) as { arrays?: unknown; meta?: Record<string, unknown> };
  const arrays = new Map<string, NamedArray>();
  for (const entry of Array.isArray(said.arrays) ? (said.arrays as unknown[]) : []) {
    if (!isEntry(entry)) throw new Error("an array is described wrongly");
    arrays.set(entry.name, { shape: entry.shape, values: viewOf(bytes, entry, textEnd) });
  }
  return { arrays, meta: said.meta ?? {} };
}

function viewOf(bytes: Uint8Array, entry: Entry, least: number): Numbers {
  const type = types[entry.type];
  const count = entry.shape.reduce((product, side) => product * side, 1);
  const length = count * type.BYTES_PER_ELEMENT;
  if (entry.offset < least || entry.offset + length > bytes.length) {
    throw new Error(`array ${entry.name} is cut off`);
  }
  const at = bytes.byteOffset + entry.offset;
  if (at % type.BYTES_PER_ELEMENT === 0) return new type(bytes.buffer as ArrayBuffer, at, count);
  return new type(bytes.slice(entry.offset, entry.offset + length).buffer, 0, count);
}

// Returns the bytes of arrays in the format of decodeBinary().
export function encodeBinary(
  arrays: readonly { name: string; shape: number[]; values: Numbers }[],
  meta: Record<string, unknown> = {},
): Uint8Array {
  const nameOf = (values: Numbers): string => {
    if (values instanceof Float32Array) return "f32";
    if (values instanceof Float64Array) return "f64";
    return values instanceof Uint32Array ? "u32" : "u8";
  };
  const up = (length: number) => Math.ceil(length / 8) * 8;
  // Offsets are padded to 15 characters, so that the text's length does not depend on them.
  const describe = (first: number) => {
    let offset = first;
    const entries = arrays.map(({ name, shape, values }) => {
      const entry = `{"name":${JSON.stringify(name)},"type":"${nameOf(values)}","shape":${JSON.stringify(shape)},"offset":${String(offset).padStart(15)}}`;
      offset = up(offset + values.byteLength);
      return entry;
    });
    return { text: `{"arrays":[${entries.join(",")}],"meta":${JSON.stringify(meta)}}`, end: offset };
  };
  const encoder = new TextEncoder();
  const first = up(headLength + encoder.encode(describe(0).text).length);
  const { text, end } = describe(first);
  const bytes = new Uint8Array(end);
  bytes.set(encoder.encode(magic));
  new DataView(bytes.buffer).setUint32(magic.length, first - headLength, true);
  bytes.fill(32, headLength, first);
  bytes.set(encoder.encode(text), headLength);
  let offset = first;
  for (const { values } of arrays) {
    bytes.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), offset);
    offset = up(offset + values.byteLength);
  }
  return bytes;
}

type Type<T> = new (length: number) => T;

// Returns the array of this name and type, or null if there is none.
export function arrayOf<T extends Numbers>(binary: Binary, name: string, type: Type<T>): T | null {
  const values = binary.arrays.get(name)?.values;
  if (values === undefined) return null;
  if (!(values instanceof type)) throw new Error(`array ${name} has another type`);
  return values;
}

// Returns the array of this name and type; throws Error if there is none.
export function needArray<T extends Numbers>(binary: Binary, name: string, type: Type<T>): T {
  const values = arrayOf(binary, name, type);
  if (values === null) throw new Error(`array ${name} is missing`);
  return values;
}

// Returns the surface in the answer to api/item/ID/surface; checks indices.
export function surfaceOf(binary: Binary): Surface {
  const positions = needArray(binary, "positions", Float32Array);
  const triangles = arrayOf(binary, "triangles", Uint32Array);
  const count = positions.length / 3;
  if (triangles?.some((vertex) => vertex >= count)) throw new Error("a face has no such vertex");
  return {
    positions,
    triangles: triangles?.length ? triangles : null,
    normals: arrayOf(binary, "normals", Float32Array),
    colors: arrayOf(binary, "colors", Uint8Array),
    labels: arrayOf(binary, "labels", Uint32Array),
    offending: arrayOf(binary, "offending", Uint32Array),
  };
}
