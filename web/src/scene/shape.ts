// One surface or cloud of points on the screen.
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshLambertMaterial,
  Points,
  PointsMaterial,
  type Ray,
} from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Rgb } from "../geometry/colors";
import { dotted, labelColor, marked, plain } from "../geometry/colors";
import { aroundVertices, ballOf, joinedTriangles, vertexNormals } from "../geometry/normals";
import { atPieces, seamsOf } from "../geometry/seams";
import type { Surface } from "../protocol";

export interface Touch {
  vertex: number; // the nearest corner of the hit face
  point: [number, number, number];
  normal: [number, number, number];
  distance: number;
}

export interface Shape {
  group: Group;
  surface: Surface; // as received; the drawn one may have moved since
  ball: { center: [number, number, number]; radius: number };
  positions: BufferAttribute;
  normals: BufferAttribute | null;
  colors: BufferAttribute;
  material: MeshLambertMaterial | PointsMaterial;
  index: BufferAttribute | null;
  joined: Uint32Array | null; // joinedTriangles(), computed when needed
  moved: Uint32Array | null; // vertices that differ from the surface's; null: unknown, or none
  marks: Mesh | null;
  seams: Mesh | null; // pieces of faces that belong to several caps
  bvh: MeshBVH | null;
  bvhMoved: boolean;
}

export function makeShape(surface: Surface): Shape {
  const geometry = new BufferGeometry();
  const positions = new BufferAttribute(surface.positions.slice(), 3);
  const colors = new BufferAttribute(new Float32Array(surface.positions.length), 3);
  geometry.setAttribute("position", positions);
  geometry.setAttribute("color", colors);
  const ball = ballOf(surface.positions);
  const group = new Group();
  const none = { marks: null, seams: null, joined: null, moved: null, bvh: null, bvhMoved: false };
  const shape = { group, surface, ball, positions, colors, ...none };
  if (!surface.triangles) {
    // Chosen: on a sphere the points would cover half of it, and in a ball's picture they never disappear.
    const covering = Math.sqrt(8 / Math.max(1, positions.count));
    const size = ball.radius * Math.min(0.05, Math.max(1 / 400, covering));
    const material = new PointsMaterial({ vertexColors: true, size });
    group.add(keep(new Points(geometry, material)));
    return paintOne({ ...shape, normals: null, index: null, material }, dotted);
  }
  const given = surface.normals?.slice() ?? new Float32Array(surface.positions.length);
  const joined = surface.normals ? null : joinedTriangles(surface.positions, surface.triangles);
  if (joined) vertexNormals(surface.positions, surface.triangles, joined, given);
  const normals = new BufferAttribute(given, 3);
  // A copy, because the tree of faces sorts it.
  const index = new BufferAttribute(surface.triangles.slice(), 1);
  geometry.setAttribute("normal", normals);
  geometry.setIndex(index);
  const material = new MeshLambertMaterial({
    vertexColors: true,
    side: DoubleSide,
  });
  group.add(keep(new Mesh(geometry, material)));
  return paintOne({ ...shape, normals, index, material }, plain);
}

// Vertices move, so culling by a ball is off; the ball would have to be updated.
function keep<T extends Mesh | Points>(object: T): T {
  object.frustumCulled = false;
  return object;
}

// Moves all vertices.
export function moveShape(shape: Shape, positions: Float32Array, normals: Float32Array | null): void {
  (shape.positions.array as Float32Array).set(positions);
  shape.moved = null;
  hasMoved(shape, normals, undefined);
}

// Moves these vertices. Vertices that the previous call moved and this one does not name return to their places.
export function moveSome(shape: Shape, indices: Uint32Array, positions: Float32Array): void {
  const array = shape.positions.array as Float32Array;
  const before = shape.moved ?? new Uint32Array();
  const home = shape.surface.positions;
  for (const v of before) array.set(home.subarray(3 * v, 3 * v + 3), 3 * v);
  indices.forEach((v, i) => array.set(positions.subarray(3 * i, 3 * i + 3), 3 * v));
  shape.moved = indices;
  const { triangles } = shape.surface;
  if (!triangles) return;
  const joined = joinedOf(shape, triangles);
  const touched = aroundVertices(array.length / 3, joined, [before, indices]);
  hasMoved(shape, null, touched);
}

function joinedOf(shape: Shape, triangles: Uint32Array): Uint32Array {
  return (shape.joined ??= joinedTriangles(shape.surface.positions, triangles));
}

function hasMoved(shape: Shape, normals: Float32Array | null, touched: Uint8Array | undefined): void {
  dropSeams(shape);
  shape.positions.needsUpdate = true;
  shape.bvhMoved = true;
  const { triangles } = shape.surface;
  if (!shape.normals || !triangles) return;
  const directions = shape.normals.array as Float32Array;
  if (normals) {
    directions.set(normals);
  } else {
    const array = shape.positions.array as Float32Array;
    vertexNormals(array, triangles, joinedOf(shape, triangles), directions, touched);
  }
  shape.normals.needsUpdate = true;
}

export function paintOne(shape: Shape, color: Rgb): Shape {
  const array = shape.colors.array as Float32Array;
  for (let i = 0; i < array.length; i += 3) array.set(color, i);
  shape.colors.needsUpdate = true;
  return shape;
}

// Paints each cap in one colour, with borders that do not follow the edges of the mesh.
export function paintLabels(shape: Shape, labels: Uint32Array): void {
  const { triangles } = shape.surface;
  const seams = triangles && shape.normals ? seamsOf(triangles, labels) : null;
  const array = shape.colors.array as Float32Array;
  (seams?.labels ?? labels).forEach((label, v) => array.set(labelColor(label), 3 * v));
  shape.colors.needsUpdate = true;
  if (!seams || !shape.normals) return;
  const geometry = new BufferGeometry();
  const add = (name: string, values: Float32Array) => geometry.setAttribute(name, new BufferAttribute(values, 3));
  const colors = new Float32Array(seams.weights.length);
  seams.pieceLabels.forEach((label, i) => [0, 3, 6].forEach((at) => colors.set(labelColor(label), 9 * i + at)));
  add("position", atPieces(seams, shape.positions.array));
  add("normal", atPieces(seams, shape.normals.array));
  add("color", colors);
  const material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true });
  material.polygonOffsetUnits = -2; // in front of their faces
  shape.seams = keep(new Mesh(geometry, material));
  shape.group.add(shape.seams);
}

export function dropSeams(shape: Shape): void {
  if (!shape.seams) return;
  shape.group.remove(shape.seams);
  shape.seams.geometry.dispose();
  (shape.seams.material as MeshLambertMaterial).dispose();
  shape.seams = null;
}

// Shows the faces of these numbers in another colour; null: none.
export function markFaces(shape: Shape, faces: Uint32Array | null): void {
  if (shape.marks) {
    shape.group.remove(shape.marks);
    shape.marks.geometry.dispose();
    (shape.marks.material as MeshLambertMaterial).dispose();
    shape.marks = null;
  }
  const triangles = shape.surface.triangles;
  if (!faces?.length || !triangles) return;
  const index = new Uint32Array(3 * faces.length);
  faces.forEach((face, i) => index.set(triangles.subarray(3 * face, 3 * face + 3), 3 * i));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", shape.positions);
  if (shape.normals) geometry.setAttribute("normal", shape.normals);
  geometry.setIndex(new BufferAttribute(index, 1));
  const material = new MeshLambertMaterial({ side: DoubleSide, polygonOffset: true });
  material.color.setRGB(...marked);
  material.polygonOffsetUnits = -4; // in front of the same faces of the shape, and no others
  shape.marks = keep(new Mesh(geometry, material));
  shape.group.add(shape.marks);
}

export function setOpacity(shape: Shape, opacity: number): void {
  shape.material.transparent = opacity < 1;
  shape.material.opacity = opacity;
  shape.material.depthWrite = opacity === 1;
  shape.material.needsUpdate = true;
}

// Returns the first intersection of a ray with the surface; null for points.
export function touchShape(shape: Shape, ray: Ray): Touch | null {
  if (!shape.index) return null;
  const geometry = (shape.group.children[0] as Mesh).geometry;
  if (!shape.bvh) shape.bvh = new MeshBVH(geometry, { indirect: true });
  else if (shape.bvhMoved) shape.bvh.refit();
  shape.bvhMoved = false;
  const hit = shape.bvh.raycastFirst(ray, DoubleSide);
  if (!hit?.face) return null;
  const array = shape.positions.array as Float32Array;
  const far = (v: number) =>
    Math.hypot(...hit.point.toArray().map((x, k) => x - (array[3 * v + k] ?? 0)));
  const { a, b, c, normal } = hit.face;
  const vertex = [a, b, c].reduce((best, v) => (far(v) < far(best) ? v : best));
  return {
    vertex,
    point: hit.point.toArray(),
    normal: normal.toArray(),
    distance: hit.distance,
  };
}

export function disposeShape(shape: Shape): void {
  markFaces(shape, null);
  dropSeams(shape);
  (shape.group.children[0] as Mesh).geometry.dispose();
  shape.material.dispose();
}
