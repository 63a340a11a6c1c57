// Associated Legendre functions of the real orthonormal harmonics without Condon-Shortley phase:
//   Y_lm = N_lm P_lm(cos theta) cos(m phi) or sin(m phi),  int Y_lm^2 dOmega = 1.
// By degrees at fixed order (Holmes and Featherstone 2002, section 2.1):
//   P_lm = a_lm (cos theta P_{l-1,m} - b_lm P_{l-2,m}),  P_mm = sqrt((2m+1)/(2m)) sin theta P_{m-1,m-1}.
// Near the poles P_mm underflows from some order on. Up to degree 512
// all P_lm of these orders are below 1e-200, so zero is accurate enough.

const firstOrder = Math.sqrt(3); // P_11 / (sin theta P_00), with the root of 2 of orders above 0

export interface Factors {
  a: Float64Array; // [l+1], of orders 0 ... l-1; the last is not used
  b: Float64Array;
}

// Returns the factors of degree l >= 1.
export function factors(l: number): Factors {
  const a = new Float64Array(l + 1);
  const b = new Float64Array(l + 1);
  for (let m = 0; m < l; ++m) {
    a[m] = Math.sqrt((4 * l * l - 1) / (l * l - m * m));
    b[m] = l < 2 ? 0 : Math.sqrt(((l - 1) ** 2 - m * m) / (4 * (l - 1) ** 2 - 1));
  }
  return { a, b };
}

// Functions of one colatitude, computed degree by degree.
export interface Column {
  degree: number;
  cos: number;
  sin: number;
  now: Float64Array; // [top + 1], P_lm of orders 0 ... degree
  before: Float64Array; // P_lm of degree - 1
}

export function startColumn(theta: number, top: number): Column {
  const now = new Float64Array(top + 1);
  now[0] = Math.sqrt(1 / (4 * Math.PI));
  return { degree: 0, cos: Math.cos(theta), sin: Math.sin(theta), now, before: new Float64Array(top + 1) };
}

// Proceeds to the next degree with its factors.
export function nextDegree(column: Column, { a, b }: Factors): void {
  const { now, before, cos, sin } = column;
  const l = ++column.degree;
  for (let m = 0; m < l; ++m) {
    // Overwrites the degree before the last, which is not needed again.
    before[m] = (a[m] ?? 0) * (cos * (now[m] ?? 0) - (b[m] ?? 0) * (before[m] ?? 0));
  }
  const ratio = l === 1 ? firstOrder : Math.sqrt((2 * l + 1) / (2 * l));
  before[l] = ratio * sin * (now[l - 1] ?? 0);
  column.now = before;
  column.before = now;
}
