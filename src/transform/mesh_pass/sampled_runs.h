// Samples runs of a large mesh's faces from all over it, with their edges and vertices.
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

// A face as in the pass, and its elements that belong to a run. An edge or a vertex belongs to the
// run of the first face of the mesh that has it. So it is in one run only.
struct SampledTriangle {
  std::array<Vec3, 3> p;
  std::array<std::uint32_t, 3> vertices;
  std::array<double, 3> weight;  // W
  double face_weight = 0;        // F
  bool lumped = true;
  bool face = true;
  std::array<bool, 3> edges = {};    // edge from corner i to the next one
  std::array<bool, 3> corners = {};  // the vertex belongs to the run, with all its lumps
};

// The faces of a run, then faces around it that have an edge or a vertex of the run.
struct SampledRun {
  double chance = 1;  // chance of being in the sample
  std::vector<SampledTriangle> faces;
};

struct SampledRuns {
  std::vector<SampledRun> runs;
  double share = 0;  // part of the mesh's faces that are in runs
  // Factor for errors that are alike: the inverse of the mean of sqrt(c c') over pairs of runs,
  // where c is the chance of each. Errors are as in the model, or alike for all runs, whichever
  // gives a larger factor.
  double common = 1;
};

// Smallest and largest number of runs (chosen).
struct RunCount {
  double fewest = 64, most = 80;
};

// Takes about `share` of the blocks of kTrianglesPerBlock faces, each as a run: half of them
// evenly, half by `errors`, the model's error of each. `block` has the parameters of the pass.
SampledRuns sample_runs(const MeshView& mesh, const MeshPassOptions& options,
                        const BlockParameters& block, std::span<const float> errors, double share,
                        const RunCount& number, const Context& context);

}  // namespace rholm
