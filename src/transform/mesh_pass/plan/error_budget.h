// What a mesh pass has left, by the model its plan was made with and the sums that are known after
// it.
#pragma once

#include <vector>

#include "harmonic/nonuniform/nonuniform.h"
#include "rholm/coefficients.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

struct PassFacts {
  double face_error2 = 0;  // see BlockSums
  std::size_t noded = 0;   // triangles with nodes
  std::vector<SampledHalfEdge> half_edges;
  double source2 = 0;   // sum of squares of all that was spread
  double hessian2 = 0;  // and of L^2 times Hessians, at the vertices
  std::size_t vertices = 0;
  NonuniformPlan transform;
};

// In the mesh's unit.
struct PassError {
  double whole = 0;  // l2 over 1 <= l <= L
  double band = 0;   // over the degrees above 3L/4
  // Energy of the errors of lumped edges in units of that of lumped faces; 0 if there are none.
  double edge_ratio = 0;
};
PassError error_of_pass(const MeshPlan& plan, PassFacts& facts, const Coefficients& coefficients);

// l2 norm of the degrees first ... last of the function.
double norm_of_degrees(const Coefficients& c, int first, int last);

}  // namespace rholm
