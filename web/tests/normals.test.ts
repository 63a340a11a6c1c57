import { expect, it } from "vitest";
import {
  aroundVertices,
  ballAround,
  ballOf,
  joinedTriangles,
  vertexNormals,
} from "../src/geometry/normals";

// An octahedron: the normal of each vertex is the vertex.
const corners = [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1];
const positions = new Float32Array(corners);
const triangles = new Uint32Array([
  0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5,
]);

it("normals of an octahedron are its corners", () => {
  const normals = new Float32Array(18);
  vertexNormals(positions, triangles, triangles, normals);
  corners.forEach((x, i) => expect(normals[i]).toBeCloseTo(x, 6));
});

it("larger faces weigh more", () => {
  // Two faces meet at vertex 0: one in the plane z = 0 of area 1/2, one in x = 0 of area 2.
  const place = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 2]);
  const normals = new Float32Array(15);
  const faces = new Uint32Array([0, 1, 2, 0, 3, 4]);
  vertexNormals(place, faces, faces, normals);
  expect([...normals.slice(0, 3)]).toEqual([4, 0, 1].map((x) => Math.fround(x / Math.hypot(4, 1))));
});

it("of touched vertices only, they are those of all", () => {
  const moved = positions.slice();
  moved[12] = 0.5;
  const all = new Float32Array(18);
  vertexNormals(moved, triangles, triangles, all);
  const some = new Float32Array(18);
  vertexNormals(positions, triangles, triangles, some);
  const touched = aroundVertices(6, triangles, [new Uint32Array([4])]);
  expect([...touched]).toEqual([1, 1, 1, 1, 1, 0]);
  vertexNormals(moved, triangles, triangles, some, touched);
  expect(some).toEqual(all);
});

it("a seam of the file is none of the surface", () => {
  // Each face of the octahedron has separate corners; some of their zeros are negative.
  const cut = new Float32Array([...triangles].flatMap((v) => [...positions.slice(3 * v, 3 * v + 3)]));
  cut.forEach((x, i) => (cut[i] = x === 0 && i % 2 === 0 ? -0 : x));
  const faces = triangles.map((_, i) => i);
  const joined = joinedTriangles(cut, faces);
  expect(new Set(joined).size).toBe(6);
  const normals = new Float32Array(cut.length);
  vertexNormals(cut, faces, joined, normals);
  cut.forEach((x, i) => expect(normals[i]).toBeCloseTo(x, 6));
  expect(joinedTriangles(positions, triangles)).toBe(triangles);
});

it("a vertex without faces has no direction, and no NaN", () => {
  const normals = new Float32Array(3).fill(7);
  const none = new Uint32Array(0);
  vertexNormals(new Float32Array(3), none, none, normals);
  expect([...normals]).toEqual([0, 0, 0]);
});

it("a ball around two balls touches both, or is the one that holds the other", () => {
  const small = { center: [5, 0, 0] as [number, number, number], radius: 1 };
  const large = { center: [0, 0, 0] as [number, number, number], radius: 2 };
  expect(ballAround([large, small])).toEqual({ center: [2, 0, 0], radius: 4 });
  expect(ballAround([small, large])).toEqual({ center: [2, 0, 0], radius: 4 });
  expect(ballAround([large, { ...small, center: [1, 0, 0] }])).toBe(large);
  expect(ballAround([small])).toBe(small);
  expect(ballAround([]).radius).toBe(1);
});

it("the ball is around the points, about the middle of their box", () => {
  expect(ballOf(new Float32Array([0, 0, 0, 2, 4, 4]))).toEqual({ center: [1, 2, 2], radius: 3 });
  expect(ballOf(new Float32Array(0)).radius).toBe(1);
});
