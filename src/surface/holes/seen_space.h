// Space that scanners have seen to be empty (method 7.13). Layer: surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/surface_rules.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"

namespace rholm {

// Cubes crossed by the lines of sight from sensors to points, without the end of each line.
class SeenSpace {
 public:
  // Takes one sensor per point. Cubes have at least this edge; at most 256 fit
  // along each axis of the points' box. Lines end `margin` before their points.
  SeenSpace(std::span<const Vec3> points, std::span<const Vec3> sensors, double edge, double margin,
            const Context& context = {});

  // Restores the space from another one's kept().
  explicit SeenSpace(const SeenCubes& kept, const Context& context = {});

  // Starts with unseen cubes in `box`, for points that come in parts. Lines are added,
  // or cubes that parts with the same box and edge have seen; smooth() ends this phase.
  SeenSpace(const Bounds& box, double edge);
  void add_lines(std::span<const Vec3> points, std::span<const Vec3> sensors, double margin,
                 const Context& context = {});
  std::vector<std::uint64_t> cubes() const;  // one bit per cube
  void add_cubes(std::span<const std::uint64_t> cubes);
  void smooth(const Context& context = {});
  // Returns the data that restore this space, after smooth().
  SeenCubes kept() const { return {origin_, edge_, size_, bits_}; }

  // Returns the emptiness at x: 1 if all cubes around are seen, 0 if none is; continuous.
  double emptiness(const Vec3& x) const;

 private:
  std::size_t cell(std::size_t i, std::size_t j, std::size_t k) const {
    return i + size_[0] * (j + size_[1] * k);
  }
  void go_through(Vec3 from, Vec3 to);

  Vec3 origin_;
  double edge_ = 1;
  std::array<std::size_t, 3> size_ = {};
  std::vector<std::uint8_t> seen_;  // after smooth(): sum over the cubes around, up to kAll
  std::vector<std::uint8_t> bits_;  // bits of SeenCubes: `seen_` before smoothing
};

}  // namespace rholm
