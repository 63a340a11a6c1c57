// Adds up the parts of a mesh pass.
#pragma once

#include <cstddef>
#include <vector>

#include "transform/mesh_pass/mesh_part.h"
#include "transform/mesh_pass/part_worker.h"
#include "transform/mesh_pass/pass_result.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// First parts are added in their order, then lumps in common, if there are any. Then finish() is
// called, and results may be read.
template <typename T>
class PassSums {
 public:
  explicit PassSums(const MeshPlan& plan) : plan_(plan), border_sums_(plan.block.hessians) {}

  void add(const MeshPart<T>& part, bool lumps_in_common = false);
  void add_common(const LumpSums& lumps) { common_.add(lumps); }
  // Takes the complete vertices of the border, which are not in the ranges `later`, for spreading.
  BorderLumps<LumpOf<T>> take_border(const std::vector<IndexRange>& later,
                                     const PartWorker<T>& worker);
  // Throws InvalidInput if something is wrong with the mesh.
  Outcome finish(const PartWorker<T>& worker);

  const BorderLumps<LumpOf<T>>& border() const { return *border_; }

  // `sum` is the transform of all grids; `source2` and `hessian2` are counted by the grids.
  void set_result(const MeshView& mesh, Coefficients sum, double source2, double hessian2,
                  const NonuniformPlan& transform, MeshPassResult& result);

 private:
  void set_error(const MeshView& mesh, double source2, double hessian2,
                 const NonuniformPlan& transform, MeshPassResult& result);

  const MeshPlan& plan_;
  MeshPart<T> whole_;  // without its border
  BorderSums<LumpOf<T>> border_sums_;
  const BorderLumps<LumpOf<T>>* border_ = nullptr;  // the border that was not taken
  LumpSums border_lumps_, common_;
  double weight_beside_common_ = 0;  // weight without lumps in common, in quanta
  double lumps2_ = 0;                // sum of squares of lumps, as they count in a window's error
  bool out_of_range_ = false;
};

}  // namespace rholm
