// Plans a mesh pass from a sample of its faces. Divides the wanted error, chooses rules and the
// size of quanta, and decides if single precision is enough.
//
// Each quantity has one name. `precision` is wanted, relative to the norm of the radius without its
// mean. `allowed` is the error that a part of the work may have, l2 over 1 <= l <= L in scaled
// lengths. `error` is the error found. Squares end in 2; `tolerance2` is for a face.
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

// Rounding error of c_00 in double precision. Lumps are whole quanta; a face's lump has some eight
// roundings: corners, their cross product, squares of lengths, a root, a quotient.
inline constexpr double kLumpRounding = rounding_of_sum(8);

// Results of earlier tries.
struct PlanLimits {
  double tighten = 1;  // divides the allowed errors
  bool forbid_single = false;
  bool no_lumps = false;  // the sample misleads: nodes for every face
};

// The first decision divides the wanted error among its causes.
struct AllowedErrors {
  double rules = 0;    // allowed error of rules
  double caution = 1;  // largest ratio of the rules' errors to their model
  double window = 0;   // allowed error of the transform's windows
  double quanta = 0;   // allowed error of rounding lumps to quanta
  // Largest window error in any case, relative to the norm. A mesh whose vertices lie in lattice
  // lines may be aligned with the grid. Then the error is as large as the low degrees themselves,
  // and larger than for random sums.
  double most_window = 0;
  double mean = 0;      // relative error of c_00
  double rounding = 0;  // smallest possible error in double precision, in the mesh's unit
};
// Throws InvalidInput if the surface has no solid angle.
AllowedErrors divide_error(const MeshSample& sample, double precision, double tighten);

// The second decision: the largest error of faces lumped with values and gradients alone.
struct LumpChoice {
  double neighbours = 1;  // see neighbours_in_step(), of lumped faces
  double allowed2 = 0;    // sum of squares of their errors, in units of lumping
  double tolerance2 = 0;  // largest square of a face's error
  double node_share = 0;  // part of the faces beyond the tolerance
};
LumpChoice choose_lumps(const MeshSample& sample, const AllowedErrors& allowed, int degree);

// The third decision: vertices get Hessians if faces' own nodes would cost more. Returns nothing if
// vertices get none.
std::optional<HermiteLumps> choose_hessians(const MeshSample& sample, const LumpChoice& lumps,
                                            double own_nodes);

// The fourth decision: sources may be spread in single precision.
bool single_suffices(const MeshSample& sample, const AllowedErrors& allowed, int degree,
                     bool hessians);

// The fifth decision: the quantum of which lumps are whole multiples.
struct Quantum {
  double size = 0;   // quantum of weights
  double error = 0;  // error of rounding to it
};
Quantum choose_quantum(const AllowedErrors& allowed, std::size_t n_vertices, bool single);

struct MeshPlan {
  BlockParameters block;
  NodeAllowance divided;
  double face_rounding = 0;  // largest rounding error of the weights of a face
  AllowedErrors allowed;
  double neighbours = 1;     // see LumpChoice
  double quanta_error = 0;   // error of rounding lumps to quanta
  double node_share = 0;     // part of the faces that get nodes, by the sample
  double between = 0;        // nodes between vertices of lumped faces, per face, by the sample
  double nodes = 0;          // `between` and other faces' own nodes, per face, by the sample
  double source2 = 0;        // sum of squares of the nodes' weights, by the sample
  double hessian2 = 0;       // sum of squares of L^2 times Hessians, by the sample
  double node_modulus = 0;   // sum of the moduli of the nodes' weights
  double aligned = 0;        // part of the edges along meridians or parallels
  double round_modulus = 0;  // sum of moduli of all sources, as far as the body is nearly a ball
  bool single = false;       // single precision is enough
};
// Makes all decisions.
MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, const PlanLimits& limits);

// Returns the window error, relative to windows' own error, of nodes in rows along meridians and
// parallels; `node_modulus` is the sum of their moduli. Edges and faces have rows of their own,
// whose errors do not cancel as sums do on a ball. A near-ball counts all sources.
double rows_in_step(const MeshPlan& plan, double node_modulus);

// Returns the window error that keeps the plan's share; `source2` is the sum of squared weights.
double allowed_window_error(const MeshPlan& plan, double source2);

}  // namespace rholm
