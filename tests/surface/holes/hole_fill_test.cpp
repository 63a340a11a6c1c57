// Closing a grid with missing values. Oracles are counts by inspect(), and the complete sphere.
#include "surface/holes/hole_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "surface/field/field_grid.h"
#include "surface/holes/close_grid.h"
#include "surface/holes/hermite_rbf.h"
#include "surface/holes/hole_sets.h"
#include "surface/level_set/extract.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::box_grid;
using test::fill_grid;

void expect_closed_manifold(const Mesh& mesh) {
  const Inspection found = inspect(mesh);
  EXPECT_EQ(found.boundary_edges, 0U);
  EXPECT_EQ(found.non_manifold_edges, 0U);
  EXPECT_EQ(found.non_manifold_vertices, 0U);
  EXPECT_EQ(found.misoriented_edges, 0U);
  EXPECT_FALSE(found.inside_out);
}

FeetNear all_of(std::vector<FootPoint> feet) {
  return [feet = std::move(feet)](std::span<const Hole>) { return feet; };
}

// The unit sphere without the part within `half_angle` of z. Values are known where the nearest
// point of the sphere exists; there are only blocks with known values.
struct OpenSphere {
  std::vector<FootPoint> feet;
  std::vector<Vec3> points, area_normals;
  BlockGrid grid;
};

OpenSphere open_sphere(double half_angle, double step, int n) {
  OpenSphere sphere;
  const double border = std::cos(half_angle);
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n;
    if (z > border) continue;
    const double phi = i * pi * (3 - std::sqrt(5.0));
    const double s = std::sqrt(1 - z * z);
    const Vec3 p = {s * std::cos(phi), s * std::sin(phi), z};
    sphere.points.push_back(p);
    sphere.area_normals.push_back(4 * pi / n * p);
    sphere.feet.push_back({.at = p, .normal = p, .support = 5 * std::sqrt(4 * pi / n)});
  }
  std::vector<Disc> discs;
  discs.reserve(sphere.feet.size());
  for (const FootPoint& foot : sphere.feet) {
    discs.push_back({foot.at, foot.normal, 3 * step, 2.5 * step});
  }
  const Vec3 origin = {0.013, -0.007, 0.005};
  sphere.grid = make_block_grid(origin, step, list_blocks(origin, step, discs, 100000));
  fill_grid(sphere.grid, [&](const Vec3& x) {
    const double d = norm(x) - 1;
    const bool known = std::abs(d) < 2.5 * step && x.z < border * norm(x);
    return known ? d : static_cast<double>(BlockGrid::kUnknown);
  });
  return sphere;
}

TEST(CloseGrid, a_hole_is_closed_by_the_winding_number) {
  OpenSphere sphere = open_sphere(0.4, 0.04, 8000);
  const WindingTree tree(sphere.points, sphere.area_normals);
  const std::size_t before = sphere.grid.n_blocks();
  EXPECT_GT(inspect(extract_surface(sphere.grid).mesh).boundary_edges, 0U);
  const Closing closing =
      close_grid(sphere.grid, winding_values(tree.numbers(), sphere.grid.step), 100000);
  EXPECT_GT(closing.filled_nodes, 0U);
  EXPECT_EQ(sphere.grid.n_blocks(), before + closing.added_blocks);
  const ExtractedSurface surface = extract_surface(sphere.grid);
  expect_closed_manifold(surface.mesh);
  EXPECT_EQ(inspect(surface.mesh).euler_characteristic, 2);
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    const double above_border = surface.mesh.vertices[v].z - std::cos(0.4);
    if (std::abs(above_border) < 0.04) continue;  // within a step an edge may cross the border
    EXPECT_EQ(surface.filled[v] != 0, above_border > 0);
  }
}

TEST(CloseGrid, uncertain_values_on_the_wrong_side_become_unknown) {
  OpenSphere sphere = open_sphere(0, 0.04, 8000);
  const WindingTree tree(sphere.points, sphere.area_normals);
  BlockGrid& grid = sphere.grid;
  std::vector<std::uint64_t> uncertain(8 * grid.n_blocks(), 0);
  std::vector<float> expected;
  std::size_t n_wrong = 0;
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      float& value = grid.block_values(b)[n];
      // Nodes are wrong and unsure; wrong and sure; right and unsure; right. Farther than 0.022,
      // the radius of a dipole, the winding number is 0 or 1.
      const bool wrong = std::abs(value) > 0.03F && (n & 2) == 0, is_uncertain = (n & 1) == 0;
      if (wrong) value = -value;
      if (is_uncertain && std::isfinite(value))
        uncertain[8 * b + (n >> 6)] |= std::uint64_t{1} << (n & 63);
      expected.push_back(wrong && is_uncertain ? BlockGrid::kUnknown : value);
      n_wrong += wrong && is_uncertain ? 1 : 0;
    }
  }
  EXPECT_GT(n_wrong, 1000U);
  EXPECT_EQ(clear_refuted(grid, uncertain, tree.numbers()), n_wrong);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const float value = grid.block_values(i / BlockGrid::kNodes)[i % BlockGrid::kNodes];
    EXPECT_TRUE(value == expected[i] || (std::isnan(value) && std::isnan(expected[i]))) << i;
  }
}

TEST(CloseGrid, a_side_is_refuted_beyond_0_15_from_a_half) {
  // Dipoles of total area n at one place: w = n / (4 pi d^2) at a distance d below them.
  const std::vector<Vec3> points(100, Vec3{}), area_normals(100, Vec3{0, 0, 1});
  const WindingTree tree(points, area_normals);
  for (const double w : {0.34, 0.36, 0.64, 0.66}) {
    SCOPED_TRACE(w);
    BlockGrid grid =
        make_block_grid({0, 0, -std::sqrt(100 / (4 * std::numbers::pi * w))}, 1, {{0, 0, 0}});
    std::vector<std::uint64_t> uncertain(8, 0);
    uncertain[0] = 1;
    const float side = w < 0.5 ? -0.5F : 0.5F;  // the less likely sign
    grid.block_values(0)[0] = side;
    const bool refuted = w < 0.35 || w > 0.65;
    EXPECT_EQ(clear_refuted(grid, uncertain, tree.numbers()), refuted ? 1U : 0U);
    EXPECT_EQ(std::isnan(grid.block_values(0)[0]), refuted);
  }
}

TEST(CloseGrid, nothing_is_asked_for_where_nothing_is_open) {
  BlockGrid grid = box_grid({}, 0.1, -2, 2);
  fill_grid(grid, [](const Vec3& x) {
    const double d = norm(x) - 1;
    return std::abs(d) < 0.2 ? d : static_cast<double>(BlockGrid::kUnknown);
  });
  const Closing closing = close_grid(
      grid, [](auto, auto) { FAIL(); }, 1000);
  EXPECT_EQ(closing.filled_nodes, 0U);
  EXPECT_TRUE(grid.filled.empty());
}

// The worst case: known nodes at random with random signs, and an oracle that knows a sphere.
TEST(CloseGrid, random_known_nodes_become_a_closed_manifold) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    BlockGrid grid = make_block_grid({}, 1, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}});
    std::uint64_t counter = 0;
    const double share = 0.1 + 0.2 * static_cast<double>(seed % 4);
    fill_grid(grid, [&](const Vec3&) {
      const double u = random_uniform(seed, counter++);
      const double value = random_uniform(seed, counter++) - 0.5;
      return u < share ? value : static_cast<double>(BlockGrid::kUnknown);
    });
    close_grid(
        grid,
        [](std::span<const Vec3> x, std::span<double> values) {
          for (std::size_t i = 0; i < x.size(); ++i) values[i] = norm(x[i] - Vec3{7, 7, 7}) - 15;
        },
        1000);
    const Inspection found = inspect(extract_surface(grid).mesh);
    EXPECT_EQ(found.boundary_edges, 0U);
    EXPECT_TRUE(found.manifold && found.oriented);
    ASSERT_FALSE(HasFailure()) << seed;
  }
}

TEST(CloseGrid, a_level_that_does_not_close_is_refused) {
  OpenSphere sphere = open_sphere(0.4, 0.1, 2000);
  const auto plane = [](std::span<const Vec3> x, std::span<double> values) {
    for (std::size_t i = 0; i < x.size(); ++i) values[i] = x[i].x;
  };
  EXPECT_THROW(close_grid(sphere.grid, plane, 2000), Error);
}

TEST(CloseGrid, values_that_are_not_finite_count_as_outside) {
  OpenSphere sphere = open_sphere(0.4, 0.1, 2000);
  close_grid(
      sphere.grid,
      [](std::span<const Vec3>, std::span<double> values) {
        std::fill(values.begin(), values.end(), std::nan(""));
      },
      2000);
  expect_closed_manifold(extract_surface(sphere.grid).mesh);
}

TEST(HermiteRbf, has_the_zeros_and_gradients_it_is_given) {
  std::vector<Vec3> centers;
  std::vector<Vec3> normals;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const auto u = [&](std::uint64_t k) { return 2 * random_uniform(3, 10 * i + k) - 1; };
    centers.push_back(Vec3{100, 200, 300} + 7 * Vec3{u(0), u(1), u(2)});
    normals.push_back(normalized(Vec3{u(3), u(4), u(5)}));
  }
  const HermiteRbf s(centers, normals);
  ASSERT_TRUE(s.valid());
  const double h = 1e-4;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const Vec3& x = centers[i];
    const auto slope = [&](const Vec3& d) { return (s(x + h * d) - s(x - h * d)) / (2 * h); };
    EXPECT_NEAR(s(x), 0, 1e-9);
    EXPECT_LT(norm(Vec3{slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})} - normals[i]), 1e-3);
  }
}

TEST(HermiteRbf, is_the_plane_its_centres_lie_in) {
  const std::vector<Vec3> centers = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {3, 2, 2}, {-1, 2, 2}};
  const std::vector<Vec3> normals(5, Vec3{0, 0, 1});
  const HermiteRbf s(centers, normals);
  for (double z = -3; z < 5; z += 0.7) EXPECT_NEAR(s({z, 2 * z, z}), z - 2, 1e-10);
}

TEST(HermiteRbf, centres_that_say_nothing_are_not_valid) {
  EXPECT_FALSE(HermiteRbf({}, {}).valid());
  const std::vector<Vec3> same(5, Vec3{1, 2, 3});
  EXPECT_FALSE(HermiteRbf(same, same).valid());
}

TEST(HoleSets, holes_are_counted_and_placed) {
  BlockGrid grid = box_grid({}, 1, 0, 4);
  fill_grid(grid, [](const Vec3&) { return 1.0; });
  grid.filled.assign(8 * grid.n_blocks(), 0);
  const std::vector<Vec3> middles = {{8, 8, 8}, {20, 8, 8}, {15, 22, 25}};
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      for (const Vec3& middle : middles) {
        if (norm(grid.node(b, n) - middle) < 4.1) {
          grid.filled[8 * b + n / 64] |= std::uint64_t{1} << n % 64;
        }
      }
    }
  }
  const std::vector<Hole> holes = find_holes(grid);
  ASSERT_EQ(holes.size(), 3U);
  for (std::size_t h = 0; h < 3; ++h) {
    EXPECT_LT(norm(holes[h].center - middles[h]), 1e-9);
    EXPECT_EQ(holes[h].nodes.size(), holes[0].nodes.size());
    EXPECT_NEAR(holes[h].reach, 4, 1e-12);
    EXPECT_NEAR(holes[h].radius, 3.6, 0.4);  // the outermost layer
  }
}

// The missing cap rises by the sagitta 1 - cos(20 degrees) over its rim.
TEST(HoleFill, missing_cap_of_a_sphere_is_filled_to_a_small_part_of_its_sagitta) {
  const double half_angle = 20 * pi / 180;
  const double sagitta = 1 - std::cos(half_angle);
  for (const double step : {0.04, 0.02}) {
    OpenSphere sphere = open_sphere(half_angle, step, static_cast<int>(4 * pi / (step * step)));
    const WindingTree tree(sphere.points, sphere.area_normals);
    const HoleFilling filling = fill_holes(sphere.grid, all_of(sphere.feet), tree.numbers(),
                                           {.max_blocks = 100000, .support = {}});
    EXPECT_EQ(filling.holes, 1U);
    EXPECT_EQ(filling.smooth, 1U);
    const ExtractedSurface surface = extract_surface(sphere.grid);
    expect_closed_manifold(surface.mesh);
    EXPECT_EQ(inspect(surface.mesh).euler_characteristic, 2);
    double largest = 0;
    for (const Vec3& v : surface.mesh.vertices) largest = std::max(largest, std::abs(norm(v) - 1));
    EXPECT_LT(largest, 0.05 * sagitta);
    // Normals of all vertices are compared, also at the border. Tiny triangles around a node are
    // left out: the error of linear interpolation, step^2 / 8, is large for them. A chord gives 2
    // degrees.
    std::vector<Vec3> normals(surface.mesh.vertices.size());
    for (const Triangle& t : surface.mesh.faces) {
      const std::vector<Vec3>& v = surface.mesh.vertices;
      const Vec3 n = cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
      for (const std::uint32_t corner : t) normals[corner] += n;
    }
    double tilt = 0;
    for (std::size_t v = 0; v < normals.size(); ++v) {
      if (norm(normals[v]) < 0.4 * step * step) continue;
      const Vec3 radial = normalized(surface.mesh.vertices[v]);
      tilt = std::max(tilt, std::acos(dot(normalized(normals[v]), radial)));
    }
    EXPECT_LT(tilt * 180 / pi, 4);
    RecordProperty("largest_over_sagitta", std::to_string(largest / sagitta));
    RecordProperty("tilt", std::to_string(tilt * 180 / pi));
  }
}

TEST(HoleFill, values_without_support_are_handed_over_to_the_fill) {
  const double half_angle = 20 * pi / 180;
  OpenSphere sphere = open_sphere(half_angle, 0.03, 14000);
  // A wrong extrapolation of caps beyond their points: a band of 5 degrees that bends away.
  const double from = half_angle + 5 * pi / 180;
  for (std::size_t b = 0; b < sphere.grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      const Vec3 x = sphere.grid.node(b, n);
      const double angle = std::acos(x.z / norm(x));
      if (angle < from) sphere.grid.block_values(b)[n] += static_cast<float>(0.3 * (from - angle));
    }
  }
  std::erase_if(sphere.feet, [&](const FootPoint& f) { return std::acos(f.at.z) < from; });
  const WindingTree tree(sphere.points, sphere.area_normals);
  const NodeSupport support = [&](std::span<const Vec3> x, std::span<double> s) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      s[i] = 1 - (from - std::acos(x[i].z / norm(x[i]))) / 0.01;
      s[i] = std::clamp(s[i], 0.0, 1.0);
    }
  };
  fill_holes(sphere.grid, all_of(sphere.feet), tree.numbers(),
             {.max_blocks = 100000, .support = support});
  const ExtractedSurface surface = extract_surface(sphere.grid);
  expect_closed_manifold(surface.mesh);
  for (const Vec3& v : surface.mesh.vertices) {
    EXPECT_NEAR(norm(v), 1, 0.05 * (1 - std::cos(from)));
  }
}

TEST(HoleFill, the_grid_itself_says_where_the_fill_begins) {
  const double half_angle = 20 * pi / 180;
  OpenSphere sphere = open_sphere(half_angle, 0.03, 14000);
  const WindingTree tree(sphere.points, sphere.area_normals);
  const NodeSupport all = [](std::span<const Vec3> x, std::span<double> support) {
    std::fill_n(support.begin(), x.size(), 1.0);
  };
  // The cloud has no foot points of caps.
  const HoleFilling filling =
      fill_holes(sphere.grid, all_of({}), tree.numbers(), {.max_blocks = 100000, .support = all});
  EXPECT_EQ(filling.smooth, 1U);
  const ExtractedSurface surface = extract_surface(sphere.grid);
  expect_closed_manifold(surface.mesh);
  // Grid nodes with six known neighbours begin two steps from the rim.
  const double wide = half_angle + 2 * 0.03;
  for (const Vec3& v : surface.mesh.vertices) EXPECT_NEAR(norm(v), 1, 0.075 * (1 - std::cos(wide)));
}

// Returns two concentric spheres, both without the same part.
OpenSphere open_shell(double half_angle, double thickness, double step, int n) {
  OpenSphere shell = open_sphere(half_angle, step, n);
  const double inner = 1 - thickness;
  const std::size_t half = shell.points.size();
  for (std::size_t i = 0; i < half; ++i) {
    shell.points.push_back(inner * shell.points[i]);
    shell.area_normals.push_back(-inner * inner * shell.area_normals[i]);
    shell.feet.push_back({inner * shell.feet[i].at, -shell.feet[i].normal, shell.feet[i].support});
  }
  fill_grid(shell.grid, [&](const Vec3& x) {
    const double d = std::max(norm(x) - 1, inner - norm(x));
    const bool known = std::abs(d) < 2.5 * step && x.z < std::cos(half_angle) * norm(x);
    return known ? d : static_cast<double>(BlockGrid::kUnknown);
  });
  return shell;
}

TEST(HoleFill, a_hole_in_two_sheets_is_no_bridge_between_them) {
  const double thickness = 0.15, step = 0.05;
  // The winding number bridges holes wider than sqrt(3) / 2 of the thickness.
  for (const double half_angle : {0.14, 0.16, 0.2, 0.3}) {
    OpenSphere shell = open_shell(half_angle, thickness, step, 14000);
    // The few caps are large: the hole is smaller than their supports.
    std::vector<FootPoint> feet;
    for (std::size_t i = 0; i < shell.feet.size(); i += 20) {
      feet.push_back(shell.feet[i]);
      feet.back().support = 0.3;
    }
    const WindingTree tree(shell.points, shell.area_normals);
    const NodeSupport all = [](std::span<const Vec3> x, std::span<double> support) {
      std::fill_n(support.begin(), x.size(), 1.0);
    };
    fill_holes(shell.grid, all_of(feet), tree.numbers(), {.max_blocks = 100000, .support = all});
    const Mesh mesh = extract_surface(shell.grid).mesh;
    expect_closed_manifold(mesh);
    EXPECT_EQ(inspect(mesh).components, 2U) << half_angle;
    EXPECT_EQ(inspect(mesh).euler_characteristic, 4) << half_angle;
    // A plane over the hole would be off by the sagitta.
    const double sagitta = 1 - std::cos(half_angle + 2 * step);
    for (const Vec3& v : mesh.vertices) {
      const double off = std::min(std::abs(norm(v) - 1), std::abs(norm(v) - (1 - thickness)));
      EXPECT_LT(off, 0.5 * sagitta) << half_angle;
    }
  }
}

TEST(HoleSets, a_hole_between_sheets_has_two_borders) {
  OpenSphere sphere = open_sphere(0.2, 0.05, 14000);
  OpenSphere shell = open_shell(0.2, 0.15, 0.05, 14000);
  for (OpenSphere* open : {&sphere, &shell}) {
    const WindingTree tree(open->points, open->area_normals);
    close_grid(open->grid, winding_values(tree.numbers(), open->grid.step), 100000);
    const std::vector<Hole> holes = find_holes(open->grid);
    ASSERT_EQ(holes.size(), 1U);
    EXPECT_EQ(count_borders(open->grid, holes[0]), open == &sphere ? 1U : 2U);
  }
}

TEST(HoleFill, threads_do_not_change_a_bit) {
  std::vector<Mesh> meshes;
  for (const int threads : {1, 2}) {
    OpenSphere sphere = open_sphere(0.4, 0.05, 5000);
    const WindingTree tree(sphere.points, sphere.area_normals);
    fill_holes(sphere.grid, all_of(sphere.feet), tree.numbers(),
               {.max_blocks = 100000, .support = {}}, {.threads = threads, .progress = {}});
    meshes.push_back(extract_surface(sphere.grid).mesh);
  }
  EXPECT_EQ(meshes[0].vertices, meshes[1].vertices);
  EXPECT_EQ(meshes[0].faces, meshes[1].faces);
}

}  // namespace
}  // namespace rholm
