// Parts of a mesh pass worked by several processes, each of which has the mesh.
//
// One of them runs the pass: it plans it, says what the others need to know (inputs), and adds up
// what they make of parts, as bytes, in the order of the parts. The pass has two rounds of parts:
// the ranges of vertices of all parts; and the parts, with the grids they are spread to. Lumps that
// parts have in common are added up and spread by the one who runs the pass.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "parts/executor.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/part_worker.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// The tasks of both rounds: the IndexRange of a part; a part, its grid and, if they have lumps in
// common, these.
template <typename T>
std::string range_task(const PartWorker<T>& worker, std::size_t part);
template <typename T>
std::string part_task(const PartWorker<T>& worker, bool in_common, std::size_t part);

// The name of this work, and the inputs of its rounds.
inline constexpr const char* kPassJob = "mesh pass";
std::string ranges_job(const MeshPlan& plan, const NonuniformPlan& transform,
                       const Division& division);
std::string parts_job(const std::vector<IndexRange>& ranges, bool in_common);

// In another process, for one pass after the other over a mesh; `hooks` of mesh_pass(). Both are
// good as long as this.
class PassHelper {
 public:
  PassHelper(const MeshView& mesh, const MeshPassOptions& hooks) : mesh_(mesh), hooks_(hooks) {}
  // The work of a round, as long as this and until the next one. Throws Io for bytes that are no
  // input.
  Executor::Work work_of(std::string_view input);

 private:
  const MeshView& mesh_;
  const MeshPassOptions& hooks_;
  std::unique_ptr<PartWorker<float>> single_;
  std::unique_ptr<PartWorker<double>> double_;
};

}  // namespace rholm
