// Finds edges between neighbours that tell whether the signs of their normals agree. Layer: shape.
//
// The normal of one end is reflected in the plane that halves the edge (orient_graph.h). The ends
// agree if the result is nearly the normal of the other end, and contradict each other if it is
// nearly opposite. An edge counts only if it lies within the surface: neither end is above the
// other along their normals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

enum class Says : std::int8_t { kNothing = 0, kAgree = 1, kContradict = -1 };

struct SignEdge {
  Says says = Says::kNothing;
  float height = 0;  // height of the end over the begin along their normals, in edge lengths
};

class SignGraph {
 public:
  // Takes points and unit normals (zero: no vote) in the order of the tree. `foreign` (may be
  // empty) flags points where edges begin that have no vote. `neighbors` are graph_neighbors().
  SignGraph(std::vector<std::uint32_t> neighbors, std::span<const Vec3> points,
            std::span<const Vec3> normals, std::span<const std::uint8_t> foreign,
            const Context& context);

  std::size_t n_points() const { return points_.size(); }
  // Edges i * kGraphNeighbors ... (i + 1) * kGraphNeighbors - 1 begin at point i.
  std::size_t size() const { return edges_.size(); }
  std::uint32_t from(std::size_t e) const {
    return static_cast<std::uint32_t>(e / kGraphNeighbors);
  }
  std::uint32_t to(std::size_t e) const { return neighbors_[e]; }
  const SignEdge& operator[](std::size_t e) const { return edges_[e]; }
  // Returns the median height of neighbours above the tangent planes of points.
  double scatter() const { return scatter_; }
  // Returns true if the normals of the ends differ as on two sides of a crease.
  bool is_crease(std::size_t e) const;
  // Returns agreement() of the ends without slack.
  double agreement_at(std::size_t e) const;

 private:
  double height_over(std::size_t e, const Vec3& normal) const;
  double find_scatter() const;
  SignEdge look(std::size_t e, double slack) const;

  std::span<const Vec3> points_, normals_;
  std::vector<std::uint32_t> neighbors_;
  std::vector<SignEdge> edges_;
  double scatter_ = 0;
};

// Heights up to this many times their median are noise of the points (chosen: 2 standard
// deviations of Gaussian noise).
inline constexpr double kNoiseOfScatter = 3;

}  // namespace rholm
