#include "shape/repair/thin_faces.h"

#include <algorithm>
#include <array>
#include <deque>
#include <unordered_set>

#include "base/cancel.h"
#include "shape/coordinate_error.h"
#include "shape/topology/mates.h"

namespace rholm {
namespace {

// Most swaps per thin face (chosen). A swap may leave one of two faces thin, but it shortens the
// longest edge, so swaps end; the limit guards against rounding.
constexpr std::size_t kSwapsOfFace = 16;

class ThinFaceSwaps {
 public:
  ThinFaceSwaps(const std::vector<Vec3>& vertices, const Vec3& error,
                std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates,
                std::vector<char>* gone)
      : vertices_(vertices), error_(error), triangles_(triangles), mates_(mates), gone_(gone) {}

  std::size_t run() {
    CancelPoll poll;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      poll();
      if (is_thin_face(triangles_[t])) waiting_.push_back(t);
    }
    if (waiting_.empty()) return 0;
    find_edges();
    std::size_t left = kSwapsOfFace * waiting_.size();
    for (; !waiting_.empty() && left > 0; --left) {
      poll();
      const std::uint32_t t = waiting_.front();
      waiting_.pop_front();
      if (!is_gone(t) && is_thin_face(triangles_[t])) try_swap(t);
    }
    return removed_;
  }

 private:
  struct Shape {
    Vec3 normal;
    bool thin = false;
  };
  Shape shape(const Triangle& t) const {
    const std::array<Vec3, 3> p = {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
    const FaceNormal normal = face_normal(p);
    return {normal.twice_area, plane_uncertainty(p, normal, error_).thin};
  }
  bool is_thin_face(const Triangle& t) const { return shape(t).thin; }
  double length(std::uint32_t a, std::uint32_t b) const {
    return norm(vertices_[a] - vertices_[b]);
  }

  bool is_gone(std::uint32_t t) const { return gone_ != nullptr && (*gone_)[t] != 0; }

  static std::uint64_t name(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }
  void find_edges() {
    edges_.reserve(triangles_.size() / 2 * 3);
    CancelPoll poll;
    for (const Triangle& t : triangles_) {
      poll();
      for (std::size_t k = 0; k < 3; ++k) edges_.insert(name(t[k], t[(k + 1) % 3]));
    }
  }

  std::uint32_t longest_edge(std::uint32_t t) const {
    const auto length_of = [&](std::uint32_t h) {
      return length(start_of(triangles_, h), end_of(triangles_, h));
    };
    std::uint32_t longest = 3 * t;
    for (std::uint32_t h = 3 * t + 1; h < 3 * t + 3; ++h) {
      if (length_of(h) > length_of(longest)) longest = h;
    }
    return longest;
  }

  void try_swap(std::uint32_t t) {
    const std::uint32_t h = longest_edge(t), mate = mates_[h];
    if (mate == kNoMate) {
      if (gone_ != nullptr) drop(t);
      return;
    }
    const std::uint32_t u = mate / 3;
    const std::uint32_t a = start_of(triangles_, h), b = end_of(triangles_, h);
    const std::uint32_t c = start_of(triangles_, previous_corner(h));
    const std::uint32_t d = start_of(triangles_, previous_corner(mate));
    if (start_of(triangles_, mate) != b || c == d || edges_.contains(name(c, d))) return;
    const Triangle first = {c, a, d}, second = {d, b, c};
    if (!gains(triangles_[u], first, second, length(a, b))) return;
    const std::uint32_t ca = mates_[previous_corner(h)], bc = mates_[next_corner(h)];
    const std::uint32_t ad = mates_[next_corner(mate)], db = mates_[previous_corner(mate)];
    edges_.erase(name(a, b));
    edges_.insert(name(c, d));
    triangles_[t] = first, triangles_[u] = second;
    join(3 * t, ca), join(3 * t + 1, ad), join(3 * t + 2, 3 * u + 2);
    join(3 * u, db), join(3 * u + 1, bc);
    await(t), await(u);
    for (const std::uint32_t beyond : {ca, ad, db, bc}) {
      if (beyond != kNoMate) await(beyond / 3);
    }
  }

  void drop(std::uint32_t t) {
    (*gone_)[t] = 1;
    ++removed_;
    for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
      const std::uint32_t mate = mates_[side];
      if (mate == kNoMate) continue;
      mates_[mate] = mates_[side] = kNoMate;
      await(mate / 3);
    }
  }

  // Returns true if fewer faces are thin after a swap, or both with shorter edges, and none folds.
  bool gains(const Triangle& mate, const Triangle& first, const Triangle& second, double longest) {
    const Shape before = shape(mate), one = shape(first), two = shape(second);
    const auto folded = [&](const Shape& after) {
      return !after.thin && !before.thin && dot(after.normal, before.normal) <= 0;
    };
    if (folded(one) || folded(two)) return false;
    const int thin = int{one.thin} + int{two.thin}, thin_before = 1 + int{before.thin};
    if (thin > thin_before) return false;
    if (thin == thin_before) {
      const auto shorter = [&](const Triangle& t) {
        return std::max({length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])}) < longest;
      };
      return thin == 2 && shorter(first) && shorter(second);
    }
    removed_ += static_cast<std::size_t>(thin_before - thin);
    return true;
  }

  void join(std::uint32_t one, std::uint32_t other) {
    mates_[one] = other;
    if (other != kNoMate) mates_[other] = one;
  }
  void await(std::uint32_t t) {
    if (!is_gone(t) && is_thin_face(triangles_[t])) waiting_.push_back(t);
  }

  const std::vector<Vec3>& vertices_;
  Vec3 error_;
  std::vector<Triangle>& triangles_;
  std::vector<std::uint32_t>& mates_;
  std::vector<char>* gone_;
  std::deque<std::uint32_t> waiting_;
  std::unordered_set<std::uint64_t> edges_;
  std::size_t removed_ = 0;
};

}  // namespace

std::size_t swap_thin_faces(const std::vector<Vec3>& vertices, const Vec3& error,
                            std::vector<Triangle>& triangles, std::vector<std::uint32_t>& mates,
                            std::vector<char>* gone) {
  return ThinFaceSwaps(vertices, error, triangles, mates, gone).run();
}

std::size_t swap_thin_faces(Mesh& mesh) {
  const double scale = unit_frame(bounds(mesh.vertices)).scale;
  const Vec3 error = scale * coordinate_error(view_of(mesh));
  const bool found = std::ranges::any_of(mesh.faces, [&](const Triangle& t) {
    return is_thin(scaled_corners(mesh, t, scale), error);
  });
  if (!found) return 0;
  std::vector<Vec3> scaled = mesh.vertices;
  for (Vec3& v : scaled) v *= scale;
  std::vector<std::uint32_t> mates = find_mates(mesh.vertices.size(), mesh.faces);
  return swap_thin_faces(scaled, error, mesh.faces, mates);
}

}  // namespace rholm
