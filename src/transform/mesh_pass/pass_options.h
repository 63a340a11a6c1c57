// Options of a mesh pass.
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
  double window_share = 1;  // factor of the allowed window error; for benchmarks of the plan
  // check() and release() are called with blocks of faces before and after their use, in order
  // within a thread. check() returns false if some are not triangles.
  std::function<bool(std::size_t first, std::size_t n)> check = {};
  std::function<void(std::size_t first, std::size_t n)> release = {};
  // Called with ranges of vertices that will hardly be used again.
  std::function<void(std::size_t first, std::size_t n)> release_vertices = {};
  std::size_t parts = 0;  // number of parts, for tests; 0: by part_count()
  // Lets other processes compute parts, by a PassHelper of the same mesh (shared_parts.h). If null,
  // this process computes all parts. It is not used for faces that must be sorted first.
  Executor* executor = nullptr;
};

// Throws InvalidInput if `options.check` says that a face is not a triangle.
inline void check_triangles(const MeshPassOptions& options, std::size_t first, std::size_t n) {
  if (options.check && !options.check(first, n)) {
    throw Error(ErrorCode::kInvalidInput, "a face is not a triangle");
  }
}

}  // namespace rholm
