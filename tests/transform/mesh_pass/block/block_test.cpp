// The inner loops of the mesh pass, compared with their definitions: docs/method.md (M8).
#include "transform/mesh_pass/block/block.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/targets.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"
#include "transform/mesh_pass/own_nodes.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kQuantum = 0x1p-44;

// All triangles that can be lumped are lumped, in quanta of 2^-44.
BlockParameters parameters_about(const Vec3& center) {
  BlockParameters parameters;
  parameters.center = center;
  parameters.degree = 16;
  parameters.tolerance2 = parameters.mean_reach2 = parameters.largest = kInfinity;
  parameters.per_weight = parameters.per_gradient = 1 / kQuantum;
  return parameters;
}

// Uses rules with Hessians: this rule for all faces, and for all edges this or the last rule of
// edges.
void with_rule(BlockParameters& parameters, std::size_t rule) {
  parameters.hessians = true;
  parameters.per_hessian = parameters.per_weight;
  for (std::size_t k = 0; k < parameters.edge_reach2.size(); ++k) {
    parameters.edge_reach2[k] = k < rule ? 0 : kInfinity;
  }
  for (std::size_t k = 0; k < parameters.face_reach2.size(); ++k) {
    parameters.face_reach2[k] = k < rule ? 0 : kInfinity;
  }
}
std::size_t edge_rule_of(std::size_t rule) { return std::min(rule, kHermiteEdgeRules - 1); }

template <typename T>
struct Worked {
  std::vector<std::unique_ptr<TriangleBlock<T>>> blocks;
  BlockSums sums = no_triangles();
};
template <typename T>
Worked<T> work(const MeshView& mesh, BlockParameters parameters,
               std::size_t per_block = kTrianglesPerBlock) {
  Worked<T> worked;
  parameters.largest_index = static_cast<std::uint32_t>(mesh.n_vertices - 1);
  for (std::size_t first = 0; first < mesh.n_faces; first += per_block) {
    const std::size_t n = std::min(per_block, mesh.n_faces - first);
    worked.blocks.push_back(std::make_unique<TriangleBlock<T>>());
    work_block(mesh, first, n, parameters, *worked.blocks.back(), worked.sums);
  }
  return worked;
}
BlockSums sums_of(const Mesh& mesh, const Vec3& center = {}) {
  return work<double>(view_of(mesh), parameters_about(center)).sums;
}

// Returns triangles of many sizes and slopes, none of them seen edge-on.
Mesh random_triangles(std::size_t n, std::uint64_t seed) {
  Mesh mesh;
  for (std::uint64_t k = 0; mesh.faces.size() < n; ++k) {
    const Vec3 middle =
        test::random_in(0.5, 1.5, seed, 5 * k) * test::random_direction(seed, 7 * k);
    const double size = std::pow(10.0, test::random_in(-3, 0, seed, 5 * k + 1));
    std::array<Vec3, 3> p;
    for (std::uint64_t i = 0; i < 3; ++i) {
      p[i] = middle + size * test::random_direction(seed + 1, 3 * k + i);
    }
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (std::abs(dot(normal, p[0])) < 0.05 * norm(normal) * norm(p[0])) continue;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Evaluates (M8) in extended precision, from the given doubles.
struct Exact {
  using Real = long double;
  using Vec = std::array<Real, 3>;
  std::array<Vec, 3> p;
  std::array<Real, 3> w;  // weights of p_i -> p_{i+1}
  Real face = 0;
  Real rounding = 0;  // rounding error of the weights in double precision

  static Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Real inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Vec outer(const Vec& a, const Vec& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  Exact(const Mesh& mesh, std::size_t t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& v = mesh.vertices[mesh.faces[t][i]];
      p[i] = {v.x, v.y, v.z};
    }
    const Vec n = outer(minus(p[1], p[0]), minus(p[2], p[0]));
    const Real d2 = inner(n, p[0]);
    Real reach = 0, edge = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec &a = p[i], &b = p[(i + 1) % 3];
      w[i] = inner(n, outer(a, minus(b, a))) / d2;
      reach = std::max(reach, std::sqrt(inner(a, a)));
      edge = std::max(edge, std::sqrt(inner(minus(b, a), minus(b, a))));
    }
    face = -inner(n, n) / d2;
    // n is known to some eps |e|^2, and p x e to eps r |e|: W = n . (p x e) / d2. The error of n
    // also affects d2.
    const Real length = std::sqrt(inner(n, n)), slope = reach * edge / std::abs(d2);
    rounding = 0x1p-50L * slope * (length + edge * edge) * (1 + reach * edge * edge / std::abs(d2));
  }
  Vec edge(std::size_t i) const { return minus(p[(i + 1) % 3], p[i]); }
};

// Sums are whole quanta: in a lattice all triangles are rounded alike, so that errors would add up.
TEST(block, lumps_of_a_triangle_add_up_to_nothing) {
  const Mesh mesh = random_triangles(300, 2);
  BlockParameters parameters = parameters_about({});
  parameters.per_weight = parameters.per_gradient = 1 << 20;
  parameters.largest = 1 << 28;
  const auto worked = work<std::int32_t>(view_of(mesh), parameters);
  EXPECT_LT(worked.sums.nodes, mesh.faces.size() / 2);
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const auto& block = *worked.blocks[t / kTrianglesPerBlock];
    const std::size_t at = t % kTrianglesPerBlock;
    if (block.flag[at] != kLumped) continue;
    for (int k = 0; k < 4; ++k) {
      std::int64_t sum = 0;
      for (int i = 0; i < 3; ++i) sum += block.lump[i][lump_slot<std::int32_t>(at)].value[k];
      EXPECT_EQ(sum, 0) << t << " " << k;
    }
  }
}

TEST(block, lumps_are_what_the_rule_makes_of_the_definition) {
  const Mesh mesh = random_triangles(1000, 1);
  const auto worked = work<double>(view_of(mesh), parameters_about({}));
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const Exact exact(mesh, t);
    const auto& block = *worked.blocks[t / kTrianglesPerBlock];
    const std::size_t at = t % kTrianglesPerBlock;
    EXPECT_EQ(block.flag[at], kLumped);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t before = (i + 2) % 3;
      const long double out = exact.w[i], in = exact.w[before], f = exact.face;
      const double* lump = block.lump[i][at].value;
      // The third corner gets the remainder of the two others.
      const long double tolerance = (i == 2 ? kQuantum : kQuantum / 2) + exact.rounding;
      EXPECT_NEAR(lump[0] * kQuantum, static_cast<double>((out + in) / 2 + f / 3),
                  static_cast<double>(tolerance));
      for (std::size_t k = 0; k < 3; ++k) {
        const long double gradient =
            (out / 12 + f / 24) * exact.edge(i)[k] - (in / 12 + f / 24) * exact.edge(before)[k];
        EXPECT_NEAR(lump[k + 1] * kQuantum, static_cast<double>(gradient),
                    static_cast<double>(tolerance));
      }
    }
  }
}

TEST(block, weights_of_a_triangle_sum_to_zero) {
  const Mesh mesh = random_triangles(300, 2);
  const auto worked = work<double>(view_of(mesh), parameters_about({}));
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const auto& block = *worked.blocks[t / kTrianglesPerBlock];
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += block.lump[i][t % kTrianglesPerBlock].value[0];
    EXPECT_LT(std::abs(sum * kQuantum), 1.5 * kQuantum + 3 * Exact(mesh, t).rounding);
  }
}

// Means of quadratic polynomials: Simpson's rule on edges, mid-edge values on faces, both exact.
TEST(block, lumps_are_exact_for_quadratic_functions) {
  const Mesh mesh = random_triangles(200, 3);
  const auto worked = work<double>(view_of(mesh), parameters_about({}));
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    const Exact exact(mesh, t);
    std::array<double, 10> q;
    for (std::size_t i = 0; i < 10; ++i) q[i] = test::random_in(-1, 1, 4, 10 * t + i);
    const auto value = [&](const Vec3& x) {
      return q[0] + q[1] * x.x + q[2] * x.y + q[3] * x.z + q[4] * x.x * x.x + q[5] * x.y * x.y +
             q[6] * x.z * x.z + q[7] * x.x * x.y + q[8] * x.y * x.z + q[9] * x.z * x.x;
    };
    const auto gradient = [&](const Vec3& x) {
      return Vec3{q[1] + 2 * q[4] * x.x + q[7] * x.y + q[9] * x.z,
                  q[2] + 2 * q[5] * x.y + q[7] * x.x + q[8] * x.z,
                  q[3] + 2 * q[6] * x.z + q[8] * x.y + q[9] * x.x};
    };
    double lumped = 0, expected = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[mesh.faces[t][i]];
      const Vec3& b = mesh.vertices[mesh.faces[t][(i + 1) % 3]];
      const double middle = value(0.5 * (a + b));
      expected += static_cast<double>(exact.w[i]) * (value(a) + 4 * middle + value(b)) / 6 +
                  static_cast<double>(exact.face) * middle / 3;
      const double* lump =
          worked.blocks[t / kTrianglesPerBlock]->lump[i][t % kTrianglesPerBlock].value;
      lumped += kQuantum * (lump[0] * value(a) + dot({lump[1], lump[2], lump[3]}, gradient(a)));
    }
    EXPECT_NEAR(lumped, expected, 60 * kQuantum + 60 * static_cast<double>(exact.rounding));
  }
}

// Sums include the nodes between corners, which are whole quanta as well.
TEST(block, lumps_and_nodes_of_a_triangle_add_up_to_nothing) {
  const Mesh mesh = random_triangles(300, 2);
  for (std::size_t rule = 0; rule < kHermiteFaceRules; ++rule) {
    BlockParameters parameters = parameters_about({});
    parameters.per_weight = parameters.per_gradient = 1 << 20;
    parameters.largest = 1 << 28;
    with_rule(parameters, rule);
    const auto worked = work<std::int32_t>(view_of(mesh), parameters);
    for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
      const auto& block = *worked.blocks[t / kTrianglesPerBlock];
      const std::size_t at = t % kTrianglesPerBlock;
      if (block.flag[at] != kLumped) continue;
      double sums[4] = {};
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
          sums[k] += block.lump[i][lump_slot<std::int32_t>(at)].value[k];
        }
        EXPECT_EQ(block.edge_rule[i][at], edge_rule_of(rule));
        if (rule > 0) {
          sums[0] += kHermiteEdges[edge_rule_of(rule)].nodes * block.edge_node[i][at] *
                     parameters.per_weight;
        }
      }
      EXPECT_EQ(block.face_rule[at], rule);
      if (rule > 0) {
        const auto& orbits = kHermiteFaces[rule].orbits;
        sums[0] += (block.center_node[at] + orbits[0].nodes() * block.orbit_node[0][at] +
                    orbits[1].nodes() * block.orbit_node[1][at]) *
                   parameters.per_weight;
      }
      for (const double sum : sums) EXPECT_EQ(sum, 0) << t << ", rule " << rule;
    }
  }
}

// Means of (k . x)^d by Gauss's rules of far higher degree. Edge rules are exact to degree 5, 7, 9,
// face rules to 4, 5, 6, 7, 8.
TEST(block, lumps_with_hessians_are_exact_for_polynomials) {
  const Mesh mesh = random_triangles(100, 3);
  const GaussRule gauss = gauss_legendre(8);
  const auto mean = [&](const auto& f) {
    double sum = 0;
    for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
      sum += gauss.weights[i] / 2 * f((1 + gauss.nodes[i]) / 2);
    }
    return sum;
  };
  for (std::size_t rule = 0; rule < kHermiteFaceRules; ++rule) {
    BlockParameters parameters = parameters_about({});
    with_rule(parameters, rule);
    const int edge_nodes = kHermiteEdges[edge_rule_of(rule)].nodes;
    const auto worked = work<double>(view_of(mesh), parameters);
    for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
      const Exact exact(mesh, t);
      const auto& block = *worked.blocks[t / kTrianglesPerBlock];
      const std::size_t at = t % kTrianglesPerBlock;
      const std::array<Vec3, 3> p = {mesh.vertices[3 * t], mesh.vertices[3 * t + 1],
                                     mesh.vertices[3 * t + 2]};
      const Vec3 k = test::random_direction(4, t);
      for (int d = 0; d < kHermiteFaces[rule].power; ++d) {
        const auto power = [&](const Vec3& x, int n) { return n < 0 ? 0 : std::pow(dot(k, x), n); };
        double lumped = 0, expected = 0;
        const double face = static_cast<double>(exact.face);
        expected +=
            face * mean([&](double a) {
              return 2 * (1 - a) * mean([&](double b) {
                       return power(p[0] + a * (p[1] - p[0]) + (1 - a) * b * (p[2] - p[0]), d);
                     });
            });
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 &a = p[i], e = p[(i + 1) % 3] - p[i];
          expected +=
              static_cast<double>(exact.w[i]) * mean([&](double s) { return power(a + s * e, d); });
          const double* lump = block.lump[i][at].value;
          lumped += kQuantum * (lump[0] * power(a, d) +
                                d * dot({lump[1], lump[2], lump[3]}, k) * power(a, d - 1));
          const double* h = block.hessian[0][i][at].value;
          const double* h2 = block.hessian[1][i][at].value;
          const double hessian = h[0] * k.x * k.x + h[3] * k.y * k.y + h2[1] * k.z * k.z +
                                 2 * (h[1] * k.x * k.y + h[2] * k.x * k.z + h2[0] * k.y * k.z);
          lumped += kQuantum * hessian * d * (d - 1) * power(a, d - 2);
          for (int n = 1; n <= edge_nodes; ++n) {
            lumped += block.edge_node[i][at] * power(a + n / (edge_nodes + 1.0) * e, d);
          }
          for (std::size_t o = 0; o < 2 && rule > 0; ++o) {
            const HermiteOrbit& orbit = kHermiteFaces[rule].orbits[o];
            if (orbit.nodes() == 0) continue;
            const Vec3 &q = p[(i + 1) % 3], &r = p[(i + 2) % 3];
            const double c = 1 - orbit.at - orbit.other;
            lumped += block.orbit_node[o][at] * power(c * a + orbit.at * q + orbit.other * r, d);
            if (orbit.nodes() == 3) continue;
            lumped += block.orbit_node[o][at] * power(c * a + orbit.other * q + orbit.at * r, d);
          }
        }
        if (rule > 0) lumped += block.center_node[at] * power((p[0] + p[1] + p[2]) / 3.0, d);
        const double size = std::pow(std::max({norm(p[0]), norm(p[1]), norm(p[2])}), d);
        EXPECT_NEAR(
            lumped, expected,
            size * (1 + d * d) * (100 * kQuantum + 60 * static_cast<double>(exact.rounding)))
            << "rule " << rule << ", degree " << d;
      }
    }
  }
}

bool closes(const MeshView& mesh) {
  const BlockSums sums = work<double>(mesh, parameters_about({})).sums;
  return sums.hash1 == 0 && sums.hash2 == 0;
}
bool closes(const Mesh& mesh) { return closes(view_of(mesh)); }

TEST(block, closed_meshes_have_hash_sums_of_zero) {
  const Mesh sphere = bumpy_sphere(2), cube = box({1, 2, 3}, 4);
  for (const Mesh& mesh : {sphere, cube, icosphere(0), latitude_longitude_sphere(9, 14),
                           test::tetrahedron(), test::l_prism(1), test::joined(sphere, cube)}) {
    EXPECT_TRUE(closes(mesh));
    EXPECT_TRUE(closes(test::exploded(mesh)));
    EXPECT_TRUE(closes(test::packed<float>(mesh).view));
    EXPECT_TRUE(closes(test::packed<double>(mesh, 5).view));
    Mesh inward = mesh;
    flip(inward);
    EXPECT_TRUE(closes(inward));
  }
}

// A seam: some triangles have copies of their vertices, with zeros of the opposite sign.
TEST(block, zero_and_minus_zero_are_one_place) {
  Mesh mesh = test::random_octahedron(3);
  for (std::size_t t = 0; t < 4; ++t) {
    for (std::uint32_t& corner : mesh.faces[t]) {
      Vec3 copy = mesh.vertices[corner];
      for (double* x : {&copy.x, &copy.y, &copy.z}) {
        if (*x == 0) *x = -*x;
      }
      corner = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(copy);
    }
  }
  ASSERT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                          [](const Vec3& v) { return v.x == 0 && std::signbit(v.x); }));
  EXPECT_TRUE(closes(mesh));
  EXPECT_TRUE(closes(test::packed<float>(mesh).view));
}

TEST(block, meshes_that_are_not_closed_or_oriented_have_other_hash_sums) {
  for (const int subdivisions : {0, 1, 3}) {
    const Mesh mesh = bumpy_sphere(subdivisions);
    for (std::size_t t = 0; t < mesh.faces.size(); t += 7) {
      Mesh open = mesh, flipped = mesh, doubled = mesh, moved = test::exploded(mesh);
      open.faces.erase(open.faces.begin() + static_cast<std::ptrdiff_t>(t));
      std::swap(flipped.faces[t][0], flipped.faces[t][1]);
      doubled.faces.push_back(mesh.faces[t]);
      double& x = moved.vertices[moved.faces[t][0]].x;
      x = std::nextafter(x, 2.0);
      for (const Mesh& bad : {open, flipped, doubled, moved}) EXPECT_FALSE(closes(bad));
      for (const Mesh& bad : {open, flipped, doubled}) {
        EXPECT_FALSE(closes(test::packed<float>(bad).view));
      }
    }
  }
}

// Coordinates are round numbers, whose last bits are all zeros.
TEST(block, holes_in_a_lattice_have_other_hash_sums) {
  Mesh open = box({8, 8, 8}, 8);
  for (std::size_t holes = 0; holes < 100; ++holes) {
    open.faces.erase(open.faces.begin() + static_cast<std::ptrdiff_t>(3 * holes));
    EXPECT_FALSE(closes(open)) << holes;
    EXPECT_FALSE(closes(test::packed<float>(open).view)) << holes;
  }
}

double signed_root(double x) { return std::copysign(std::sqrt(std::abs(x)), x); }

TEST(block, volume_distances_and_bad_faces_are_those_of_the_star_check) {
  const struct {
    Mesh mesh;
    Vec3 center;
  } cases[] = {{test::random_octahedron(1), {0, 0, 0}},
               {test::rotated(bumpy_sphere(3, 0.3)), {0.1, -0.3, 0.2}},
               {box({2, 2, 2}, 5), {0.9, 0.5, -0.99}},
               {box({2, 2, 2}, 3), {1, 0, 0}},     // on a face
               {test::l_prism(1), {0.5, 0.5, 0}},  // star-shaped
               {test::l_prism(1), {2, 0.5, 0.1}},  // not star-shaped
               {torus(1, 0.3, 30, 20), {0.1, 0, 0}},
               {icosphere(3), {3, 0, 0}}};
  for (const auto& [mesh, center] : cases) {
    const BlockSums sums = sums_of(mesh, center);
    const StarReport report = check_star(mesh, center, 0);
    EXPECT_NEAR(sums.volume6 / 6, enclosed_volume(mesh), 1e-13 * (1 + std::abs(sums.volume6)));
    EXPECT_NEAR(signed_root(sums.min_d2), report.min_d, 1e-14);
    EXPECT_NEAR(signed_root(sums.min_cos2), report.min_cos_gamma, 1e-14);
    EXPECT_EQ(sums.bad, report.bad_faces);
  }
}

// For 1/|x|^2 the rule of lumping leaves at most 5!/720 of (edge / radius)^4.
TEST(block, lumps_integrate_the_radius_to_a_sixth_of_the_fourth_power_of_the_edge) {
  for (const int subdivisions : {2, 4}) {
    const Mesh mesh = test::rotated(bumpy_sphere(subdivisions));
    const Vec3 center = {0.1, -0.2, 0.1};
    const BlockSums sums = sums_of(mesh, center);
    double expected = 0;
    for (const Triangle& t : mesh.faces) {
      const std::array<Vec3, 3> p = {mesh.vertices[t[0]] - center, mesh.vertices[t[1]] - center,
                                     mesh.vertices[t[2]] - center};
      expected += radius_integral(p, 1e-14);
    }
    EXPECT_NEAR(sums.mean / expected, 1, std::pow(sums.max_edge2, 2) / 6);
  }
}

// Longer edges use six nodes; the bound of plan.cpp holds with every instruction set.
TEST(block, six_nodes_integrate_the_radius_to_the_fifth_power_of_the_edge) {
  test::for_each_target([&](const char* target) {
    for (const int subdivisions : {2, 3, 4}) {
      const Mesh mesh = test::rotated(bumpy_sphere(subdivisions));
      const Vec3 center = {0.1, -0.2, 0.1};
      BlockParameters parameters = parameters_about(center);
      parameters.mean_reach2 = 1e-6;
      parameters.mean_nodes_reach2 = kInfinity;
      const BlockSums sums = work<double>(view_of(mesh), parameters).sums;
      double expected = 0;
      for (const Triangle& t : mesh.faces) {
        const std::array<Vec3, 3> p = {mesh.vertices[t[0]] - center, mesh.vertices[t[1]] - center,
                                       mesh.vertices[t[2]] - center};
        expected += radius_integral(p, 1e-14);
      }
      const double bound = 9 * 120 * kSixNodesConstant * std::pow(sums.max_edge2, 2.5);
      EXPECT_NEAR(sums.mean / expected, 1, bound + 1e-13) << target;
      EXPECT_GT(std::abs(sums.mean / expected - 1), 1e-6 * bound) << target;
    }
  });
}

// Some blocks are not full, down to one triangle: lanes without a triangle do not count.
TEST(block, sums_do_not_depend_on_how_triangles_are_dealt_out) {
  const Mesh mesh = test::rotated(bumpy_sphere(2, 0.4));
  const BlockParameters parameters = parameters_about({0.5, 0.3, 0});
  const BlockSums whole = work<double>(view_of(mesh), parameters).sums;
  for (const std::size_t per_block : {1u, 3u, 8u, 15u, 17u, 100u}) {
    const BlockSums sums = work<double>(view_of(mesh), parameters, per_block).sums;
    EXPECT_NEAR(sums.volume6, whole.volume6, 1e-13);
    EXPECT_NEAR(sums.mean, whole.mean, 1e-12);
    EXPECT_EQ(sums.min_d2, whole.min_d2);
    EXPECT_EQ(sums.min_cos2, whole.min_cos2);
    EXPECT_EQ(sums.max_edge2, whole.max_edge2);
    EXPECT_EQ(sums.bad, whole.bad);
    EXPECT_EQ(sums.nodes, whole.nodes);
    EXPECT_EQ(sums.hash1, whole.hash1);
    EXPECT_EQ(sums.hash2, whole.hash2);
  }
}

TEST(block, float_coordinates_give_the_same_bits_as_the_same_numbers_in_double) {
  const auto single = test::packed<float>(test::rotated(bumpy_sphere(2)));
  const Mesh same = test::unpacked(single.view);
  const BlockParameters parameters = parameters_about({0.1, 0, 0});
  const auto a = work<double>(single.view, parameters);
  const auto b = work<double>(view_of(same), parameters);
  EXPECT_EQ(a.sums.volume6, b.sums.volume6);
  for (std::size_t k = 0; k < a.blocks.size(); ++k) {
    for (std::size_t t = 0; t < 64; ++t) {
      for (int i = 0; i < 3; ++i) {
        for (int c = 0; c < 4; ++c) {
          EXPECT_EQ(a.blocks[k]->lump[i][t].value[c], b.blocks[k]->lump[i][t].value[c]);
        }
      }
    }
  }
}

TEST(block, every_instruction_set_agrees_to_rounding) {
  const Mesh mesh = random_triangles(500, 6);
  const BlockParameters parameters = parameters_about({});
  const auto expected = work<double>(view_of(mesh), parameters);
  test::for_each_target([&](const char* target) {
    const auto worked = work<double>(view_of(mesh), parameters);
    EXPECT_NEAR(worked.sums.volume6, expected.sums.volume6, 1e-12) << target;
    EXPECT_NEAR(worked.sums.mean, expected.sums.mean, 1e-10) << target;
    // Hashes differ between processors, but all of them vanish for closed meshes.
    EXPECT_TRUE(closes(test::exploded(bumpy_sphere(2)))) << target;
    EXPECT_NE(worked.sums.hash1, 0u) << target;
    EXPECT_EQ(worked.sums.bad, expected.sums.bad) << target;
    for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
      const auto &a = *worked.blocks[t / kTrianglesPerBlock],
                 &b = *expected.blocks[t / kTrianglesPerBlock];
      const std::size_t at = t % kTrianglesPerBlock;
      EXPECT_EQ(a.flag[at], b.flag[at]);
      const double tolerance = kQuantum + 2 * static_cast<double>(Exact(mesh, t).rounding);
      for (int i = 0; i < 3; ++i) {
        for (int c = 0; c < 4; ++c) {
          EXPECT_NEAR(kQuantum * a.lump[i][at].value[c], kQuantum * b.lump[i][at].value[c],
                      tolerance)
              << target;
        }
      }
    }
  });
}

TEST(block, flags_what_cannot_be_lumped) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0},  {1, 0.1, 0}, {1, 0, 0.1},  // plain
                   {1, 0, 0},  {2, 0, 0},   {1, 0, 0.1},  // edge-on
                   {1, 1, 1},  {1, 1, 1},   {1, 0, 0},    // no area
                   {1, -1, 0}, {1, 1, 0},   {1, 0, 1}};   // large
  mesh.faces = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
  BlockParameters parameters = parameters_about({});
  parameters.tolerance2 = 1;
  parameters.mean_reach2 = 0.1;
  const auto worked = work<double>(view_of(mesh), parameters);
  const std::uint8_t* flag = worked.blocks[0]->flag;
  EXPECT_EQ(flag[0], kLumped);
  EXPECT_TRUE((flag[1] & kNodes) != 0);
  EXPECT_EQ(flag[2], kNodes | kMeanNodes);
  EXPECT_EQ(flag[3], kNodes | kMeanNodes);
  EXPECT_EQ(worked.sums.nodes, 3u);
  EXPECT_EQ(worked.sums.bad, 1u);
  EXPECT_TRUE(std::isfinite(worked.sums.volume6));
  EXPECT_TRUE(std::isfinite(worked.sums.min_cos2));
}

TEST(block, the_probe_tells_of_coordinates_that_are_not_finite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    Mesh mesh = icosphere(2);
    mesh.vertices[77].y = bad;
    EXPECT_FALSE(std::isfinite(sums_of(mesh).probe));
  }
  EXPECT_EQ(sums_of(icosphere(2)).probe, 0);
}

}  // namespace
}  // namespace rholm
