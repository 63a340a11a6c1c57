// Bodies as CAD programs export them: convex or star-shaped solids with triangles without width at
// vertices on edges. The bodies are turned, shifted, and rounded to single precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "rholm/mesh.h"
#include "support/random_data.h"

namespace rholm::test {

// A solid given by faces, counter-clockwise from outside; every edge belongs to two faces.
struct FacedSolid {
  std::vector<Vec3> vertices;
  std::vector<std::vector<std::uint32_t>> faces;
};

inline FacedSolid cuboid(const Vec3& half) {
  FacedSolid solid;
  for (int i = 0; i < 8; ++i) {
    solid.vertices.push_back({(i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                              (i & 4) != 0 ? half.z : -half.z});
  }
  solid.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return solid;
}

// Returns the part of a convex solid with normal . x <= offset.
inline FacedSolid cut_by(const FacedSolid& solid, const Vec3& normal, double offset) {
  const auto height = [&](std::uint32_t v) {
    const double h = dot(normal, solid.vertices[v]) - offset;
    return std::abs(h) < 1e-9 ? 0 : h;
  };
  FacedSolid result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> named;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    const auto name = std::minmax(a, b);
    const auto [at, is_new] =
        named.try_emplace(name, static_cast<std::uint32_t>(result.vertices.size()));
    if (is_new) {
      const double ha = height(name.first), hb = height(name.second);
      const Vec3 &p = solid.vertices[name.first], &q = solid.vertices[name.second];
      result.vertices.push_back(a == b ? p : p + (ha / (ha - hb)) * (q - p));
    }
    return at->second;
  };
  std::map<std::uint32_t, std::uint32_t> cap;  // from one vertex of the cut to the next vertex
  for (const std::vector<std::uint32_t>& face : solid.faces) {
    std::vector<std::uint32_t> kept;
    std::uint32_t enters = 0, leaves = 0;
    bool crosses = false;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
      if (height(a) <= 0) kept.push_back(add(a, a));
      if ((height(a) <= 0) == (height(b) <= 0)) continue;
      const std::uint32_t at = height(a) == 0 ? add(a, a) : height(b) == 0 ? add(b, b) : add(a, b);
      if (height(a) != 0 && height(b) != 0) kept.push_back(at);
      (height(a) <= 0 ? leaves : enters) = at;
      crosses = true;
    }
    if (kept.size() >= 3) result.faces.push_back(kept);
    if (crosses && enters != leaves) cap[enters] = leaves;
  }
  if (cap.empty()) return result;
  std::vector<std::uint32_t> lid;
  for (std::uint32_t v = cap.begin()->first; lid.size() < cap.size(); v = cap[v]) lid.push_back(v);
  result.faces.push_back(lid);
  return result;
}

// Returns a prism over a polygon that is star-shaped about the origin; caps are fans about middles.
inline FacedSolid star_prism(const std::vector<Vec3>& polygon, double half_height) {
  FacedSolid solid;
  const auto n = static_cast<std::uint32_t>(polygon.size());
  for (const double z : {-half_height, half_height}) {
    for (const Vec3& p : polygon) solid.vertices.push_back({p.x, p.y, z});
  }
  solid.vertices.push_back({0, 0, -half_height});
  solid.vertices.push_back({0, 0, half_height});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    solid.faces.push_back({i, j, n + j, n + i});
    solid.faces.push_back({2 * n, j, i});
    solid.faces.push_back({2 * n + 1, n + i, n + j});
  }
  return solid;
}

// Splits each face into a fan of triangles about its first vertex.
inline Mesh triangulated(const FacedSolid& solid) {
  Mesh mesh{.vertices = solid.vertices, .faces = {}, .attributes = {}};
  for (const std::vector<std::uint32_t>& face : solid.faces) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      mesh.faces.push_back({face[0], face[i - 1], face[i]});
    }
  }
  return mesh;
}

// Configurations that are rare in files, and harder.
enum class CadRarity {
  kNone,
  kSliversMeet,  // slivers of both faces meet at an edge
  kJunctions,    // T-junctions at bodies of every kind
};

// Puts vertices on some edges, in both faces of an edge, or in one face for T-junctions. Unless
// slivers may meet, the fan of a face begins at a vertex on whose edges no other face has slivers.
// If every vertex has slivers, the fan begins at a new vertex in the middle of the face.
inline FacedSolid with_split_edges(const FacedSolid& given, double share, bool junctions,
                                   bool slivers_meet, std::uint64_t seed) {
  std::uint64_t counter = 0;
  const auto random = [&] { return random_uniform(seed, counter++); };
  struct SplitEdge {
    std::vector<std::uint32_t> inner;  // in the order of the first face of the edge
    bool has_slivers = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, SplitEdge> edges;
  FacedSolid solid{.vertices = given.vertices, .faces = {}};
  for (const std::vector<std::uint32_t>& face : given.faces) {
    std::vector<std::uint32_t> loop;
    std::vector<SplitEdge*> after;  // the edge from each vertex of the loop to the next
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
      const auto [at, is_new] = edges.try_emplace(std::minmax(a, b));
      SplitEdge& edge = at->second;
      loop.push_back(a);
      if (is_new && random() < share) {
        const int n = 1 + static_cast<int>(3 * random());
        for (int k = 1; k <= n; ++k) {
          const double t = (k - 0.4 * random()) / (n + 1);
          edge.inner.push_back(static_cast<std::uint32_t>(solid.vertices.size()));
          solid.vertices.push_back((1 - t) * solid.vertices[a] + t * solid.vertices[b]);
        }
        loop.insert(loop.end(), edge.inner.begin(), edge.inner.end());
      } else if (!is_new && !junctions) {
        loop.insert(loop.end(), edge.inner.rbegin(), edge.inner.rend());
      }
      after.resize(loop.size(), &edge);
    }
    const std::size_t n = loop.size();
    auto first = static_cast<std::size_t>(random() * static_cast<double>(n));
    const auto is_free = [&](const SplitEdge* edge) {
      return slivers_meet || edge->inner.empty() || !edge->has_slivers;
    };
    std::size_t tries = 0;
    while (tries < n && !(is_free(after[first]) && is_free(after[(first + n - 1) % n]))) {
      first = (first + 1) % n;
      ++tries;
    }
    if (tries < n) {
      after[first]->has_slivers = after[(first + n - 1) % n]->has_slivers = true;
      std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first), loop.end());
      solid.faces.push_back(loop);
      continue;
    }
    Vec3 middle;
    for (const std::uint32_t v : face)
      middle += given.vertices[v] / static_cast<double>(face.size());
    const auto apex = static_cast<std::uint32_t>(solid.vertices.size());
    solid.vertices.push_back(middle);
    for (std::size_t i = 0; i < n; ++i) solid.faces.push_back({apex, loop[i], loop[(i + 1) % n]});
  }
  return solid;
}

// `volatile` is needed: GCC 12 omits the conversion in the last rounds of a vectorised loop.
inline double to_single(double x) {
  const volatile float single = static_cast<float>(x);
  return single;
}

struct CadBody {
  std::string name;
  Mesh exact;    // double precision, without vertices on edges
  Mesh written;  // single precision, with them: closed but for T-junctions
  bool junctions = false;
};

// Returns body i of 300.
inline CadBody cad_body(int i, CadRarity rarity = CadRarity::kNone) {
  const auto seed = 1000 + static_cast<std::uint64_t>(i);
  std::uint64_t counter = 0;
  const auto random = [&](double low, double high) {
    return random_in(low, high, seed, counter++);
  };
  CadBody body;
  FacedSolid solid;
  const auto round_sides = [&](double radius, int n) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.3) / n;
      solid = cut_by(solid, {std::cos(angle), std::sin(angle), 0}, radius);
    }
  };
  const int kind = i % 7;
  const double half_height = random(0.3, 4);
  if (kind == 0) {
    body.name = "cylinder";
    solid = cuboid({1.5, 1.5, half_height});
    round_sides(1.0, static_cast<int>(random(5, 40)));
  } else if (kind == 1) {
    body.name = "cylinder with chamfers";
    solid = cuboid({1.5, 1.5, half_height});
    const int n = static_cast<int>(random(5, 24));
    round_sides(1.0, n);
    const double width = random(0.01, 0.25);
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.3) / n, slope = std::sqrt(0.5);
      solid = cut_by(solid, {slope * std::cos(angle), slope * std::sin(angle), slope},
                     slope * (1 + half_height - width));
    }
  } else if (kind == 2) {
    body.name = "box with fillets";
    solid = cuboid({1, random(0.5, 2), half_height});
    const double y = solid.vertices[7].y, radius = random(0.05, 0.3);
    const int n = static_cast<int>(random(2, 8));
    for (const double side : {-1.0, 1.0}) {
      for (int k = 1; k <= n; ++k) {
        const double angle = std::numbers::pi / 2 * k / (n + 1);
        const Vec3 normal{std::cos(angle), side * std::sin(angle), 0};
        solid = cut_by(solid, normal, dot(normal, {1 - radius, side * (y - radius), 0}) + radius);
      }
    }
  } else if (kind == 3) {
    body.name = "box with chamfers and T-junctions";
    body.junctions = true;
    solid = cuboid({1, random(0.5, 2), half_height});
    const double y = solid.vertices[7].y, slope = std::sqrt(0.5);
    solid = cut_by(solid, {slope, slope, 0}, slope * (1 + y - random(0.02, 0.3)));
    solid = cut_by(solid, {slope, 0, slope}, slope * (1 + half_height - random(0.02, 0.3)));
  } else if (kind == 4) {
    body.name = "intersection of convex bodies";
    solid = cuboid({2, 2, 2});
    const int n = static_cast<int>(random(6, 40));
    for (int k = 0; k < n; ++k) {
      solid = cut_by(solid, random_direction(seed, 500 + static_cast<std::uint64_t>(k)),
                     random(0.7, 1.3));
    }
  } else if (kind == 5) {
    body.name = "union of two bars";
    const double a = random(0.2, 0.8), b = random(0.2, 0.8);
    solid = star_prism({{2, -b, 0},
                        {2, b, 0},
                        {a, b, 0},
                        {a, 2, 0},
                        {-a, 2, 0},
                        {-a, b, 0},
                        {-2, b, 0},
                        {-2, -b, 0},
                        {-a, -b, 0},
                        {-a, -2, 0},
                        {a, -2, 0},
                        {a, -b, 0}},
                       half_height);
  } else {
    body.name = "fans of a gear";
    const int teeth = static_cast<int>(random(4, 16));
    const double depth = random(0.05, 0.3);
    std::vector<Vec3> polygon;
    for (int k = 0; k < 4 * teeth; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.1) / (4 * teeth);
      const double radius = k % 4 < 2 ? 1 : 1 - depth;
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    solid = star_prism(polygon, half_height);
  }
  body.junctions |= rarity == CadRarity::kJunctions;
  const FacedSolid split = with_split_edges(solid, random(0.1, 0.6), body.junctions,
                                            rarity == CadRarity::kSliversMeet, seed);
  body.exact = triangulated(solid);
  body.written = triangulated(split);
  // The body is turned at random and shifted by up to ten sizes; the unit is the millimetre.
  const Vec3 x = random_direction(seed, 900);
  const Vec3 y = normalized(cross(x, random_direction(seed, 901))), z = cross(x, y);
  const double scale = std::exp(random(-4, 6));
  const Vec3 shift = random(0, 10) * random_direction(seed, 902);
  const auto place = [&](const Vec3& v) { return scale * (v.x * x + v.y * y + v.z * z + shift); };
  for (Vec3& v : body.exact.vertices) v = place(v);
  for (Vec3& v : body.written.vertices) {
    const Vec3 there = place(v);
    v = {to_single(there.x), to_single(there.y), to_single(there.z)};
  }
  return body;
}

}  // namespace rholm::test
