// Parts of a mesh pass worked by several processes, each of which has the mesh.
//
// One of them runs the pass: it plans it, says what the others need to know (jobs), and adds up
// what they make of parts, as bytes, in the order of the parts. The pass has up to three rounds of
// tasks: the ranges of vertices of all parts; the parts, with the grids they are spread to where
// the window is chosen already; and these grids where it is not. Then parts are held by who worked
// them, and grids are dealt as the parts were; a part that is not there is worked again. Lumps that
// parts have in common are added up and spread by the one who runs the pass.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "harmonic/nonuniform/nonuniform_plan.h"
#include "parts/executor.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/part_worker.h"
#include "transform/mesh_pass/pass_options.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {

// What one process has of a shared pass. Tasks may be done by several threads at a time.
template <typename T>
class SharedParts {
 public:
  SharedParts(const MeshView& mesh, const MeshPassOptions& options, const MeshPlan& plan,
              const Division& division);
  SharedParts(const SharedParts&) = delete;
  SharedParts& operator=(const SharedParts&) = delete;

  // Before parts are worked: `groups` of them are tasks, with a window as many as there are parts;
  // whether they have their lumps in common, which then travel, as nodes without a grid do.
  void set_ranges(std::vector<IndexRange> ranges, std::size_t groups, bool in_common);
  // Before parts are worked, or before they are spread.
  void set_transform(const NonuniformPlan& transform);

  // The tasks of the three rounds: the IndexRange of a part; a group of parts; one of `n` grids.
  std::string range_of(std::size_t part) const;
  std::string work(std::size_t group);
  std::string spread(std::size_t grid, std::size_t n);

  // Parts of group g of n.
  std::size_t first(std::size_t g, std::size_t n) const { return g * division_.count / n; }

 private:
  std::string work_to_grid(std::size_t part) const;
  std::string work_in_common(std::size_t group) const;
  WorkedPart<T> take_held(std::size_t part);

  const MeshPlan plan_;
  const Division division_;
  PartWorker<T> worker_;
  std::size_t groups_ = 0;
  bool in_common_ = false;
  std::optional<NonuniformPlan> transform_;
  GridKernel<T> kernel_;
  std::mutex mutex_;
  std::map<std::size_t, WorkedPart<T>> held_;
};

// The name of this work, and the inputs of its three rounds.
inline constexpr const char* kPassJob = "mesh pass";
std::string ranges_job(const MeshPlan& plan, const Division& division);
std::string parts_job(const std::vector<IndexRange>& ranges, std::size_t groups, bool in_common,
                      const NonuniformPlan* transform);
std::string grids_job(std::size_t n, const NonuniformPlan& transform);

// In another process, for one pass after the other over a mesh; `hooks` of mesh_pass(). Both are
// good as long as this.
class PassHelper {
 public:
  PassHelper(const MeshView& mesh, const MeshPassOptions& hooks) : mesh_(mesh), hooks_(hooks) {}
  // The work of a round, as long as this and until the next one. Throws Io for bytes that are no
  // input.
  Executor::Work work_of(std::string_view input);

 private:
  template <typename T>
  Executor::Work work_of(std::unique_ptr<SharedParts<T>>& parts, ByteReader& reader,
                         std::uint32_t round);

  const MeshView& mesh_;
  const MeshPassOptions& hooks_;
  std::unique_ptr<SharedParts<float>> single_;
  std::unique_ptr<SharedParts<double>> double_;
};

}  // namespace rholm
