// Chooses on the sample which faces of a mesh are lumped, and the rules for lumping.
#pragma once

#include <optional>

#include "transform/mesh_pass/plan/sample.h"
#include "transform/rules/error_model.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {

// Returns the part of the rules' allowed squares for faces with nodes of their own. There may be a
// few of these faces even if the sample has none.
double node_share2(bool some_noded);

// Returns the largest tolerance for which lumps keep their part of the allowed sum of squares, or
// 0. It is squared, in units of lumping, and in steps of an eighth of a power of two.
double tolerance_of(const MeshSample& sample, double allowed2);

// Returns the part of the faces beyond the tolerance.
double noded_share(const MeshSample& sample, double tolerance2);

// Returns the mean number of nodes of a face and its edges, if each element may have this error.
double own_nodes_of(const MeshSample& sample, const NodeAllowance& element);

// Returns the factor for errors that neighbours have alike; the largest count most. Many narrow
// faces fit into a wave across them, like short ones (see Crowd in plane_wave_rules.h).
double crowding_of(const MeshSample& sample);

// Rules with Hessians, and their cost.
struct HermiteLumps {
  HermiteEdgeReach edge_reach2;
  HermiteFaceReach face_reach2;
  double tolerance2 = 0;
  double node_share = 0;  // part of the faces that get nodes of their own
  double between = 0;     // nodes between the vertices of lumped faces, per face
  double hessian2 = 0;    // sum of squares of L^2 times the Hessians' factors
  double cost = 0;        // nanoseconds per face
  double neighbours = 1;  // see LumpChoice, with narrow faces counted
};
// Returns the cheapest rules that keep the allowed sum of squares, if a face with nodes of its own
// has `own_nodes` of them.
std::optional<HermiteLumps> hermite_lumps(const MeshSample& sample, double allowed2,
                                          double own_nodes);

}  // namespace rholm
