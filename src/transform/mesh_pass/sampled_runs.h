// Runs of a large mesh's triangles from all over it, with their edges and vertices: a sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "rholm/vec3.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/pass_options.h"

namespace rholm {

// A triangle as the pass sees it, and what of it belongs to a run. An edge or a vertex belongs to
// the run of the first triangle of the mesh that has it, so that all runs have each once.
struct SampledTriangle {
  std::array<Vec3, 3> p;
  std::array<std::uint32_t, 3> vertices;
  std::array<double, 3> weight;  // W
  double face_weight = 0;        // F
  bool lumped = true;
  bool face = true;
  std::array<bool, 3> edges = {};    // from corner i to the next
  std::array<bool, 3> corners = {};  // belongs with all that is lumped there
};

// The triangles of a run, and behind them those around it that have an edge or a vertex of it.
struct SampledRun {
  double chance = 1;  // that it is in the sample
  std::vector<SampledTriangle> triangles;
};

struct SampledRuns {
  std::vector<SampledRun> runs;
  double share = 0;  // of the mesh's triangles that are in runs
  // What errors that are alike count for: the inverse of the mean of sqrt(c c') over pairs of runs,
  // c the chance of each; for errors as the model has them, or alike for all runs, whichever is
  // more.
  double common = 1;
};

// Chosen: how many runs there are at least and at most.
struct RunCount {
  double fewest = 64, most = 80;
};

// About `share` of the blocks of kTrianglesPerBlock triangles, each a run: half of them evenly,
// half by `errors`, what the model says that each leaves. `block` as of the pass.
SampledRuns sample_runs(const MeshView& mesh, const MeshPassOptions& options,
                        const BlockParameters& block, std::span<const float> errors, double share,
                        const RunCount& number, const Context& context);

}  // namespace rholm
