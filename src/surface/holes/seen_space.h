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

// Cubes that lines of sight from a sensor to its point go through, but for the end of each line.
class SeenSpace {
 public:
  // One sensor a point. Cubes have at least this edge, and are at most 256 along each axis of the
  // points' box. Lines count up to `margin` before their points.
  SeenSpace(std::span<const Vec3> points, std::span<const Vec3> sensors, double edge, double margin,
            const Context& context = {});

  // As another one was, by its kept().
  explicit SeenSpace(const SeenCubes& kept, const Context& context = {});

  // Of points that are not there all at once: nothing has been seen in their box. Lines are added,
  // or the cubes that were seen in parts of the same box and edge; smooth() ends that.
  SeenSpace(const Bounds& box, double edge);
  void add_lines(std::span<const Vec3> points, std::span<const Vec3> sensors, double margin,
                 const Context& context = {});
  std::vector<std::uint64_t> cubes() const;  // a bit each
  void add_cubes(std::span<const std::uint64_t> cubes);
  void smooth(const Context& context = {});
  // What makes the same space again, once it is smooth.
  SeenCubes kept() const { return {origin_, edge_, size_, bits_}; }

  // How empty it is at x: 1 where all cubes around have been seen, 0 where none has; continuous.
  double emptiness(const Vec3& x) const;

 private:
  std::size_t cell(std::size_t i, std::size_t j, std::size_t k) const {
    return i + size_[0] * (j + size_[1] * k);
  }
  void go_through(Vec3 from, Vec3 to);

  Vec3 origin_;
  double edge_ = 1;
  std::array<std::size_t, 3> size_ = {};
  std::vector<std::uint8_t> seen_;  // then how much of the cubes around has been, of kAll
  std::vector<std::uint8_t> bits_;  // of SeenCubes: before that
};

}  // namespace rholm
