// Lets several processes, each of which has the mesh, compute the parts of a mesh pass.
//
// One of them runs the pass: it plans the pass and tells the others what they need (inputs). It
// adds up their results, as bytes, in the order of the parts. The pass has two rounds: the ranges
// of vertices of all parts; then the parts, with the grids to which they are spread. The process
// that runs the pass adds up and spreads lumps in common.
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

// Tasks of both rounds. They return the IndexRange of a part; and a part, its grid and, if
// `in_common`, its lumps in common.
template <typename T>
std::string range_task(const PartWorker<T>& worker, std::size_t part);
template <typename T>
std::string part_task(const PartWorker<T>& worker, bool in_common, std::size_t part);

// The name of this task, and the inputs of its rounds.
inline constexpr const char* kPassJob = "mesh pass";
std::string ranges_job(const MeshPlan& plan, const NonuniformPlan& transform,
                       const Division& division);
std::string parts_job(const std::vector<IndexRange>& ranges, bool in_common);

// Computes parts in another process, for one pass after the other over a mesh; `hooks` as for
// mesh_pass(). Mesh and hooks must outlive this object.
class PassHelper {
 public:
  PassHelper(const MeshView& mesh, const MeshPassOptions& hooks) : mesh_(mesh), hooks_(hooks) {}
  // Returns the function for the parts of a round, valid as long as this object and until the next
  // round. Throws Io for bytes that are no input.
  Executor::Work work_of(std::string_view input);

 private:
  const MeshView& mesh_;
  const MeshPassOptions& hooks_;
  std::unique_ptr<PartWorker<float>> single_;
  std::unique_ptr<PartWorker<double>> double_;
};

}  // namespace rholm
