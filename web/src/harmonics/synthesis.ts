// Evaluates a function on the sphere from its coefficients, on a grid of rings.
// Going from one degree to a higher one costs only the degrees between them.
import { factors, nextDegree, startColumn, type Column, type Factors } from "./legendre";
import { fourierPlan, ringSums, type Plan } from "./fourier";

export interface Coefficients {
  degree: number; // L
  values: Float64Array; // [2][L+1][L+1]: of cos(m phi), of sin(m phi); degree, order
}

export interface Grid {
  rings: number; // even; colatitudes (j + 1/2) pi / rings
  meridians: number; // a power of 2; longitudes 2 pi k / meridians
}

// Returns a grid with rings = meridians / 2, which resolves degree L up to `most` meridians.
export function gridFor(degree: number, most = 1024): Grid {
  // At least four vertices per wave, and 256, so that low degrees look smooth.
  const meridians = Math.min(most, Math.max(256, 2 ** Math.ceil(Math.log2(4 * (degree + 1)))));
  return { rings: meridians / 2, meridians };
}

// Sums over degrees of one ring and its mirror image. Sums of even
// and odd l + m are separate, because P_lm(-x) = (-1)^(l+m) P_lm(x).
interface RingPair {
  column: Column;
  evenCos: Float64Array; // [L+1], by order
  evenSin: Float64Array;
  oddCos: Float64Array;
  oddSin: Float64Array;
}

export interface Synthesis {
  coefficients: Coefficients;
  grid: Grid;
  degree: number; // highest summed degree
  pairs: RingPair[];
  plan: Plan;
  // [rings][meridians] values, then the values at the poles, north and south.
  values: Float64Array;
  poles: [north: number, south: number];
}

const factorCache: Factors[] = [];
function factorsOf(l: number): Factors {
  for (let k = factorCache.length; k <= l; ++k) factorCache.push(factors(k));
  return factorCache[l] ?? factors(l);
}

export function startSynthesis(coefficients: Coefficients, grid: Grid): Synthesis {
  const values = new Float64Array(grid.rings * grid.meridians + 2);
  const synthesis: Synthesis = {
    coefficients,
    grid,
    degree: -1,
    pairs: [],
    plan: fourierPlan(grid.meridians),
    values,
    poles: [0, 0],
  };
  restart(synthesis);
  return synthesis;
}

function restart(synthesis: Synthesis): void {
  const { rings } = synthesis.grid;
  const top = synthesis.coefficients.degree;
  const zeros = () => new Float64Array(top + 1);
  synthesis.pairs = Array.from({ length: rings / 2 }, (_, j) => ({
    column: startColumn(((j + 0.5) * Math.PI) / rings, top),
    evenCos: zeros(),
    evenSin: zeros(),
    oddCos: zeros(),
    oddSin: zeros(),
  }));
  synthesis.poles = [0, 0];
  synthesis.degree = -1;
}

function addDegree(synthesis: Synthesis, l: number): void {
  const { degree: top, values } = synthesis.coefficients;
  const side = top + 1;
  const step = l === 0 ? null : factorsOf(l);
  const cosines = values.subarray(l * side, l * side + l + 1);
  const sines = values.subarray((side + l) * side, (side + l) * side + l + 1);
  for (const pair of synthesis.pairs) {
    if (step) nextDegree(pair.column, step);
    const { now } = pair.column;
    for (let m = 0; m <= l; ++m) {
      const even = (l + m) % 2 === 0;
      const cos = even ? pair.evenCos : pair.oddCos;
      const sin = even ? pair.evenSin : pair.oddSin;
      const p = now[m] ?? 0;
      cos[m] = (cos[m] ?? 0) + p * (cosines[m] ?? 0);
      sin[m] = (sin[m] ?? 0) + p * (sines[m] ?? 0);
    }
  }
  // At the poles all orders but 0 vanish: P_l0(+-1) = (+-1)^l sqrt((2l+1) / (4 pi)).
  const atPole = Math.sqrt((2 * l + 1) / (4 * Math.PI)) * (cosines[0] ?? 0);
  synthesis.poles[0] += atPole;
  synthesis.poles[1] += l % 2 === 0 ? atPole : -atPole;
}

// Sums degrees 0 ... degree (at most L) into synthesis.values.
export function sumTo(synthesis: Synthesis, degree: number): Float64Array {
  const wanted = Math.min(Math.max(0, Math.round(degree)), synthesis.coefficients.degree);
  if (wanted === synthesis.degree) return synthesis.values;
  if (wanted < synthesis.degree) restart(synthesis);
  for (let l = synthesis.degree + 1; l <= wanted; ++l) addDegree(synthesis, l);
  synthesis.degree = wanted;
  const { plan, values, pairs } = synthesis;
  const { rings, meridians } = synthesis.grid;
  const cos = new Float64Array(wanted + 1);
  const sin = new Float64Array(wanted + 1);
  pairs.forEach((pair, j) => {
    for (const [ring, sign] of [
      [j, 1],
      [rings - 1 - j, -1],
    ] as const) {
      for (let m = 0; m <= wanted; ++m) {
        cos[m] = (pair.evenCos[m] ?? 0) + sign * (pair.oddCos[m] ?? 0);
        sin[m] = (pair.evenSin[m] ?? 0) + sign * (pair.oddSin[m] ?? 0);
      }
      ringSums(plan, cos, sin);
      values.set(plan.re, ring * meridians);
    }
  });
  values.set(synthesis.poles, rings * meridians);
  return values;
}

// Returns the energy of degrees 0 ... L: the sum of the squares over orders.
export function powerOf({ degree, values }: Coefficients): number[] {
  const side = degree + 1;
  return Array.from({ length: side }, (_, l) => {
    let sum = 0;
    for (let m = 0; m <= l; ++m) {
      sum += (values[l * side + m] ?? 0) ** 2 + (values[(side + l) * side + m] ?? 0) ** 2;
    }
    return sum;
  });
}
