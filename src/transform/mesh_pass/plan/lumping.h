// Which triangles of a mesh are lumped, and by which rules: chosen on the sample.
#pragma once

#include <optional>

#include "transform/mesh_pass/plan/sample.h"
#include "transform/rules/error_model.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {

// Of the squares that rules may leave, the part of triangles with nodes of their own. Where the
// sample has none, there may be a few all the same.
double node_share2(bool some_noded);

// The largest tolerance (squared, in units of lumping), in steps of an eighth of a power of two, up
// to which lumps keep within their part of the sum of squares allowed; 0 if none does.
double tolerance_of(const MeshSample& sample, double allowed2);

// The part of the triangles that is beyond it.
double noded_share(const MeshSample& sample, double tolerance2);

// How many nodes of its own a triangle gets in the mean, if edges and faces may leave this.
double own_nodes_of(const MeshSample& sample, const NodeAllowance& element);

// By how much more errors count for neighbours, as those of the largest count: of narrow triangles
// as many lie in a wave across them as of short ones (see Crowd in plane_wave_rules.h).
double crowding_of(const MeshSample& sample);

// Rules with Hessians.
struct HermiteLumps {
  HermiteEdgeReach edge_reach2;
  HermiteFaceReach face_reach2;
  double tolerance2 = 0;
  double node_share = 0;  // triangles that get nodes all the same
  double between = 0;     // nodes between the vertices of the others, per triangle
  double hessian2 = 0;    // sum of squares of L^2 times the Hessians' factors
  double cost = 0;        // per triangle, nanoseconds
  double neighbours = 1;  // see LumpChoice, narrow triangles counted
};
// The cheapest that keep the sum of squares allowed, where a triangle that gets nodes of its own
// has so many.
std::optional<HermiteLumps> hermite_lumps(const MeshSample& sample, double allowed2,
                                          double own_nodes);

}  // namespace rholm
