// What a mesh pass decides before it starts, from a sample of the triangles: how the wanted error
// is divided, which rules triangles get, whether single precision will do, and how fine quanta are.
//
// One name for each quantity. `precision`: the wish, relative to the norm of the radius without its
// mean. `allowed`: what a part of the work may leave, l2 over 1 <= l <= L in scaled lengths.
// `error`: what it is found to leave. Squares end in 2, and `tolerance2` is that of a triangle.
#pragma once

#include <cstddef>
#include <optional>

#include "base/rounding.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/plan/lumping.h"
#include "transform/mesh_pass/plan/sample.h"
#include "transform/rules/error_model.h"

namespace rholm {

// What double precision leaves of c_00. Lumps are whole quanta; a triangle's is the outcome of some
// eight roundings: corners, their cross product, squares of lengths, a root, a quotient.
inline constexpr double kLumpRounding = rounding_of_sum(8);

// What a first try has taught.
struct PlanLimits {
  double tighten = 1;  // divides what is allowed
  bool forbid_single = false;
  bool no_lumps = false;  // the sample misleads: nodes for every triangle
};

// The first decision: how the wanted error is divided among what leaves errors.
struct AllowedErrors {
  double rules = 0;    // may leave this
  double caution = 1;  // what the rules' errors may exceed their model by
  double window = 0;   // and the windows of the transform
  double quanta = 0;   // and the rounding of lumps to quanta
  // Of the windows in any case, relative to the norm: a mesh whose vertices lie in lattice lines
  // may be in step with the grid, then the error is of the size of the low degrees themselves, not
  // of random sums.
  double most_window = 0;
  double mean = 0;      // relative, of c_00
  double rounding = 0;  // what double precision leaves at best, in the mesh's unit
};
// Throws InvalidInput if no direction sees the surface.
AllowedErrors divide_error(const MeshSample& sample, double precision, double tighten);

// The second: up to which error triangles are lumped with values and gradients alone.
struct LumpChoice {
  double neighbours = 1;  // see neighbours_in_step(), of lumped triangles
  double allowed2 = 0;    // sum of squares of their errors, in units of lumping
  double tolerance2 = 0;  // of a triangle
  double node_share = 0;  // part of the triangles that is beyond it
};
LumpChoice choose_lumps(const MeshSample& sample, const AllowedErrors& allowed, int degree);

// The third: whether vertices get Hessians, because so many nodes for each of so many triangles
// would cost more.
std::optional<HermiteLumps> choose_hessians(const MeshSample& sample, const LumpChoice& lumps,
                                            double own_nodes);

// The fourth: whether sources may be spread in single precision.
bool single_suffices(const MeshSample& sample, const AllowedErrors& allowed, int degree,
                     bool hessians);

// The fifth: what lumps are whole multiples of.
struct Quantum {
  double size = 0;   // of weights
  double error = 0;  // what rounding to it leaves
};
Quantum choose_quantum(const AllowedErrors& allowed, std::size_t n_vertices, bool single);

struct MeshPlan {
  BlockParameters block;
  NodeAllowance divided, undivided;
  AllowedErrors allowed;
  double neighbours = 1;    // see LumpChoice
  double quanta_error = 0;  // what rounding of lumps to quanta leaves
  double node_share = 0;    // part of the triangles that get nodes, as the sample has it
  double between = 0;   // nodes between the vertices of lumped triangles, per triangle, likewise
  double nodes = 0;     // these and those of the others' own, per triangle, likewise
  double source2 = 0;   // sum of squares of the nodes' weights, as the sample has it
  double hessian2 = 0;  // and of L^2 times Hessians
  double node_modulus = 0;   // sum of the moduli of the nodes' weights
  double aligned = 0;        // part of the edges along meridians or parallels
  double round_modulus = 0;  // of all sources, as far as the body is nearly a ball
  bool single = false;       // single precision will do
};
// All of them.
MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, const PlanLimits& limits);

// What windows leave, relative to their own error, of nodes in rows along meridians and parallels,
// whose moduli have that sum: edges and faces have rows of their own, and what cancels between
// them in the sum, as on a ball, does not cancel there. Or of all sources of what is nearly a ball.
double rows_in_step(const MeshPlan& plan, double node_modulus);

// The window error that keeps the plan's share for sources whose squared weights have that sum.
double allowed_window_error(const MeshPlan& plan, double source2);

}  // namespace rholm
