// Cuts triangles into pieces for rules, which need them short against the distance from the centre.
//
// Halving only the longest edge takes exponentially many pieces for needles that pass near the
// centre. The halves lie side by side, and both are as near. Instead a needle is cut across its
// length into sections that grow with their distance. Their number is the logarithm of the length
// over the larger of width and distance.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "rholm/vec3.h"
#include "transform/rules/bernstein_rules.h"

namespace rholm {

// Returns the longest edge; edge i begins at corner i.
inline std::size_t longest_side(const std::array<Vec3, 3>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
  const std::array<double, 3> squares = {dot(a, a), dot(b, b), dot(c, c)};
  return static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
}

// The part of a triangle a, b, c between two places t on its longest edge ab, on one side of its
// height. One border is P(t) = a + t (b - a), the other Q(t) = end + width(t) (c - end). `end` is a
// or b, and the width runs from 0 there to 1 at the height.
template <typename Visit>
class NeedleSide {
 public:
  NeedleSide(const Vec3& a, const Vec3& b, const Vec3& c, double height_at, bool at_a,
             double longest, double width, const Visit& visit)
      : a_(a),
        along_(b - a),
        end_(at_a ? a : b),
        apex_(c),
        height_at_(height_at),
        at_a_(at_a),
        longest_(longest),
        width_(width),
        visit_(visit) {}

  void cut(double from, double to, int depth = 0) const {
    const Vec3 p0 = on_edge(from), p1 = on_edge(to), q0 = beyond(from), q1 = beyond(to);
    const double length = (to - from) * norm(along_);
    const auto distance = [&] {
      return std::min(triangle_distance({p0, p1, q1}), triangle_distance({p0, q1, q0}));
    };
    constexpr int kMostHalvings = 100;  // doubles resolve no more
    if (depth < kMostHalvings && length > width_ && length > longest_ * distance()) {
      const double middle = 0.5 * (from + to);
      cut(from, middle, depth + 1);
      cut(middle, to, depth + 1);
      return;
    }
    // Areas of the two triangles of the section, as shares of the whole.
    const double first = (to - from) * width(to), second = (to - from) * width(from);
    if (first > 0) visit_(std::array<Vec3, 3>{p0, p1, q1}, first);
    if (second > 0) visit_(std::array<Vec3, 3>{p0, q1, q0}, second);
  }

 private:
  Vec3 on_edge(double t) const { return a_ + t * along_; }
  double width(double t) const { return at_a_ ? t / height_at_ : (1 - t) / (1 - height_at_); }
  Vec3 beyond(double t) const { return end_ + width(t) * (apex_ - end_); }

  Vec3 a_, along_, end_, apex_;
  double height_at_;
  bool at_a_;
  double longest_, width_;
  const Visit& visit_;
};

// Cuts a triangle. Calls visit(piece, share) with the piece's share of the area. Pieces of needles
// are at most as long as `longest` times their distance, or as the needle's width.
template <typename Visit>
void cut_triangle(const std::array<Vec3, 3>& p, double longest, const Visit& visit) {
  const std::size_t k = longest_side(p);
  const Vec3 &a = p[k], &b = p[(k + 1) % 3], &c = p[(k + 2) % 3];
  const Vec3 along = b - a;
  const double length2 = dot(along, along), length = std::sqrt(length2);
  const double height = norm(cross(along, c - a)) / length;
  constexpr double kNeedle = 0.125;  // chosen: wider triangles keep their shape when halved
  if (height > kNeedle * length || length <= longest * triangle_distance(p)) {
    const Vec3 middle = 0.5 * (a + b);
    visit(std::array<Vec3, 3>{a, middle, c}, 0.5);
    visit(std::array<Vec3, 3>{middle, b, c}, 0.5);
    return;
  }
  const double height_at = std::clamp(dot(along, c - a) / length2, 0.0, 1.0);
  // A section's triangles are longer than the section by at most an eighth.
  const double section = longest / 1.125;
  if (height_at > 0) {
    NeedleSide<Visit>(a, b, c, height_at, true, section, height, visit).cut(0, height_at);
  }
  if (height_at < 1) {
    NeedleSide<Visit>(a, b, c, height_at, false, section, height, visit).cut(height_at, 1);
  }
}

}  // namespace rholm
