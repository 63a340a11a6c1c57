// From a mesh to coefficients and their errors. Layer: model.
#pragma once

#include <variant>
#include <vector>

#include "rholm/mesh_view.h"
#include "rholm/model.h"
#include "rholm/outward.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {

// Why a mesh cannot be expanded in place. prepare() may change it so that it can; expand() says
// what is wrong if not.
enum class NotInPlace {
  kOptions,       // vertices to be welded, a method or an engine that the mesh pass is not
  kUnusable,      // numbers, indices or faces that no pass can work with
  kNoCenter,      // no point sees the front of all faces
  kNotClosed,     // or not oriented alike
  kInsideOut,     // the enclosed volume is not above 0
  kFolded,        // faces turn their backs, and a surface that does is not wanted
  kCoveredTwice,  // no face turns its back, and directions meet more than one
};

// Expands a mesh without a copy of it, by the mesh pass. `hooks`: `check` and `release` of it, and
// `executor`. Throws InvalidInput for options out of range, and what is no fault of the mesh: Io,
// OutOfMemory, Cancelled, and whatever else a hook or the progress callback throws.
std::variant<Encoded, NotInPlace> expand_in_place(const MeshView& mesh,
                                                  const EncodeOptions& options,
                                                  const MeshPassOptions& hooks,
                                                  const Context& context);

// A mesh made fit for expansion: welded, turned outwards, its edges paired.
struct PreparedMesh {
  Outward shape;            // without attributes and thin faces
  std::vector<Edge> edges;  // of the welded mesh
};
// The mesh must be valid. Throws InvalidInput if it is not closed and oriented alike, as
// pair_edges().
PreparedMesh prepare(const Mesh& mesh, double weld_tolerance);

// Expands a prepared mesh in the same way, or by another method on a chart, which takes the edges
// of the mesh. Throws InvalidInput and NotStarShaped for meshes that no method can expand.
Encoded expand(PreparedMesh& mesh, const EncodeOptions& options, const Context& context);

}  // namespace rholm
