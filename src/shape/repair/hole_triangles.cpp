#include "shape/repair/hole_triangles.h"

#include <algorithm>
#include <array>
#include <limits>

#include "shape/face.h"

namespace rholm {
namespace {

// Of a part of the polygon: 1 - cosine of the largest angle between neighbours, then the area.
struct Weight {
  double bend = std::numeric_limits<double>::infinity();
  double area = 0;
  friend bool operator<(const Weight& a, const Weight& b) {
    return a.bend != b.bend ? a.bend < b.bend : a.area < b.area;
  }
};

// The best triangulation of the part i, i + 1, ... j of the polygon, closed by the diagonal j -> i.
struct Part {
  Weight weight;
  std::uint32_t apex = 0;  // of the triangle at the diagonal: i, apex, j
  Vec3 normal;             // its unit normal; of an edge of the rim that of the triangle beyond
};

// Angles closer than this are equal: flat rims are to be decided by area, not by rounding.
constexpr double kSameBend = 1e-9;

// Worse than any bend, which is 2 at most: along a straight side of the rim there are others.
constexpr double kWithoutArea = 3;

double bend_between(const Vec3& a, const Vec3& b) {
  const double bend = 1 - dot(a, b);
  return bend < kSameBend ? 0 : bend;
}

class Triangulator {
 public:
  Triangulator(std::span<const Vec3> rim, std::span<const Vec3> beyond)
      : rim_(rim), n_(rim.size()) {
    parts_.resize(n_ * n_);
    for (std::size_t i = 0; i + 1 < n_; ++i) at(i, i + 1) = {{0, 0}, 0, beyond[i]};
    last_ = beyond[n_ - 1];
  }

  void run(const std::function<bool(std::uint32_t, std::uint32_t)>& taken) {
    for (std::size_t length = 2; length < n_; ++length) {
      for (std::size_t i = 0; i + length < n_; ++i) {
        const std::size_t j = i + length;
        const bool diagonal = length + 1 < n_;
        if (diagonal && taken(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j))) {
          continue;
        }
        for (std::size_t m = i + 1; m < j; ++m) try_apex(i, m, j);
      }
    }
  }

  std::optional<HoleTriangles> result() const {
    if (!(part(0, n_ - 1).weight.bend < std::numeric_limits<double>::infinity())) {
      return std::nullopt;
    }
    HoleTriangles hole{.triangles = {}, .area = part(0, n_ - 1).weight.area};
    std::vector<std::array<std::size_t, 2>> open = {{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j == i + 1) continue;
      const std::size_t m = part(i, j).apex;
      hole.triangles.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(m),
                                static_cast<std::uint32_t>(j)});
      open.push_back({i, m});
      open.push_back({m, j});
    }
    return hole;
  }

 private:
  Part& at(std::size_t i, std::size_t j) { return parts_[i * n_ + j]; }
  const Part& part(std::size_t i, std::size_t j) const { return parts_[i * n_ + j]; }

  void try_apex(std::size_t i, std::size_t m, std::size_t j) {
    const Part &left = part(i, m), &right = part(m, j);
    Weight weight{std::max(left.weight.bend, right.weight.bend),
                  left.weight.area + right.weight.area};
    if (at(i, j).weight < weight) return;
    const FaceNormal face = face_normal({rim_[i], rim_[m], rim_[j]});
    const Vec3 normal = normalized(face.twice_area);
    weight.area += norm(face.twice_area) / 2;
    // Not less than that of its parts: one that cannot be closed stays so.
    if (face.degenerate) weight.bend = std::max(weight.bend, kWithoutArea);
    weight.bend = std::max(
        {weight.bend, bend_between(normal, left.normal), bend_between(normal, right.normal)});
    // The whole polygon is closed by an edge of the rim.
    if (i == 0 && j == n_ - 1) weight.bend = std::max(weight.bend, bend_between(normal, last_));
    if (weight < at(i, j).weight) {
      at(i, j) = {weight, static_cast<std::uint32_t>(m), normal};
    }
  }

  std::span<const Vec3> rim_;
  std::size_t n_;
  std::vector<Part> parts_;
  Vec3 last_;
};

}  // namespace

std::optional<HoleTriangles> triangulate_hole(
    std::span<const Vec3> rim, std::span<const Vec3> beyond,
    const std::function<bool(std::uint32_t, std::uint32_t)>& taken) {
  if (rim.size() < 3) return std::nullopt;
  Triangulator triangulator(rim, beyond);
  triangulator.run(taken);
  return triangulator.result();
}

}  // namespace rholm
