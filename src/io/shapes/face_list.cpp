#include "io/shapes/face_list.h"

#include <utility>

#include "io/shapes/shape_source.h"
#include "rholm/polygon.h"

namespace rholm {

std::string skipped_warning(std::size_t faces) {
  return counted(faces, "face", "faces") + " with fewer than 3 corners skipped";
}

void FaceList::add(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) {
    triangles_.push_back({corners[0], corners[1], corners[2]});
  } else if (corners.size() > 3) {
    add_polygon(corners);
  } else {
    ++skipped_;
  }
}

void FaceList::add_polygon(std::span<const std::uint32_t> corners) {
  const std::size_t first = corners_.size();
  for (const std::uint32_t corner : corners) {
    if (corners_.size() == first || corners_.back() != corner) corners_.push_back(corner);
  }
  while (corners_.size() > first + 1 && corners_.back() == corners_[first]) corners_.pop_back();
  if (corners_.size() - first < 3) {
    corners_.resize(first);
    ++skipped_;
    return;
  }
  polygons_.push_back({.place = triangles_.size(), .end = corners_.size()});
}

std::vector<Triangle> FaceList::finish(const std::vector<Vec3>& vertices,
                                       std::vector<std::string>& warnings) {
  if (skipped_ > 0) {
    warnings.push_back(skipped_warning(skipped_));
  }
  if (polygons_.empty()) return std::move(triangles_);
  std::vector<Triangle> all;
  all.reserve(triangles_.size() + corners_.size() - 2 * polygons_.size());
  std::size_t taken = 0;
  std::size_t first = 0;
  const auto take_to = [&](std::size_t end) {
    all.insert(all.end(), triangles_.begin() + static_cast<std::ptrdiff_t>(taken),
               triangles_.begin() + static_cast<std::ptrdiff_t>(end));
    taken = end;
  };
  for (const Polygon& polygon : polygons_) {
    take_to(polygon.place);
    triangulate_polygon(vertices, std::span(corners_).subspan(first, polygon.end - first), all);
    first = polygon.end;
  }
  take_to(triangles_.size());
  return all;
}

}  // namespace rholm
