import { describe, expect, it } from "vitest";
import { fourierPlan, ringSums } from "../src/harmonics/fourier";
import { factors, nextDegree, startColumn } from "../src/harmonics/legendre";
import { gridDirections, gridTriangles, placeVertices, radiusOf } from "../src/harmonics/surface";
import {
  gridFor,
  powerOf,
  startSynthesis,
  sumTo,
  type Coefficients,
  type Grid,
} from "../src/harmonics/synthesis";

function zeros(degree: number): Coefficients {
  return { degree, values: new Float64Array(2 * (degree + 1) ** 2) };
}
function set(c: Coefficients, part: 0 | 1, l: number, m: number, value: number): void {
  const side = c.degree + 1;
  c.values[(part * side + l) * side + m] = value;
}
// Returns pseudo-random numbers in -1 ... 1, equal in every run (linear congruence, Knuth's MMIX).
function* numbers(): Generator<number, never> {
  for (let state = 1n; ; ) {
    state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
    yield Number(state >> 11n) / 2 ** 52 - 1;
  }
}
function random(degree: number): Coefficients {
  const c = zeros(degree);
  const next = numbers();
  for (let l = 0; l <= degree; ++l) {
    for (let m = 0; m <= l; ++m) {
      set(c, 0, l, m, next.next().value);
      if (m > 0) set(c, 1, l, m, next.next().value);
    }
  }
  return c;
}
// Returns the weights of Fejér's first rule on the grid's colatitudes: exact to degree rings - 1 (Waldvogel 2006).
function weights(rings: number): number[] {
  return Array.from({ length: rings }, (_, j) => {
    const theta = ((j + 0.5) * Math.PI) / rings;
    let sum = 1;
    for (let k = 1; k <= rings / 2; ++k) {
      const term = Math.cos(2 * k * theta) / (4 * k * k - 1);
      sum -= 2 * term;
    }
    return (2 / rings) * sum;
  });
}
function integral({ rings, meridians }: Grid, f: (i: number) => number): number {
  let sum = 0;
  weights(rings).forEach((w, j) => {
    for (let k = 0; k < meridians; ++k) sum += w * f(j * meridians + k);
  });
  return (sum * 2 * Math.PI) / meridians;
}

const small: Grid = { rings: 32, meridians: 64 };

describe("harmonics of low degrees are their closed forms", () => {
  const root = (x: number) => Math.sqrt(x / Math.PI);
  const forms: [string, 0 | 1, number, number, (x: number, y: number, z: number) => number][] = [
    ["Y_00", 0, 0, 0, () => root(1 / 4)],
    ["Y_10", 0, 1, 0, (_x, _y, z) => root(3 / 4) * z],
    ["Y_11 cos", 0, 1, 1, (x) => root(3 / 4) * x],
    ["Y_11 sin", 1, 1, 1, (_x, y) => root(3 / 4) * y],
    ["Y_20", 0, 2, 0, (_x, _y, z) => root(5 / 16) * (3 * z * z - 1)],
    ["Y_21 sin", 1, 2, 1, (_x, y, z) => root(15 / 4) * y * z],
    ["Y_22 cos", 0, 2, 2, (x, y) => root(15 / 16) * (x * x - y * y)],
    ["Y_22 sin", 1, 2, 2, (x, y) => root(15 / 4) * x * y],
    ["Y_32 cos", 0, 3, 2, (x, y, z) => root(105 / 16) * z * (x * x - y * y)],
    ["Y_40", 0, 4, 0, (_x, _y, z) => root(9 / 256) * (35 * z ** 4 - 30 * z * z + 3)],
  ];
  it.each(forms)("%s", (_, part, l, m, form) => {
    const c = zeros(6);
    set(c, part, l, m, 1);
    const values = sumTo(startSynthesis(c, small), 6);
    const u = gridDirections(small);
    values.forEach((value, i) => {
      // Directions are in single precision.
      const exact = form(u[3 * i] ?? NaN, u[3 * i + 1] ?? NaN, u[3 * i + 2] ?? NaN);
      expect(Math.abs(value - exact)).toBeLessThan(3e-6);
    });
  });
});

describe("the recurrence", () => {
  // The colatitudes are near the poles, where sines are small, in between, and at the equator.
  it.each([1e-4, 0.003, 0.1, 0.7, Math.PI / 2, 3.1])(
    "keeps the addition theorem to degree 512 at colatitude %f",
    (theta) => {
      const column = startColumn(theta, 512);
      for (let l = 1; l <= 512; ++l) {
        nextDegree(column, factors(l));
        let sum = 0;
        for (let m = 0; m <= l; ++m) sum += (column.now[m] ?? NaN) ** 2;
        // Where cos theta = 1, the rounding of a step grows with each later step: l^2 / 2 of 1.1e-16.
        expect(Math.abs((sum * 4 * Math.PI) / (2 * l + 1) - 1)).toBeLessThan(1.5e-11);
      }
    },
  );

  it("sums products at two places to a Legendre polynomial", () => {
    const [first, other] = [0.4, 1.9];
    const a = startColumn(first, 60);
    const b = startColumn(other, 60);
    const x = Math.cos(first - other); // on one meridian
    let [before, now] = [1, x];
    for (let l = 1; l <= 60; ++l) {
      nextDegree(a, factors(l));
      nextDegree(b, factors(l));
      const sum = a.now.slice(0, l + 1).reduce((total, p, m) => total + p * (b.now[m] ?? NaN), 0);
      expect((sum * 4 * Math.PI) / (2 * l + 1)).toBeCloseTo(now, 12);
      [before, now] = [now, ((2 * l + 1) * x * now - l * before) / (l + 1)];
    }
  });
});

describe("sums on the grid", () => {
  it("have the energy of their coefficients (Parseval)", () => {
    const c = random(14); // squares have degree 28 < 32 rings
    const values = sumTo(startSynthesis(c, small), 14);
    const energy = powerOf(c).reduce((sum, e) => sum + e, 0);
    expect(integral(small, (i) => (values[i] ?? NaN) ** 2) / energy).toBeCloseTo(1, 13);
  });

  it("are orthonormal: each degree adds its own energy", () => {
    const c = random(14);
    const synthesis = startSynthesis(c, small);
    let sum = 0;
    powerOf(c).forEach((energy, l) => {
      sum += energy;
      const values = sumTo(synthesis, l);
      expect(integral(small, (i) => (values[i] ?? NaN) ** 2)).toBeCloseTo(sum, 10);
    });
  });

  it("are the same on any way between degrees", () => {
    const c = random(40);
    const grid = gridFor(40);
    const straight = sumTo(startSynthesis(c, grid), 17).slice();
    const synthesis = startSynthesis(c, grid);
    for (const degree of [3, 40, 0, 12]) sumTo(synthesis, degree);
    expect(sumTo(synthesis, 17)).toEqual(straight);
  });

  it("at degree 512 are direct sums", () => {
    const c = random(512);
    const grid = gridFor(512);
    expect(grid).toEqual({ rings: 512, meridians: 1024 });
    const values = sumTo(startSynthesis(c, grid), 512);
    for (const [j, k] of [
      [0, 5],
      [100, 1000],
      [300, 1],
      [511, 512],
    ] as const) {
      const column = startColumn(((j + 0.5) * Math.PI) / grid.rings, 512);
      const phi = (2 * Math.PI * k) / grid.meridians;
      let sum = 0;
      for (let l = 0; l <= 512; ++l) {
        if (l > 0) nextDegree(column, factors(l));
        for (let m = 0; m <= l; ++m) {
          const cos = c.values[l * 513 + m] ?? NaN;
          const sin = c.values[(513 + l) * 513 + m] ?? NaN;
          sum += (column.now[m] ?? NaN) * (cos * Math.cos(m * phi) + sin * Math.sin(m * phi));
        }
      }
      // There are 131 000 terms of size 1: rounding is about 1e-16 times their root, times its growth.
      expect(values[j * grid.meridians + k]).toBeCloseTo(sum, 9);
    }
  });

  it("at the poles go on from the rings", () => {
    const c = random(3);
    const fine: Grid = { rings: 2048, meridians: 8 };
    const values = sumTo(startSynthesis(c, fine), 3);
    const mean = (ring: number) =>
      values.slice(8 * ring, 8 * ring + 8).reduce((sum, value) => sum + value, 0) / 8;
    // The mean over a ring differs from the value at the pole by the square of its angle, here 6e-7 x l(l+1)/4.
    expect(values[8 * 2048]).toBeCloseTo(mean(0), 4);
    expect(values[8 * 2048 + 1]).toBeCloseTo(mean(2047), 4);
  });
});

it("a ring's sums are those of its orders one by one", () => {
  const plan = fourierPlan(16);
  const next = numbers();
  const take = () => Float64Array.from({ length: 9 }, () => next.next().value);
  const [a, b] = [take(), take()];
  ringSums(plan, a, b);
  plan.re.forEach((value, j) => {
    let sum = 0;
    a.forEach((cos, m) => {
      const angle = (2 * Math.PI * m * j) / 16;
      sum += cos * Math.cos(angle) + (b[m] ?? NaN) * Math.sin(angle);
    });
    expect(value).toBeCloseTo(sum, 13);
  });
  expect(() => fourierPlan(12)).toThrow("no power of 2");
});

describe("the surface", () => {
  const sphere = zeros(2);
  set(sphere, 0, 0, 0, 2 * Math.sqrt(4 * Math.PI));

  const build = (c: Coefficients, grid: Grid, center: [number, number, number], name = "radius") => {
    const radii = sumTo(startSynthesis(c, grid), c.degree).map(radiusOf(name));
    const out = new Float32Array(3 * radii.length);
    placeVertices(gridDirections(grid), radii, center, out);
    return out;
  };

  it("of degree 0 alone is a sphere about the centre", () => {
    const places = build(sphere, small, [1, -2, 3]);
    for (let i = 0; i < places.length; i += 3) {
      const r = Math.hypot((places[i] ?? 0) - 1, (places[i + 1] ?? 0) + 2, (places[i + 2] ?? 0) - 3);
      expect(r).toBeCloseTo(2, 5);
    }
  });

  it("of degree 1 is a sphere moved by its coefficients, to first order", () => {
    const c = zeros(1);
    set(c, 0, 0, 0, Math.sqrt(4 * Math.PI));
    const shift = 1e-3;
    set(c, 0, 1, 0, shift * Math.sqrt((4 * Math.PI) / 3));
    const places = build(c, small, [0, 0, 0]);
    for (let i = 0; i < places.length; i += 3) {
      const r = Math.hypot(places[i] ?? 0, places[i + 1] ?? 0, (places[i + 2] ?? 0) - shift);
      expect(Math.abs(r - 1)).toBeLessThan(2 * shift ** 2 + 1e-6);
    }
  });

  it("of a gauge is one over it", () => {
    // q = 1 - e + 3 e u_z^2 = 1/r, so that r (1 - e) + 3 e z^2 / r = 1.
    const e = 0.1;
    const c = zeros(2);
    set(c, 0, 0, 0, Math.sqrt(4 * Math.PI));
    set(c, 0, 2, 0, e * Math.sqrt((16 * Math.PI) / 5));
    const places = build(c, small, [0, 0, 0], "gauge");
    for (let i = 0; i < places.length; i += 3) {
      const [x, y, z] = [places[i] ?? NaN, places[i + 1] ?? NaN, places[i + 2] ?? NaN];
      const r = Math.hypot(x, y, z);
      expect(r * (1 - e) + (3 * e * z * z) / r).toBeCloseTo(1, 5);
    }
  });

  it("of a sphere has the sphere's volume, faces outwards, closed", () => {
    const grid = small;
    const places = build(sphere, grid, [0, 0, 0]);
    const triangles = gridTriangles(grid);
    const edges = new Set<number>();
    const count = places.length / 3;
    let six = 0;
    for (let t = 0; t < triangles.length; t += 3) {
      const [a = 0, b = 0, c = 0] = triangles.subarray(t, t + 3);
      for (const [v, w] of [
        [a, b],
        [b, c],
        [c, a],
      ] as const) {
        expect(edges.has(v * count + w)).toBe(false);
        edges.add(v * count + w);
      }
      const at = (v: number, k: number) => places[3 * v + k] ?? NaN;
      six +=
        at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) +
        at(a, 1) * (at(b, 2) * at(c, 0) - at(b, 0) * at(c, 2)) +
        at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0));
    }
    for (const edge of edges) {
      expect(edges.has((edge % count) * count + Math.floor(edge / count))).toBe(true);
    }
    // The surface is inscribed, so its volume is smaller, by some (2 pi / 64)^2.
    const share = six / 6 / ((32 * Math.PI) / 3);
    expect(share).toBeLessThan(1);
    expect(share).toBeGreaterThan(1 - ((2 * Math.PI) / 64) ** 2);
  });
});
