// Reduction of the number of faces of a mesh. Layer: shape.
#pragma once

#include <cstddef>
#include <limits>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// When simplification stops: at the first limit reached. Without limits, reconstruct() and the
// synthesis of an atlas allow an error of 1/50 of their grid's step.
struct SimplifyOptions {
  std::size_t faces = 0;  // largest number of faces in the result; 0: any
  double share = 0;       // largest share of the given faces in the result, 0 ... 1
  // Largest error, in the mesh's unit. It is the distance of a vertex's place in the result from
  // the planes of its original faces (root mean square, weighted by area). A vertex with a larger
  // error is not removed.
  double max_error = std::numeric_limits<double>::infinity();
};

// Lists the fields of SimplifyOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<SimplifyOptions>, const Visitor& field) {
  using O = SimplifyOptions;
  field(&O::faces, {.name = "faces",
                    .help = "largest number of faces in the result; 0: any number",
                    .value = "N"});
  field(&O::share, {.name = "share",
                    .help = "largest share of the given faces in the result; 0: any share",
                    .value = "SHARE",
                    .least = 0,
                    .most = 1});
  field(&O::max_error, {.name = "max_error",
                        .help = "largest root mean square distance of a vertex from the planes of "
                                "the faces that it replaces",
                        .value = "E",
                        .least = 0,
                        .may_be_infinite = true,
                        .unit = FieldUnit::kLength});
}

// A simplified mesh, and its error.
struct Simplification {
  Mesh mesh;         // a subset of the vertices, with attributes, in the given order
  double error = 0;  // largest error made, measured as max_error
};

// Collapses edges to one of their ends, least change of the surface first (quadric
// error of Garland and Heckbert 1997, without new positions). Topology is kept:
// closed, 2-manifold, genus, borders; no face is turned over. Edges of more than
// two faces and vertices of more than one fan stay, so more faces than wanted may
// remain. Vertices without faces are removed. Throws InvalidInput for an invalid
// mesh, options out of range, or no limit. Same bits for any number of threads.
Simplification simplify(Mesh mesh, const SimplifyOptions& options, const Context& context = {});

}  // namespace rholm
