// Normals of vertices, weighted by area, as in the studio.

// Returns triangles whose corners are the first of all vertices at the same place, so that a
// surface cut by a seam of the file is joined. Returns the same array if all places differ.
export function joinedTriangles(positions: Float32Array, triangles: Uint32Array): Uint32Array {
  const first = firstAtPlace(positions);
  return first ? triangles.map((v) => first[v] ?? v) : triangles;
}

// Returns for each vertex the first one with the same coordinates; null if all differ.
function firstAtPlace(positions: Float32Array): Uint32Array | null {
  const count = positions.length / 3;
  const bits = new Uint32Array(positions.map((x) => x + 0).buffer); // maps -0 to 0
  const first = new Uint32Array(count);
  let size = 4;
  while (size < 2 * count) size *= 2;
  const table = new Uint32Array(size); // vertices, from 1 on, by their places; 0 is free
  let different = true;
  for (let v = 0; v < count; ++v) {
    const [x = 0, y = 0, z = 0] = [bits[3 * v], bits[3 * v + 1], bits[3 * v + 2]];
    // Chosen: the multipliers of the spatial hash by Teschner and others, mixed once more.
    const mixed = Math.imul(x, 73856093) ^ Math.imul(y, 19349663) ^ Math.imul(z, 83492791);
    let slot = Math.imul(mixed ^ (mixed >>> 15), 0x9e3779b1) & (size - 1);
    first[v] = v;
    for (let known = table[slot]; known; slot = (slot + 1) & (size - 1), known = table[slot]) {
      const at = 3 * (known - 1);
      if (bits[at] === x && bits[at + 1] === y && bits[at + 2] === z) {
        first[v] = known - 1;
        different = false;
        break;
      }
    }
    if (first[v] === v) table[slot] = v + 1;
  }
  return different ? null : first;
}

// Writes unit normals [n, 3] of all vertices, or of the vertices flagged in `touched` [n]. `joined` is
// joinedTriangles(); a vertex outside these triangles has the normal of the first one at its place.
export function vertexNormals(
  positions: Float32Array,
  triangles: Uint32Array,
  joined: Uint32Array,
  normals: Float32Array,
  touched?: Uint8Array,
): void {
  sumNormals(positions, joined, normals, touched);
  if (joined === triangles) return;
  for (let i = 0; i < triangles.length; ++i) {
    const [from = 0, to = 0] = [joined[i], triangles[i]];
    if (from !== to) normals.copyWithin(3 * to, 3 * from, 3 * from + 3);
  }
}

function sumNormals(
  positions: Float32Array,
  triangles: Uint32Array,
  normals: Float32Array,
  touched?: Uint8Array,
): void {
  for (let v = 0; v < positions.length / 3; ++v) {
    if (touched && !touched[v]) continue;
    normals.fill(0, 3 * v, 3 * v + 3);
  }
  for (let t = 0; t < triangles.length; t += 3) {
    const a = triangles[t] ?? 0;
    const b = triangles[t + 1] ?? 0;
    const c = triangles[t + 2] ?? 0;
    if (touched && !touched[a] && !touched[b] && !touched[c]) continue;
    addFace(positions, normals, [a, b, c], touched);
  }
  for (let v = 0; v < positions.length; v += 3) {
    if (touched && !touched[v / 3]) continue;
    const x = normals[v] ?? 0;
    const y = normals[v + 1] ?? 0;
    const z = normals[v + 2] ?? 0;
    const scale = 1 / (Math.hypot(x, y, z) || 1);
    normals[v] = x * scale;
    normals[v + 1] = y * scale;
    normals[v + 2] = z * scale;
  }
}

function addFace(
  positions: Float32Array,
  normals: Float32Array,
  corners: [number, number, number],
  touched?: Uint8Array,
): void {
  const [a, b, c] = corners;
  const at = (v: number, k: number) => positions[3 * v + k] ?? 0;
  const ux = at(b, 0) - at(a, 0);
  const uy = at(b, 1) - at(a, 1);
  const uz = at(b, 2) - at(a, 2);
  const vx = at(c, 0) - at(a, 0);
  const vy = at(c, 1) - at(a, 1);
  const vz = at(c, 2) - at(a, 2);
  const nx = uy * vz - uz * vy;
  const ny = uz * vx - ux * vz;
  const nz = ux * vy - uy * vx;
  for (const v of corners) {
    if (touched && !touched[v]) continue;
    normals[3 * v] = (normals[3 * v] ?? 0) + nx;
    normals[3 * v + 1] = (normals[3 * v + 1] ?? 0) + ny;
    normals[3 * v + 2] = (normals[3 * v + 2] ?? 0) + nz;
  }
}

// Flags the vertices whose normals change when the vertices `moved` move: all corners of their faces. [n], 0 or 1.
export function aroundVertices(
  count: number,
  triangles: Uint32Array,
  moved: readonly Uint32Array[],
): Uint8Array {
  const flags = new Uint8Array(count);
  for (const some of moved) for (const v of some) flags[v] = 1;
  const around = flags.slice();
  for (let t = 0; t < triangles.length; t += 3) {
    const a = triangles[t] ?? 0;
    const b = triangles[t + 1] ?? 0;
    const c = triangles[t + 2] ?? 0;
    if (flags[a] || flags[b] || flags[c]) around[a] = around[b] = around[c] = 1;
  }
  return around;
}

interface Ball {
  center: [number, number, number];
  radius: number;
}

// Returns a ball around one or two others; the unit ball if there are none.
export function ballAround([a, b]: readonly Ball[]): Ball {
  if (!a || !b) return a ?? { center: [0, 0, 0], radius: 1 };
  const way = a.center.map((x, k) => (b.center[k] ?? 0) - x);
  const distance = Math.hypot(...way);
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const radius = (distance + a.radius + b.radius) / 2;
  const share = (radius - a.radius) / distance;
  const at = (k: 0 | 1 | 2) => a.center[k] + share * (way[k] ?? 0);
  return { center: [at(0), at(1), at(2)], radius };
}

// Returns a ball around all points, centred at the middle of their box.
export function ballOf(positions: Float32Array): Ball {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    const value = positions[i] ?? 0;
    const k = i % 3;
    if (value < (low[k] ?? 0)) low[k] = value;
    if (value > (high[k] ?? 0)) high[k] = value;
  }
  const middle = (k: number) => ((low[k] ?? 0) + (high[k] ?? 0)) / 2;
  if (positions.length === 0) return { center: [0, 0, 0], radius: 1 };
  const center: [number, number, number] = [middle(0), middle(1), middle(2)];
  let square = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const x = (positions[i] ?? 0) - center[0];
    const y = (positions[i + 1] ?? 0) - center[1];
    const z = (positions[i + 2] ?? 0) - center[2];
    square = Math.max(square, x * x + y * y + z * z);
  }
  return { center, radius: Math.sqrt(square) || 1 };
}
