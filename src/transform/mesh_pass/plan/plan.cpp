#include "transform/mesh_pass/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "harmonic/nonuniform/cost_model.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/error.h"
#include "transform/geometry/star_geometry.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

// Shares of the wanted error; they add up in squares.
constexpr double kRuleShare = 0.46;
constexpr double kWindowShare = 0.45;
constexpr double kQuantumShare = 0.2;
// Error of vertices aligned with the grid, in units of the window's error of the norm. With this
// and the next constants, windows have at most a fifth of their share on cube-spheres, boxes,
// prisms, lattices and balls (bench/mesh_plan_bench).
constexpr double kLatticeShare = 0.4;
// Sources along a meridian or a parallel, as on extruded shapes, are all alike to the grid. The
// parts, which cancel in the whole, set the error. It is 4 to 8 times the error of a cube-sphere
// for a box, a sixth of whose edges are aligned. The error grows with the share of aligned edges.
constexpr double kAlignedTimes = 7, kAlignedShare = 0.2;
double lattice_share(double aligned) {
  return kLatticeShare / (1 + kAlignedTimes * std::min(1.0, aligned / kAlignedShare));
}

// Error of nodes in rows, relative to the window's error of the moduli of their weights. Balls,
// planets and lattices have 0.002 to 2.3 of it.
constexpr double kRowsInStep = 0.5;
// Error of all sources of a body that is nearly a ball, in rows about any axis. Chosen: 17 to 28
// times the value from sums of squares, with which windows had 1.2 to 2.9 times their share on
// balls of 200 000 to 1 000 000 faces. It counts in full where the norm without the mean is below
// kRound of the mean.
constexpr double kRoundInStep = 0.02, kRound = 3e-4;
double roundness(const MeshSample& sample) {
  const double relief = sample.norm / (sample.mean * std::sqrt(4 * kPi));
  return kRound / std::max(kRound, relief);
}

// Error of windows in single precision for aligned sources, relative to the sum of the moduli of
// their weights (4e-10 to 1e-9 where windows are good enough).
constexpr double kSingleInStep = 9e-10;

// A rule chosen as just good enough has, in the mean, this part of its allowed error.
constexpr double kTypicalShare = 0.4;
// Elements (edges and faces) per triangle.
constexpr double kElements = 2.5;

// Returns the limit of names for some four thousand sampled edges. They give the sum of squares to
// a few per cent, if none outweighs the others.
std::uint32_t sampled_names(std::size_t n_faces) {
  const double part = 4000 / (1.5 * static_cast<double>(n_faces));
  return static_cast<std::uint32_t>(std::min(1.0, part) * 4294967295.0);
}

// Returns the allowed error of each edge and face with nodes. A kind of face that the sample lacks
// counts as three of its faces, as in largest_tolerance().
double allowed_of_element(const MeshPlan& plan, const MeshSample& sample, std::size_t n_faces) {
  const double noded =
      std::max(plan.node_share * static_cast<double>(n_faces), std::max(3 * sample.share, 10.0));
  return plan.allowed.rules * std::sqrt(node_share2(plan.node_share > 0) / (kElements * noded)) /
         kTypicalShare;
}

// Returns the largest rounding error that the weights of a face may have. Long faces that meet near
// the centre are alike: the rounding of sums over them adds up linearly in the waves around them.
// So the faces together may have a tenth of the wanted error (chosen). On a ball 2 |T| / d_T adds
// up to 8 pi r. Only faces with thirty times their part of that are refused (chosen), because
// bounded terms for every face would cost more than they save.
double allowed_face_rounding(const MeshPlan& plan, const MeshSample& sample, std::size_t n_faces) {
  const double wanted = 0.1 * plan.allowed.rules * plan.allowed.caution / kRuleShare;
  const double ball = 30 * kWeightRounding * 8 * kPi * sample.mean;
  return std::min(plan.divided.allowed, std::max(wanted, ball) / static_cast<double>(n_faces));
}

// Derivative p of 1/|x|^2 along a line is below p! / |x|^(p + 2). So the error is the error of
// plane waves times p!. Such errors are means over directions; the largest is at most 3 times the
// mean. The face is nearer to the centre than its corners, by a seventh where edges are a quarter:
// again 3 times more.
double mean_nodes_reach2(double allowed) {
  constexpr double kLeft = 9 * 120 * kSixNodesConstant;
  return std::min(1.0 / 16, std::pow(allowed / kLeft, 2.0 / 5));
}

BlockParameters block_parameters(const MeshView& mesh, const MeshSample& sample, const Vec3& center,
                                 int degree, const MeshPlan& plan, const Quantum& quantum) {
  return {.center = center,
          .scale = sample.scale,
          .degree = static_cast<double>(degree),
          .grazing2 = std::pow(grazing_slope(degree), 2),
          // The rule of lumping integrates 1/|x|^2 with an error of 5!/720 z^4 or less.
          .mean_reach2 = std::sqrt(6 * plan.allowed.mean),
          .mean_nodes_reach2 = mean_nodes_reach2(plan.allowed.mean),
          .per_weight = 1 / quantum.size,
          .per_gradient = std::max(degree, 1) / quantum.size,
          // Sums wrap around. Only sums of whole vertices, where the weights of neighbours cancel,
          // must fit into 31 bits.
          .largest = std::exp2(plan.single ? 28 : 48),
          // No other rounding cancels the rounding of Hessians, so their quanta are finer. Still
          // Hessians are smaller than weights, by kFarthest of hermite_rules.cpp.
          .per_hessian = 4 * std::pow(std::max(degree, 1), 2) / quantum.size,
          .sampled_names = sampled_names(mesh.n_faces)};
}

}  // namespace

AllowedErrors divide_error(const MeshSample& sample, double precision, double tighten) {
  if (!(sample.mean > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                "no direction sees the surface from the centre: its faces have no area");
  }
  const double c00 = sample.mean * std::sqrt(4 * kPi);
  const double whole = std::max(precision * sample.norm, kLumpRounding * c00) / tighten;
  AllowedErrors allowed;
  // Where sheets overlap, the norm of their alternating sum is below the sample's estimate.
  allowed.caution = sample.overlaps ? 1.5 : 1;
  allowed.rules = kRuleShare * whole / allowed.caution;
  allowed.window = kWindowShare * whole;
  allowed.quanta = kQuantumShare * whole;
  allowed.most_window = lattice_share(sample.aligned) * precision / tighten;
  allowed.mean = std::max(precision, kLumpRounding);
  allowed.rounding = 4 * kLumpRounding * c00 / sample.scale;
  return allowed;
}

LumpChoice choose_lumps(const MeshSample& sample, const AllowedErrors& allowed, int degree) {
  LumpChoice choice;
  choice.neighbours = neighbours_in_step(std::pow(degree * sample.angle, 2));
  choice.allowed2 = std::pow(allowed.rules / (lumping_error(degree) * choice.neighbours), 2);
  choice.tolerance2 = tolerance_of(sample, choice.allowed2);
  choice.node_share = noded_share(sample, choice.tolerance2);
  return choice;
}

std::optional<HermiteLumps> choose_hessians(const MeshSample& sample, const LumpChoice& lumps,
                                            double own_nodes) {
  if (lumps.node_share == 0) return std::nullopt;
  const double neighbours = std::max(lumps.neighbours, crowding_of(sample));
  std::optional<HermiteLumps> hermite =
      hermite_lumps(sample, lumps.allowed2 / std::pow(neighbours / lumps.neighbours, 2), own_nodes);
  if (!hermite || !(hermite->cost < own_node_cost() * own_nodes * lumps.node_share)) return {};
  hermite->neighbours = neighbours;
  return hermite;
}

bool single_suffices(const MeshSample& sample, const AllowedErrors& allowed, int degree,
                     bool hessians) {
  const double generic = std::sqrt(sample.source2 / (4 * kPi));
  return single_rounding(degree, hessians ? 2 : 1) * generic < 0.3 * allowed.window &&
         kSingleInStep * sample.modulus < allowed.window;
}

Quantum choose_quantum(const AllowedErrors& allowed, std::size_t n_vertices, bool single) {
  // Rounding to quanta adds variance q^2 / 12 at two corners of a face and twice that at the third.
  // The six corners at a vertex add 2/3 q^2.
  const double largest = allowed.quanta * std::sqrt(6 * kPi / static_cast<double>(n_vertices));
  const double size = std::exp2(std::floor(std::log2(largest)) - (single ? 0 : 6));
  return {.size = size, .error = allowed.quanta * size / largest};
}

MeshPlan plan_mesh(const MeshView& mesh, const MeshSample& sample, const Vec3& center, int degree,
                   double precision, const PlanLimits& limits) {
  MeshPlan plan;
  plan.allowed = divide_error(sample, precision, limits.tighten);
  LumpChoice lumps = choose_lumps(sample, plan.allowed, degree);
  if (limits.no_lumps) lumps.tolerance2 = 0, lumps.node_share = 1;
  plan.neighbours = lumps.neighbours;
  plan.source2 = sample.source2;
  plan.node_share = lumps.node_share;
  const auto own_nodes = [&] {
    const double element = allowed_of_element(plan, sample, mesh.n_faces);
    plan.divided = {.degree = degree, .allowed = element, .divided = true};
    return plan.node_share > 0 ? own_nodes_of(sample, plan.divided) : 0;
  };
  const std::optional<HermiteLumps> hermite =
      limits.no_lumps ? std::nullopt : choose_hessians(sample, lumps, own_nodes());
  if (hermite) {
    plan.node_share = hermite->node_share;
    plan.neighbours = hermite->neighbours;
  }
  plan.single =
      !limits.forbid_single && single_suffices(sample, plan.allowed, degree, hermite.has_value());
  const Quantum quantum = choose_quantum(plan.allowed, mesh.n_vertices, plan.single);
  plan.quanta_error = quantum.error;
  plan.block = block_parameters(mesh, sample, center, degree, plan, quantum);
  plan.block.tolerance2 = lumps.tolerance2;
  if (hermite) {
    plan.between = hermite->between;
    plan.hessian2 = hermite->hessian2;
    plan.block.hessians = true;
    plan.block.tolerance2 = hermite->tolerance2;
    plan.block.edge_reach2 = hermite->edge_reach2;
    plan.block.face_reach2 = hermite->face_reach2;
  }
  plan.aligned = sample.aligned;
  plan.round_modulus = roundness(sample) * sample.modulus;
  plan.node_modulus = std::min(1.0, plan.node_share + plan.between) * sample.modulus;
  plan.nodes = plan.between + plan.node_share * own_nodes();
  plan.face_rounding = allowed_face_rounding(plan, sample, mesh.n_faces);
  return plan;
}

double rows_in_step(const MeshPlan& plan, double node_modulus) {
  return std::max(kRowsInStep * plan.aligned * node_modulus, kRoundInStep * plan.round_modulus) /
         std::sqrt(4 * kPi);
}

double allowed_window_error(const MeshPlan& plan, double source2) {
  const double generic = std::sqrt(std::max(source2, 1e-300) / (4 * kPi));
  const double most = std::max(generic, rows_in_step(plan, plan.node_modulus));
  return std::min(plan.allowed.most_window, plan.allowed.window / most);
}

}  // namespace rholm
