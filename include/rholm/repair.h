// Repair of damaged meshes. Layer: shape.
#pragma once

#include <cstddef>
#include <optional>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"

namespace rholm {

// Largest number of edges of a hole to close. Chosen: closing such a hole takes some seconds.
inline constexpr std::size_t kMostHoleEdges = 500;

// Tolerance for welding, and size of holes to close.
struct RepairOptions {
  double weld = 0;  // tolerance of weld(), in the mesh's unit; 0 joins identical vertices
  // Holes with at most this number of edges are closed, 0 ... 500. Chosen: accidental holes of
  // scanners and exports are smaller, the open end of a bust is larger.
  std::size_t max_hole = 100;
};

// Lists the fields of RepairOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<RepairOptions>, const Visitor& field) {
  using O = RepairOptions;
  field(&O::weld,
        {.name = "weld",
         .help = "merge vertices within this distance of each other; 0: identical vertices only",
         .value = "T",
         .least = 0,
         .unit = FieldUnit::kLength,
         .in_program = false});
  field(&O::max_hole,
        {.name = "max_hole",
         .help = "largest number of edges of a hole that is closed; 0: no hole is closed",
         .value = "N",
         .least = 0,
         .most = kMostHoleEdges});
}

// Counts of repairs and of remaining defects.
struct RepairReport {
  Inspection before;                  // state of the mesh after exact welding
  std::size_t merged_vertices = 0;    // vertices merged by welding
  std::size_t collapsed_faces = 0;    // faces dropped by welding: two corners were merged
  std::size_t isolated_vertices = 0;  // vertices dropped: not used by a face
  std::size_t duplicate_faces = 0;    // faces dropped: same three vertices as an earlier face
  std::size_t degenerate_faces = 0;   // faces thinner than rounding; dropped or swapped
  std::size_t junctions = 0;          // joined T-junctions: vertices on edges of other faces
  std::size_t flipped_faces = 0;      // faces turned: their part is now consistent and outward
  std::size_t inside_out_parts = 0;   // closed parts turned as a whole, in flipped_faces too
  std::size_t cavities = 0;           // closed parts inside another part: oriented inwards
  std::size_t split_vertices = 0;     // new vertices where sheets met in one vertex
  std::size_t closed_holes = 0;       // holes closed by new faces
  std::size_t hole_faces = 0;         // new faces in closed holes
  std::size_t large_holes = 0;        // holes not closed: more edges than allowed
  std::size_t largest_hole = 0;       // number of edges of the largest of these
  std::size_t sheets = 0;             // holes not closed: borders of open sheets, see repair()
  std::size_t one_sided_parts = 0;    // parts without orientation (Moebius strips); not changed
  std::optional<double> closes_at{};  // closing_tolerance() for the remaining borders
  Inspection after;                   // state of the result, exactly welded
};

// Lists the fields of RepairReport.
template <typename Visitor>
void visit_fields(FieldsOf<RepairReport>, const Visitor& field) {
  using R = RepairReport;
  field(&R::before,
        {.name = "before", .help = "state of the mesh before the repair, welded exactly"});
  field(&R::merged_vertices,
        {.name = "merged_vertices", .help = "number of vertices merged by welding"});
  field(&R::collapsed_faces,
        {.name = "collapsed_faces",
         .help = "number of faces dropped because welding merged two of their corners"});
  field(&R::isolated_vertices, {.name = "isolated_vertices",
                                .help = "number of vertices dropped because no face uses them"});
  field(&R::duplicate_faces,
        {.name = "duplicate_faces",
         .help = "number of faces dropped because an earlier face has the same vertices"});
  field(&R::degenerate_faces,
        {.name = "degenerate_faces",
         .help = "number of faces dropped or swapped because they are thinner than rounding"});
  field(&R::junctions,
        {.name = "junctions",
         .help = "number of vertices on edges of other faces (T-junctions) that were joined"});
  field(&R::flipped_faces, {.name = "flipped_faces", .help = "number of faces that were turned"});
  field(&R::inside_out_parts,
        {.name = "inside_out_parts", .help = "number of closed parts that were turned as a whole"});
  field(&R::cavities,
        {.name = "cavities",
         .help = "number of closed parts inside another part, which are oriented inwards"});
  field(&R::split_vertices, {.name = "split_vertices",
                             .help = "number of new vertices where sheets met in one vertex"});
  field(&R::closed_holes, {.name = "closed_holes", .help = "number of holes closed by new faces"});
  field(&R::hole_faces, {.name = "hole_faces", .help = "number of new faces that close holes"});
  field(&R::large_holes,
        {.name = "large_holes",
         .help = "number of holes left open because they have more edges than allowed"});
  field(&R::largest_hole,
        {.name = "largest_hole",
         .help = "number of edges of the largest hole with more edges than allowed"});
  field(&R::sheets, {.name = "sheets",
                     .help = "number of holes left open because they are borders of open sheets"});
  field(&R::one_sided_parts,
        {.name = "one_sided_parts",
         .help = "number of parts left without an orientation (Moebius strips)"});
  field(
      &R::closes_at,
      {.name = "closes_at",
       .help = "tolerance of welding that would join the remaining borders; None if there is none",
       .unit = FieldUnit::kLength});
  field(&R::after, {.name = "after", .help = "state of the mesh after the repair, welded exactly"});
}

// A repaired mesh, and the report.
struct Repaired {
  Mesh mesh;            // closed parts face outwards, cavities inwards
  RepairReport report;  // repairs and remaining defects
};

// Repairs a mesh. repair() takes these steps, in this order:
// - It welds vertices, and drops unused vertices, duplicate and degenerate faces.
// - It splits a face where vertices of other faces lie on its edge (T-junctions), within the
//   rounding of the coordinates.
// - It separates sheets where three or more faces share an edge, or several fans share a vertex.
//   Copies of a vertex are moved by 1e-6 of the diagonal into their own sheets, because readers
//   would weld them again.
// - It orients each part consistently, like the larger share of its area.
// - It closes holes with flat triangles between their vertices, of least bend and area, or around
//   one new vertex where triangles would cross others. A hole whose cover would be larger than 3/4
//   of the part stays: it is the border of an open sheet.
// - It orients closed parts outwards, or inwards inside an odd number of other parts.
//
// Vertices keep their order and attributes; new ones come last. Normals
// nx, ny, nz of turned faces are turned too. A mesh without defects comes
// back as weld() returns it. Same bits for any number of threads. Throws
// InvalidInput for an invalid mesh or options out of range; Cancelled.
Repaired repair(const Mesh& mesh, const RepairOptions& options = {}, const Context& context = {});

}  // namespace rholm
