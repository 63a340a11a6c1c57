// Fewer triangles for the same surface. Layer: shape.
#pragma once

#include <cstddef>
#include <limits>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

// Where to stop: whichever comes first. With none of them given reconstruct() and the synthesis of
// an atlas allow an error of 1/50 of their grid's step.
struct SimplifyOptions {
  std::size_t triangles = 0;  // no more than these are left
  double share = 0;           // no more than this share of the given triangles is left, 0 ... 1
  // No vertex goes whose place in the result would be farther than this, in the mesh's unit, from
  // the planes of the triangles it stands for (root of the mean of the squares, weighted with
  // areas).
  double max_error = std::numeric_limits<double>::infinity();
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<SimplifyOptions>, const Visitor& field) {
  using O = SimplifyOptions;
  field(&O::triangles, {.name = "triangles",
                        .help = "no more triangles than these are left; 0: any number",
                        .value = "N"});
  field(&O::share, {.name = "share",
                    .help = "no more than this share of the triangles is left; 0: any",
                    .value = "SHARE",
                    .least = 0,
                    .most = 1});
  field(&O::max_error, {.name = "max_error",
                        .help = "no vertex goes whose place in the result would be farther than "
                                "this from the planes of the triangles it stands for",
                        .value = "E",
                        .least = 0,
                        .may_be_infinite = true,
                        .unit = FieldUnit::kLength});
}

// The mesh with fewer triangles.
struct Simplification {
  Mesh mesh;  // its vertices are some of the given ones, with their attributes, in their order
  double error = 0;  // the largest that was allowed, as max_error counts it
};

// Edges shrink to one of their ends, those first that change the surface least (quadric error of
// Garland and Heckbert 1997, without new places). A surface stays what it is: closed and 2-manifold
// where it was, of the same genus, with the same borders and no triangle turned over; edges of more
// than two triangles, and vertices of more than one fan, stay as they are. It may therefore end
// with more triangles than wanted. Vertices in no triangle go. Throws InvalidInput for a mesh that
// is not valid, options out of range, and none given. Same bits for any number of threads.
Simplification simplify(Mesh mesh, const SimplifyOptions& options, const Context& context = {});

}  // namespace rholm
