// Regions of a surface with smooth borders. With labels of vertices
// alone, each border would follow the edges of the mesh in a zigzag.

// Pieces of triangles with one label each; their corners are given as weights of the triangle's corners.
export interface Seams {
  labels: Uint32Array; // [n], of vertices; isolated labels are replaced by labels around
  faces: Uint32Array; // [3 k], corners of the mesh's triangle that contains piece k
  weights: Float32Array; // [9 k], weights of these corners at each corner of the piece
  pieceLabels: Uint32Array; // label of each piece, [k]
}

type Shares = Map<number, number>; // share of each label at a vertex; the sum is 1
type Point = readonly [number, number, number]; // weights of a triangle's corners

const rounds = 8; // chosen: a border moves by less than two edges, and zigzags of one edge disappear

// Returns the shares of labels around each vertex near a border; undefined for other vertices.
function sharesOf(triangles: Uint32Array, labels: Uint32Array): (Shares | undefined)[] {
  const near = new Uint8Array(labels.length);
  const corners = (t: number) => [triangles[t] ?? 0, triangles[t + 1] ?? 0, triangles[t + 2] ?? 0] as const;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = corners(t);
    if (labels[a] !== labels[b] || labels[b] !== labels[c]) near[a] = near[b] = near[c] = 1;
  }
  for (let ring = 2; ring <= rounds; ++ring) {
    for (let t = 0; t < triangles.length; t += 3) {
      const own = corners(t);
      if (!own.some((v) => near[v] === ring - 1)) continue;
      for (const v of own) near[v] ||= ring;
    }
  }
  const around = new Map<number, Set<number>>();
  for (let t = 0; t < triangles.length; t += 3) {
    const own = corners(t);
    for (const v of own) {
      if (!near[v]) continue;
      const others = around.get(v) ?? new Set();
      for (const other of own) if (other !== v) others.add(other);
      around.set(v, others);
    }
  }
  const whole = (v: number): Shares => new Map([[labels[v] ?? 0, 1]]);
  let shares: (Shares | undefined)[] = Array.from(near, (ring, v) => (ring ? whole(v) : undefined));
  for (let round = 0; round < rounds; ++round) {
    const next = shares.slice();
    for (const [v, others] of around) {
      const mean: Shares = new Map();
      const add = (from: Shares, weight: number) => {
        for (const [label, share] of from) mean.set(label, (mean.get(label) ?? 0) + weight * share);
      };
      add(shares[v] ?? whole(v), 0.5);
      for (const other of others) add(shares[other] ?? whole(other), 0.5 / others.size);
      next[v] = mean;
    }
    shares = next;
  }
  return shares;
}

function most(shares: Shares): number {
  let best = 0;
  let found = -1;
  for (const [label, share] of shares) {
    if (share > found || (share === found && label < best)) [best, found] = [label, share];
  }
  return best;
}

// Returns the part of a polygon where a function that is linear on the triangle is not negative.
function cut(polygon: readonly Point[], value: (p: Point) => number): Point[] {
  const kept: Point[] = [];
  polygon.forEach((p, i) => {
    const q = polygon[(i + 1) % polygon.length] ?? p;
    const [f, g] = [value(p), value(q)];
    if (f >= 0) kept.push(p);
    if (f < 0 === g < 0) return;
    const t = f / (f - g);
    kept.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])]);
  });
  return kept;
}

const whole: readonly Point[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

export function seamsOf(triangles: Uint32Array, labels: Uint32Array): Seams {
  const shares = sharesOf(triangles, labels);
  const smooth = labels.map((label, v) => (shares[v] ? most(shares[v]) : label));
  const faces: number[] = [];
  const weights: number[] = [];
  const pieceLabels: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = triangles.subarray(t, t + 3);
    const there = new Set(Array.from(corners, (v) => smooth[v] ?? 0));
    if (there.size === 1) continue;
    const shareOf = (label: number) => Array.from(corners, (v) => shares[v]?.get(label) ?? 0);
    for (const label of there) {
      const own = shareOf(label);
      let piece: readonly Point[] = whole;
      for (const other of there) {
        if (other === label) continue;
        const lead = shareOf(other).map((share, k) => (own[k] ?? 0) - share);
        piece = cut(piece, (p) => p.reduce((sum, weight, k) => sum + weight * (lead[k] ?? 0), 0));
      }
      for (let k = 2; k < piece.length; ++k) {
        faces.push(...corners);
        weights.push(...(piece[0] ?? []), ...(piece[k - 1] ?? []), ...(piece[k] ?? []));
        pieceLabels.push(label);
      }
    }
  }
  return {
    labels: smooth,
    faces: Uint32Array.from(faces),
    weights: Float32Array.from(weights),
    pieceLabels: Uint32Array.from(pieceLabels),
  };
}

// Interpolates vectors of vertices, [n, 3], at the corners of the pieces.
export function atPieces(seams: Seams, vectors: ArrayLike<number>): Float32Array {
  const out = new Float32Array(seams.weights.length);
  for (let i = 0; i < seams.pieceLabels.length; ++i) {
    for (let corner = 0; corner < 3; ++corner) {
      for (let k = 0; k < 3; ++k) {
        const weight = seams.weights[9 * i + 3 * corner + k] ?? 0;
        const v = seams.faces[3 * i + k] ?? 0;
        for (let x = 0; x < 3; ++x) {
          const at = 9 * i + 3 * corner + x;
          out[at] = (out[at] ?? 0) + weight * (vectors[3 * v + x] ?? 0);
        }
      }
    }
  }
  return out;
}
