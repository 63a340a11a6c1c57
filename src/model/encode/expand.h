// From a mesh to coefficients and their errors. Layer: model.
#pragma once

#include <variant>
#include <vector>

#include "rholm/mesh_view.h"
#include "rholm/model.h"
#include "rholm/outward.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// Reasons why a mesh cannot be expanded in place. prepare() may remove the reason; otherwise
// expand() reports it.
enum class NotInPlace {
  kOptions,       // vertices to be welded, a method or an engine other than the mesh pass
  kUnusable,      // numbers, indices or faces that no pass can use
  kNoCenter,      // no point sees the front of all faces
  kNotClosed,     // or faces are not oriented alike
  kInsideOut,     // the enclosed volume is not above 0
  kFolded,        // faces turn inwards, and a surface with such faces is not wanted
  kCoveredTwice,  // no face turns inwards, but directions meet several faces
};

// Expands a mesh without copying it, by the mesh pass. It uses `check`, `release` and `executor` of
// `hooks`. Throws InvalidInput for options out of range, and errors that are not due to the mesh:
// Io, OutOfMemory, Cancelled, and exceptions of hooks or the progress callback.
std::variant<Encoded, NotInPlace> expand_in_place(const MeshView& mesh,
                                                  const EncodeOptions& options,
                                                  const MeshPassOptions& hooks,
                                                  const Context& context);

// A mesh prepared for expansion: welded, turned outwards, with paired edges.
struct PreparedMesh {
  Outward shape;            // without attributes and thin faces
  std::vector<Edge> edges;  // edges of the welded mesh
};
// The mesh must be valid. Throws InvalidInput if it is not closed and oriented alike, as
// pair_edges() does.
PreparedMesh prepare(const Mesh& mesh, double weld_tolerance);

// Expands a prepared mesh in the same way, or by another method on a chart, which takes the edges
// of the mesh. Throws InvalidInput and NotStarShaped for meshes that no method can expand.
Encoded expand(PreparedMesh& mesh, const EncodeOptions& options, const Context& context);

}  // namespace rholm
