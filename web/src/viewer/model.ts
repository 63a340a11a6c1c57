// The surface of a degree as the viewer draws it.
import { rangeOf, type Range } from "../geometry/colors";
import { vertexNormals } from "../geometry/normals";
import { gridDirections, gridTriangles, placeVertices, radiusOf } from "../harmonics/surface";
import { gridFor, startSynthesis, sumTo, type Synthesis } from "../harmonics/synthesis";
import type { Surface } from "../protocol";
import { coefficientsOf, type ViewData } from "../viewdata";

export interface Model {
  data: ViewData;
  synthesis: Synthesis;
  surface: Surface; // its arrays are overwritten for each degree
  normals: Float32Array;
  directions: Float32Array;
  radii: Float64Array; // radii of the shown degree
  full: Float64Array; // radii of all degrees
  original: Surface | null;
}

export function makeModel(data: ViewData): Model {
  const grid = gridFor(data.expansion.degree);
  const synthesis = startSynthesis(coefficientsOf(data), grid);
  const directions = gridDirections(grid);
  const none = { colors: null, labels: null, offending: null };
  const normals = new Float32Array(directions.length);
  const positions = new Float32Array(directions.length);
  const surface = { ...none, positions, normals, triangles: gridTriangles(grid) };
  const toRadius = radiusOf(data.expansion.function);
  const full = sumTo(synthesis, data.expansion.degree).map(toRadius);
  const original = data.mesh && { ...none, normals: null, ...data.mesh };
  const model = { data, synthesis, surface, normals, directions, radii: full, full, original };
  setDegree(model, data.expansion.degree);
  return model;
}

export function setDegree(model: Model, degree: number): void {
  const { expansion } = model.data;
  model.radii = sumTo(model.synthesis, degree).map(radiusOf(expansion.function));
  placeVertices(model.directions, model.radii, expansion.center, model.surface.positions);
  const { positions, triangles } = model.surface;
  if (triangles) vertexNormals(positions, triangles, triangles, model.normals);
}

export type Coloring = "plain" | "radius" | "difference";

// Returns values of vertices, with the range of colours; null for one colour.
export function valuesFor(
  model: Model,
  coloring: Coloring,
): { values: Float64Array; range: Range; label: string } | null {
  if (coloring === "plain") return null;
  if (coloring === "radius") {
    return { values: model.radii, range: rangeOf(model.full), label: "Radius" };
  }
  const values = model.radii.map((r, i) => r - (model.full[i] ?? 0));
  const { min, max } = rangeOf(values);
  const size = Math.max(-min, max);
  return { values, range: { min: -size, max: size }, label: "Difference from all degrees" };
}
