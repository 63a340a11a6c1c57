// Error of a mesh pass, by the model with which its plan was made and the sums that are known after
// the pass.
#pragma once

#include <cstdint>
#include <vector>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "rholm/coefficients.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

struct PassFacts {
  double face_error2 = 0;   // see BlockSums
  double node_error2 = 0;   // sum over all elements with nodes, see NodeWriter
  double node_modulus = 0;  // sum of the moduli of nodes' weights
  std::vector<SampledHalfEdge> half_edges;
  double source2 = 0;   // sum of squares of all sources that were spread
  double hessian2 = 0;  // sum of squares of L^2 times Hessians, at the vertices
  std::size_t vertices = 0;
  NonuniformPlan transform;
};

// Errors in the mesh's unit.
struct PassError {
  double whole = 0;  // l2 over 1 <= l <= L
  double band = 0;   // l2 over the degrees above 3L/4
  // Errors without the rules' part.
  double whole_beside = 0, band_beside = 0;
};
PassError error_of_pass(const MeshPlan& plan, PassFacts& facts, const Coefficients& coefficients);

// Returns the sum of squares of W z^4 over all edges between lumped faces, estimated from the
// pass's sample of half-edges. Sorts the sample.
double sampled_error2(std::vector<SampledHalfEdge>& sample, std::uint32_t sampled_names);

// Returns the l2 norm of the degrees first ... last.
double norm_of_degrees(const Coefficients& c, int first, int last);

}  // namespace rholm
