// Data of the viewer, and their bytes: arrays "coefficients" f64 [2][L+1][L+1], and "positions" and
// "triangles" of the original shape (if included). The meta data are
//   {title, unit, expansion: {degree, function, center}, error: [[degree, rms, max] ...],
//    power: [...], tail: {strength} | null}; error, power and tail may be left out.
import { arrayOf, decodeBinary, needArray } from "./binary";
import { powerOf, type Coefficients } from "./harmonics/synthesis";
import type { Vector } from "./protocol";

export interface ViewData {
  title: string;
  unit: string; // unit of lengths, or empty
  expansion: {
    degree: number;
    function: string; // "radius", "gauge", "log radius"
    center: Vector;
    coefficients: Float64Array; // real orthonormal, without Condon-Shortley phase
  };
  mesh: { positions: Float32Array; triangles: Uint32Array } | null;
  error: [degree: number, rms: number | null, max: number | null][];
  power: number[]; // energy of degrees 0 ... L
  tail: { strength: number } | null;
}

interface Meta {
  title?: string;
  unit?: string;
  expansion?: { degree?: number; function?: string; center?: Vector };
  error?: ViewData["error"];
  power?: number[];
  tail?: ViewData["tail"];
}

export function coefficientsOf({ expansion }: ViewData): Coefficients {
  return { degree: expansion.degree, values: expansion.coefficients };
}

// Throws Error for other bytes.
export function decodeViewData(bytes: Uint8Array): ViewData {
  const binary = decodeBinary(bytes);
  const meta = binary.meta as Meta;
  const values = needArray(binary, "coefficients", Float64Array);
  const degree = Math.round(Math.sqrt(values.length / 2)) - 1;
  if (degree < 0 || values.length !== 2 * (degree + 1) ** 2) {
    throw new Error("the coefficients are no two squares");
  }
  const positions = arrayOf(binary, "positions", Float32Array);
  const triangles = arrayOf(binary, "triangles", Uint32Array);
  if (triangles?.some((vertex) => 3 * vertex >= (positions?.length ?? 0))) {
    throw new Error("a face has no such vertex");
  }
  const mesh = positions && triangles?.length ? { positions, triangles } : null;
  return {
    title: meta.title ?? "",
    unit: meta.unit ?? "",
    expansion: {
      degree,
      function: meta.expansion?.function ?? "radius",
      center: meta.expansion?.center ?? [0, 0, 0],
      coefficients: values,
    },
    mesh,
    error: meta.error ?? [],
    power: meta.power ?? powerOf({ degree, values }),
    tail: meta.tail ?? null,
  };
}

// Returns the bytes of base64 text, as in a page's <script>.
export function fromBase64(text: string): Uint8Array {
  return Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
}
