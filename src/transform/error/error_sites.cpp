#include "transform/error/error_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace rholm {
namespace {

// Many points on each face, evenly spread, tell more than a few points on each of many faces.
constexpr std::size_t kAreaPoints = 100'000, kFewAreaPoints = 20'000, kOnFace = 16;
constexpr std::size_t kClosestPoints = 20'000, kFewClosestPoints = 3'000;

}  // namespace

bool shows_its_edges(const MeshView& mesh, int degree) {
  const double angle = 1.5 * std::sqrt(4 * std::numbers::pi / static_cast<double>(mesh.n_faces));
  constexpr double kCoarse = 6;  // scripts/constants: off by 20 % at 5, by a few % from 10 on
  return degree * angle > kCoarse;
}

const FaceScan& ErrorSites::scan() {
  if (!scan_) {
    scan_ = sizes_ ? scan_faces(mesh_, std::move(*sizes_))
                   : scan_faces(mesh_, center_, {.threads = threads_});
  }
  return *scan_;
}

const ErrorPoints& ErrorSites::vertices() {
  if (!vertices_) vertices_ = extreme_points(mesh_, center_, scan(), 0);
  return *vertices_;
}

const ErrorPoints& ErrorSites::all(int degree) {
  if (degree_ != degree) {
    all_ = extreme_points(mesh_, center_, scan(), degree);
    all_.append(over_area());
    degree_ = degree;
  }
  return all_;
}

const ErrorPoints& ErrorSites::over_area() {
  if (!over_area_) {
    const std::size_t n = std::clamp(kOnFace * mesh_.n_faces, kFewAreaPoints, kAreaPoints);
    over_area_ = area_points(mesh_, center_, scan(), n, {.threads = threads_});
  }
  return *over_area_;
}

ClosestDistances& ErrorSites::closest(bool fine) {
  std::optional<ClosestDistances>& sites = fine ? many_ : few_;
  if (!sites) sites.emplace(mesh_, center_, fine ? kClosestPoints : kFewClosestPoints);
  return *sites;
}

const ErrorStrengths& ErrorSites::strengths() {
  if (!strengths_) strengths_ = vertex_error_strengths(mesh_, center_);
  return *strengths_;
}

}  // namespace rholm
