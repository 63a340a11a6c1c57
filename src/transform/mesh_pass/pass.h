// From a mesh where it lies to the coefficients of its radius: (M8), vertices lumped, fast sums.
#pragma once

#include <functional>
#include <vector>

#include "base/shared_tasks.h"
#include "rholm/analyze.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/division.h"

namespace rholm {

struct MeshPassOptions {
  int degree = 0;
  double precision = 1e-6;
  Vec3 center = {};
  double window_share = 1;  // what windows may leave, times this; for benchmarks of the plan
  // Called with blocks of triangles, in order within a thread, before and after they are used:
  // the first returns false if they are not triangles after all.
  std::function<bool(std::size_t first, std::size_t n)> check = {};
  std::function<void(std::size_t first, std::size_t n)> release = {};
  // Called with ranges of vertices that will hardly be used any more.
  std::function<void(std::size_t first, std::size_t n)> release_vertices = {};
  std::size_t most_held = kMostHeld;  // triangles, see division.h; another for tests
  std::size_t streamed_parts = 0;     // beyond them; 0: as division.h says
  // Other processes that work parts, by a PassHelper of the same mesh (shared_parts.h); none: this
  // one works all. Not for triangles that have to be ordered first.
  ShareTasks share = {};
};

// Chosen: the error of closed meshes of up to so many triangles is measured by a second reading
// (verify.h), that of larger ones by mesh_pass() itself, on a sample (sampled_rules.h).
inline constexpr std::size_t kMostVerified = 100'000;

struct MeshPassResult {
  Coefficients coefficients;  // of the radius; of the alternating sum where it is not star-shaped
  double volume = 0;          // enclosed; negative if inside out
  bool closed = false;        // every edge run through as often one way as the other, by a hash
  double min_d = 0;
  double min_cos_gamma = 0;
  std::size_t bad_triangles = 0;
  FastReport report;
  // But for what rules leave, l2 over 1 <= l <= L and over the degrees above 3L/4.
  double error_beside = 0, band_error_beside = 0;
  std::vector<float> block_errors;  // of kTrianglesPerBlock triangles, see MeshPart
  double least_error = 0;           // what rounding leaves at best, relative as FastReport::error
  StageTimes times;  // "triangles", "spread", "fourier"; "order" if triangles were sorted
};

// Throws InvalidInput for coordinates that are not finite, indices out of range, `check` that
// fails, a surface through the centre; Cancelled.
MeshPassResult mesh_pass(const MeshView& mesh, const MeshPassOptions& options,
                         const Context& caller);

}  // namespace rholm
