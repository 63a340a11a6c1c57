// Samples of a surface in several densities, and connected patches of them. Layer: atlas.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Each sample represents the same area; normals have length 1.
struct SampleLevel {
  PointTree tree;
  std::vector<Vec3> points, normals;  // samples in the order of the tree
  std::vector<std::uint32_t> base;    // index of each sample in the finest level
  std::vector<std::uint32_t> near;    // kSampleNeighbors per sample
  double spacing = 0;                 // side of a square with the area of a sample
};

inline constexpr std::size_t kSampleNeighbors = 8;

// Level 0 has all samples; each further level has an even quarter of the previous one.
// Samples must come in an order in which every fourth one represents the surface.
struct SampleLevels {
  std::vector<std::unique_ptr<SampleLevel>> levels;
  std::size_t size() const { return levels.front()->points.size(); }
  const SampleLevel& finest() const { return *levels.front(); }
  // Returns the densest level with at most about `most` samples on a disc of this radius.
  const SampleLevel& level_for(double radius, std::size_t most) const;
};
SampleLevels make_levels(std::span<const Vec3> points, std::span<const Vec3> normals,
                         const Context& context);

// Memory of searches over neighbours, one per thread.
class PatchSearch {
 public:
  // Returns samples connected to `start` through samples for which `accept(index)` is true.
  template <class Accept>
  std::span<const std::uint32_t> grow(const SampleLevel& level, std::uint32_t start,
                                      const Accept& accept) {
    begin(level.points.size());
    found_.clear();
    if (!accept(start)) return found_;
    take(start);
    for (std::size_t next = 0; next < found_.size(); ++next) {
      const std::uint32_t* const near = &level.near[kSampleNeighbors * found_[next]];
      for (std::size_t k = 0; k < kSampleNeighbors; ++k) {
        if (seen_[near[k]] == mark_) continue;
        if (accept(near[k])) {
          take(near[k]);
        } else {
          seen_[near[k]] = mark_;
        }
      }
    }
    return found_;
  }

 private:
  void begin(std::size_t n);
  void take(std::uint32_t i) {
    seen_[i] = mark_;
    found_.push_back(i);
  }
  std::vector<std::uint32_t> seen_, found_;
  std::uint32_t mark_ = 0;
};

}  // namespace rholm
