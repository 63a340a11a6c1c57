// Edges between neighbours that say whether the signs of their normals agree. Layer: shape.
//
// An edge of the graph of neighbours says that its ends agree, or that they contradict each other,
// where the normal of one end, reflected in the plane that halves the edge, is nearly that of the
// other, or nearly its opposite (orient_graph.h), and where the edge lies within the surface: no
// end is above the other.
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
  float height = 0;  // of the end above the begin, along their normals, in lengths of the edge
};

class SignGraph {
 public:
  // Points and unit normals (zero: of no say) in the order of the tree. Edges that begin at points
  // which are `foreign`, if there are any, say nothing. `neighbors` are graph_neighbors().
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
  // Median height of neighbours above the tangent planes of points.
  double scatter() const { return scatter_; }
  // Whether the normals of the ends are far apart, as they are on two sides of a crease.
  bool is_crease(std::size_t e) const;
  // agreement() of the ends, without slack.
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

// Heights within so many times their median are the noise of the points (chosen: 2 standard
// deviations of Gaussian noise).
inline constexpr double kNoiseOfScatter = 3;

}  // namespace rholm
