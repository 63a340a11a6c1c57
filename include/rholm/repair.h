// Damaged meshes made fit for work. Layer: shape.
#pragma once

#include <cstddef>
#include <optional>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"

namespace rholm {

// What may be done to a mesh.
struct RepairOptions {
  double weld = 0;  // tolerance of weld(), in the mesh's unit; 0 joins identical vertices
  // Holes with at most so many edges are closed, 0 ... 500. Chosen: what scanners and exports
  // leave open by mistake is smaller, the open end of a bust is larger.
  std::size_t max_hole = 100;
};

// What has been done, and what could not be.
struct RepairReport {
  Inspection before;                     // of the mesh welded exactly
  std::size_t merged_vertices = 0;       // by welding
  std::size_t collapsed_triangles = 0;   // by welding: two corners became one
  std::size_t isolated_vertices = 0;     // dropped: in no triangle
  std::size_t duplicate_triangles = 0;   // dropped: same three vertices as an earlier one
  std::size_t degenerate_triangles = 0;  // thinner than rounding, dropped or swapped
  std::size_t junctions = 0;             // vertices on edges of others' faces (T-junctions), joined
  std::size_t flipped_triangles = 0;     // turned, so that their part is oriented alike, outwards
  std::size_t inside_out_parts = 0;      // closed parts turned as a whole, flipped_triangles too
  std::size_t cavities = 0;              // closed parts that lie within another: face inwards
  std::size_t split_vertices = 0;        // new vertices where sheets met in one
  std::size_t closed_holes = 0;          // by new triangles
  std::size_t hole_triangles = 0;        // put into them
  std::size_t large_holes = 0;           // left: more edges than allowed
  std::size_t largest_hole = 0;          // edges of the largest of these
  std::size_t sheets = 0;                // holes left: borders of open sheets, see repair()
  std::size_t one_sided_parts = 0;       // left: they have no orientation (Moebius strips)
  std::optional<double> closes_at{};     // what closing_tolerance() says of what is left open
  Inspection after;                      // of the result, welded exactly
};

// The mesh as far as it could be mended.
struct Repaired {
  Mesh mesh;            // closed parts face outwards, cavities inwards
  RepairReport report;  // what was wrong, and what still is
};

// repair() takes these steps, in this order:
// - It welds vertices, and drops vertices in no triangle, duplicate and degenerate triangles.
// - It splits a triangle where vertices of others lie on its edge (T-junctions), within the
//   rounding of the coordinates.
// - It separates sheets where three or more triangles meet in an edge, or several fans in a vertex.
//   Copies of a vertex move apart by 1e-6 of the diagonal into their own sheets, or readers would
//   weld them again.
// - It orients each part alike, as the larger part of its area was.
// - It closes holes with flat triangles between their own vertices, of the least bend and area, or
//   around one new vertex where those would meet others. A hole whose cover would be larger than
//   3/4 of the part is the border of an open sheet, and stays.
// - It orients closed parts outwards, and inwards those that lie within an odd number of others.
//
// Vertices keep their order and attributes, new ones come last; normals nx, ny, nz of turned
// triangles turn along. A mesh that needs nothing comes back as weld() makes it. Same bits for any
// number of threads. Throws InvalidInput for a mesh that is not valid or options out of range;
// Cancelled.
Repaired repair(const Mesh& mesh, const RepairOptions& options = {}, const Context& context = {});

}  // namespace rholm
