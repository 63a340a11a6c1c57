// Sums over orders on a ring: f_j = sum_m A_m cos(m phi_j) + B_m sin(m phi_j), phi_j = 2 pi j
// / n. Uses a transform of length n, a power of 2 (Cooley and Tukey 1965, radix 2, in place).

export interface Plan {
  size: number;
  cos: Float64Array; // [size / 2], of 2 pi k / size
  sin: Float64Array;
  reversed: Uint32Array; // [size], the reversed bits of each index
  re: Float64Array; // [size], work space and result
  im: Float64Array;
}

// Throws RangeError for a size that is no power of 2.
export function fourierPlan(size: number): Plan {
  const bits = Math.log2(size);
  if (!Number.isInteger(bits)) throw new RangeError(`${size} is no power of 2`);
  const half = size / 2;
  const reversed = new Uint32Array(size);
  for (let i = 1; i < size; ++i) {
    reversed[i] = ((reversed[i >> 1] ?? 0) >> 1) | (i & 1 ? half : 0);
  }
  const angle = (k: number) => (2 * Math.PI * k) / size;
  return {
    size,
    cos: Float64Array.from({ length: half }, (_, k) => Math.cos(angle(k))),
    sin: Float64Array.from({ length: half }, (_, k) => Math.sin(angle(k))),
    reversed,
    re: new Float64Array(size),
    im: new Float64Array(size),
  };
}

// Leaves f in plan.re. Orders from `size` on are ignored: no ring is so coarse.
export function ringSums(plan: Plan, a: Float64Array, b: Float64Array): void {
  const { size, reversed, re, im } = plan;
  re.fill(0);
  im.fill(0);
  // f is the real part of sum_m (A_m - i B_m) exp(i m phi).
  const orders = Math.min(size, a.length);
  for (let m = 0; m < orders; ++m) {
    const at = reversed[m] ?? 0;
    re[at] = a[m] ?? 0;
    im[at] = -(b[m] ?? 0);
  }
  for (let length = 2; length <= size; length *= 2) butterflies(plan, length);
}

function butterflies({ size, cos, sin, re, im }: Plan, length: number): void {
  const half = length / 2;
  const stride = size / length;
  for (let start = 0; start < size; start += length) {
    for (let k = 0; k < half; ++k) {
      const i = start + k;
      const j = i + half;
      const c = cos[k * stride] ?? 0;
      const s = sin[k * stride] ?? 0;
      const x = re[j] ?? 0;
      const y = im[j] ?? 0;
      const u = x * c - y * s;
      const v = x * s + y * c;
      const p = re[i] ?? 0;
      const q = im[i] ?? 0;
      re[j] = p - u;
      im[j] = q - v;
      re[i] = p + u;
      im[i] = q + v;
    }
  }
}
