#include "shape/repair/hole_closing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "shape/face.h"
#include "shape/topology/vertex_stars.h"

namespace rholm {
namespace {

// Cost of a part of the polygon: 1 - cosine of the largest angle between neighbours, then area.
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
  std::uint32_t apex = 0;  // apex of the triangle (i, apex, j) at the diagonal
  Vec3 normal;             // its unit normal; for an edge of the rim, of the triangle beyond
};

// Angles closer than this are equal, so that area, not rounding, decides on flat rims.
constexpr double kSameBend = 1e-9;

// Cost above any bend, which is at most 2: a straight side of the rim has other triangulations.
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
    HoleTriangles hole{.faces = {}, .area = part(0, n_ - 1).weight.area};
    std::vector<std::array<std::size_t, 2>> open = {{0, n_ - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j == i + 1) continue;
      const std::size_t m = part(i, j).apex;
      hole.faces.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(m),
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
    // The weight is at least the weight of each part, so a part that cannot be closed stays so.
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

namespace {

// Largest area of a cover, relative to its part: a larger cover does not close a hole but doubles a
// sheet. The ratio is a half for a hemisphere and 1 for a flat sheet.
constexpr double kLargestCover = 0.75;

Vec3 unit_normal_of(const Mesh& mesh, std::uint32_t t) {
  const Triangle& c = mesh.faces[t];
  const Vec3& a = mesh.vertices[c[0]];
  return normalized(cross(mesh.vertices[c[1]] - a, mesh.vertices[c[2]] - a));
}

double area_of(const std::vector<Vec3>& at, const Triangle& t) {
  return norm(cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]])) / 2;
}

// Half-edges of a border, each beginning where the last one ends.
using Border = std::vector<std::uint32_t>;

std::vector<Border> find_borders(const Mesh& mesh, const Parts& parts,
                                 const std::vector<char>& one_sided,
                                 const std::vector<std::uint32_t>& mates) {
  std::vector<std::uint32_t> from(mesh.vertices.size(), kNoMate);  // half-edge leaving a vertex
  const auto is_border = [&](std::uint32_t h) {
    return mates[h] == kNoMate && !one_sided[parts.part[h / 3]];
  };
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (is_border(h)) from[start_of(mesh.faces, h)] = h;
  }
  std::vector<Border> borders;
  std::vector<char> seen(mates.size(), 0);
  for (std::uint32_t h = 0; h < mates.size(); ++h) {
    if (!is_border(h) || seen[h]) continue;
    Border border;
    std::uint32_t at = h;
    while (at != kNoMate && !seen[at]) {
      seen[at] = 1;
      border.push_back(at);
      at = from[end_of(mesh.faces, at)];
    }
    if (at == h) borders.push_back(std::move(border));
  }
  return borders;
}

// The border of a hole, in the direction of the triangles that close it.
struct Rim {
  std::vector<std::uint32_t> vertices;
  std::vector<Vec3> at;
  std::vector<Vec3> beyond;  // normals beyond the edge from each vertex to the next
};

Rim rim_of(const Mesh& mesh, const Border& border) {
  Rim rim;
  const std::size_t n = border.size();
  for (std::size_t i = 0; i < n; ++i) {
    rim.vertices.push_back(start_of(mesh.faces, border[n - 1 - i]));
    rim.at.push_back(mesh.vertices[rim.vertices.back()]);
    rim.beyond.push_back(unit_normal_of(mesh, border[(2 * n - 2 - i) % n] / 3));
  }
  return rim;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

// Returns existing edges between vertices of the rim, sorted.
std::vector<Pair> edges_within(const Mesh& mesh, const VertexStars& stars, const Rim& rim) {
  std::vector<Pair> place;  // vertex, its index in the rim
  place.reserve(rim.vertices.size());
  for (std::uint32_t i = 0; i < rim.vertices.size(); ++i) place.emplace_back(rim.vertices[i], i);
  std::sort(place.begin(), place.end());
  std::vector<Pair> edges;
  for (std::uint32_t i = 0; i < rim.vertices.size(); ++i) {
    for (const std::uint32_t t : stars.of(rim.vertices[i])) {
      for (const std::uint32_t v : mesh.faces[t]) {
        const auto found = std::lower_bound(place.begin(), place.end(), Pair{v, 0});
        if (found != place.end() && found->first == v && i < found->second) {
          edges.emplace_back(i, found->second);
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Makes a fan around a new vertex with the means of the rim's attributes; integers are rounded.
HoleTriangles fan(const Rim& rim, Mesh& mesh) {
  const auto n = static_cast<std::uint32_t>(rim.vertices.size());
  Vec3 middle;
  for (const Vec3& p : rim.at) middle += p / n;
  HoleTriangles hole;
  std::vector<Vec3> at = rim.at;
  at.push_back(middle);
  for (std::uint32_t i = 0; i < n; ++i) {
    hole.faces.push_back({i, (i + 1) % n, n});
    hole.area += area_of(at, hole.faces.back());
  }
  mesh.vertices.push_back(middle);
  for (Attribute& attribute : mesh.attributes) {
    double mean = 0;
    for (const std::uint32_t v : rim.vertices) mean += attribute.values[v] / n;
    const bool real =
        attribute.type == ScalarType::kFloat32 || attribute.type == ScalarType::kFloat64;
    attribute.values.push_back(real ? mean : std::round(mean));
  }
  return hole;
}

void drop_last_vertex(Mesh& mesh) {
  mesh.vertices.pop_back();
  for (Attribute& attribute : mesh.attributes) attribute.values.pop_back();
}

// Closes holes one after the other.
class Closer {
 public:
  Closer(const Parts& parts, Mesh& mesh, RepairReport& report)
      : mesh_(mesh),
        report_(report),
        stars_(make_vertex_stars(mesh.vertices.size(), mesh.faces)),
        areas_(parts.n, 0.0) {
    for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
      areas_[parts.part[t]] += area_of(mesh.vertices, mesh.faces[t]);
    }
  }

  void close(const Border& border, std::uint32_t part) {
    Rim rim = rim_of(mesh_, border);
    const std::vector<Pair> edges = edges_within(mesh_, stars_, rim);
    const auto taken = [&](std::uint32_t i, std::uint32_t j) {
      return std::binary_search(edges.begin(), edges.end(), Pair{i, j}) ||
             new_edges_.contains(std::minmax(rim.vertices[i], rim.vertices[j]));
    };
    std::optional<HoleTriangles> hole = triangulate_hole(rim.at, rim.beyond, taken);
    const bool around = !hole;
    if (around) hole = fan(rim, mesh_);
    if (hole->area > kLargestCover * areas_[part]) {
      if (around) drop_last_vertex(mesh_);
      ++report_.sheets;
      return;
    }
    if (around) rim.vertices.push_back(static_cast<std::uint32_t>(mesh_.vertices.size() - 1));
    for (const Triangle& t : hole->faces) {
      const Triangle corners = {rim.vertices[t[0]], rim.vertices[t[1]], rim.vertices[t[2]]};
      for (int k = 0; k < 3; ++k) {
        new_edges_.insert(std::minmax(corners[k], corners[(k + 1) % 3]));
      }
      mesh_.faces.push_back(corners);
    }
    ++report_.closed_holes;
    report_.hole_faces += hole->faces.size();
  }

 private:
  Mesh& mesh_;
  RepairReport& report_;
  VertexStars stars_;
  std::vector<double> areas_;  // per part
  std::set<Pair> new_edges_;
};

}  // namespace

void close_holes(const Parts& parts, const std::vector<char>& one_sided,
                 const std::vector<std::uint32_t>& mates, std::size_t max_hole, Mesh& mesh,
                 RepairReport& report) {
  const std::vector<Border> borders = find_borders(mesh, parts, one_sided, mates);
  if (borders.empty()) return;
  Closer closer(parts, mesh, report);
  for (const Border& border : borders) {
    if (border.size() > max_hole) {
      ++report.large_holes;
      report.largest_hole = std::max(report.largest_hole, border.size());
    } else {
      closer.close(border, parts.part[border[0] / 3]);
    }
  }
}

}  // namespace rholm
