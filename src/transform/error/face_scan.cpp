#include "transform/error/face_scan.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"

namespace rholm {
namespace {

// Returns true if no face names a vertex twice: it would be counted and be no face.
bool have_three_corners(const MeshView& mesh, const FaceSizes& sizes) {
  for (std::size_t run = 0; run < sizes.flat.size(); ++run) {
    if (sizes.flat[run] == 0) continue;
    const std::size_t first = run * FaceSizes::kRun;
    for (std::size_t t = first; t < std::min(mesh.n_faces, first + FaceSizes::kRun); ++t) {
      const auto [a, b, c] = mesh.triangle(t);
      if (a == b || b == c || c == a) return false;
    }
  }
  return true;
}

}  // namespace

FaceScan scan_faces(const MeshView& mesh, FaceSizes sizes) {
  FaceScan scan{.sizes = std::move(sizes), .used = {}};
  // A star-shaped surface is a sphere, whose faces have F/2 + 2 corners or, with copies, more. If
  // there are no more vertices than F/2 + 2, all of them are used.
  if (2 * mesh.n_vertices == mesh.n_faces + 4 && have_three_corners(mesh, scan.sizes)) return scan;
  scan.used.resize(mesh.n_vertices);
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    for (const std::uint32_t i : mesh.triangle(t)) scan.used[i] = 1;
  }
  return scan;
}

FaceScan scan_faces(const MeshView& mesh, const Vec3& center, const Context& context) {
  FaceSizes sizes;
  exact_norms(mesh, center, context, &sizes);
  return scan_faces(mesh, std::move(sizes));
}

}  // namespace rholm
