// What a mesh pass is to do.
#pragma once

#include <cstddef>
#include <functional>

#include "parts/executor.h"
#include "rholm/error.h"
#include "rholm/vec3.h"

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
  std::size_t parts = 0;  // for tests; 0: as part_count() says
  // Has other processes work parts, by a PassHelper of the same mesh (shared_parts.h); none: this
  // one works all. Not for triangles that have to be ordered first.
  Executor* executor = nullptr;
};

// Throws InvalidInput if `options.check` says that these are no triangles.
inline void check_triangles(const MeshPassOptions& options, std::size_t first, std::size_t n) {
  if (options.check && !options.check(first, n)) {
    throw Error(ErrorCode::kInvalidInput, "a face is not a triangle");
  }
}

}  // namespace rholm
