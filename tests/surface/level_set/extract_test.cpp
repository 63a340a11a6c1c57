// Expected values are closed forms: areas, volumes and Euler characteristics of smooth surfaces.
// Closedness and manifoldness are counted by inspect().
#include "surface/level_set/extract.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "support/sizes.h"
#include "support/targets.h"
#include "surface/field/field_grid.h"
#include "surface/grid/node_masks.h"
#include "surface/level_set/marching_cubes_table.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::box_grid;
using test::fill_grid;

void expect_closed_manifold(const Inspection& found) {
  EXPECT_EQ(found.boundary_edges, 0U);
  EXPECT_EQ(found.non_manifold_edges, 0U);
  EXPECT_EQ(found.misoriented_edges, 0U);
  EXPECT_EQ(found.non_manifold_vertices, 0U);
  EXPECT_EQ(found.isolated_vertices, 0U);
  EXPECT_EQ(found.degenerate_faces, 0U);
  EXPECT_EQ(found.duplicate_faces, 0U);
}

// Values for the nodes of blocks 0 ... 2: random where the eight cubes around a node are complete,
// and outside at the border.
BlockGrid random_grid(std::uint64_t seed, double share_inside) {
  BlockGrid grid = box_grid({}, 1, 0, 3);
  std::uint64_t counter = 0;
  fill_grid(grid, [&](const Vec3& x) {
    const double u = random_uniform(seed, counter++) - share_inside;
    const bool border = std::min({x.x, x.y, x.z}) < 0.5 || std::max({x.x, x.y, x.z}) > 22.5;
    return border ? std::abs(u) + 0.1 : u;
  });
  return grid;
}

TEST(SurfaceTable, every_crossed_edge_stands_in_one_loop_that_is_triangulated) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    const SurfaceCase& surface = surface_table()[inside];
    int crossed = 0;
    for (int e = 0; e < 12; ++e) {
      const unsigned from = kEdgeCorner[e];
      crossed += (inside >> from & 1) != (inside >> (from | 1U << e / 4) & 1);
    }
    EXPECT_EQ(surface.n_edges, crossed);
    EXPECT_EQ(surface.n_faces == 0, crossed == 0) << inside;
  }
}

TEST(NodeMasks, have_a_bit_for_each_node_of_any_number_of_blocks) {
  const float special[] = {-1,
                           1,
                           0,
                           -0.0f,
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           std::nanf("")};
  std::vector<float> values(33 * 512);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = special[static_cast<std::size_t>(7 * random_uniform(11, i))];
  }
  test::for_each_target([&](const char* target) {
    for (std::size_t n = 1; n <= 33; ++n) {
      std::vector<NodeMasks> masks(n);
      node_masks(values.data(), n, masks.data());
      for (std::size_t i = 0; i < 512 * n; ++i) {
        const NodeMasks& block = masks[i / 512];
        const std::size_t z = i % 512 / 64, bit = i % 64;
        ASSERT_EQ(block.known[z] >> bit & 1, std::isfinite(values[i]) ? 1u : 0u) << target;
        ASSERT_EQ(block.inside[z] >> bit & 1, values[i] == -1 ? 1u : 0u) << target;
      }
    }
  });
}

TEST_OF_TWO_SIZES(Extract, random_signs_at_all_nodes_give_a_closed_manifold) {
  for (std::uint64_t seed = 0; seed < (nightly ? 240 : 60); ++seed) {
    const double share = 0.05 + 0.9 * static_cast<double>(seed % 10) / 9;
    const ExtractedSurface surface = extract_surface(random_grid(seed, share));
    const Inspection found = inspect(surface.mesh);
    expect_closed_manifold(found);
    EXPECT_FALSE(found.inside_out);
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
  }
}

TEST(Extract, values_of_zero_are_outside_and_give_no_degenerate_triangle) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    BlockGrid grid = random_grid(seed, 0.5);
    for (std::size_t i = 0; i < grid.n_blocks() * BlockGrid::kNodes; ++i) {
      const double u = random_uniform(seed + 1000, i);
      if (u < 0.3) grid.values[i] = u < 0.15 ? 0.0F : -0.0F;
    }
    const Inspection with_zeros = inspect(extract_surface(grid).mesh);
    expect_closed_manifold(with_zeros);
    for (float& v : grid.values) v = v == 0 ? 0.1F : v;
    const Inspection without = inspect(extract_surface(grid).mesh);
    EXPECT_EQ(with_zeros.faces, without.faces);
    EXPECT_EQ(with_zeros.euler_characteristic, without.euler_characteristic);
  }
}

// Linear interpolation has the error h^2 / 8 times the curvature of the field, and so has a chord.
// Area and volume are off by a few (h / r)^2, measured as 0.3 and 0.5.
TEST(Extract, sphere_has_its_area_volume_and_one_piece) {
  for (const double h : {0.2, 0.1, 0.05}) {
    const Vec3 origin = {-4.8 * 8 * h / 2, 0.03, -0.01};
    BlockGrid grid = box_grid(origin, h, -4, 5);
    const Vec3 center = origin + Vec3{0.41 * h, 0.17 * h, 0.33 * h};
    fill_grid(grid, [&](const Vec3& x) { return norm(x - center) - 1; });
    const Inspection found = inspect(extract_surface(grid).mesh);
    expect_closed_manifold(found);
    EXPECT_EQ(found.euler_characteristic, 2);
    EXPECT_NEAR(found.area, 4 * pi, 4 * pi * h * h);
    EXPECT_NEAR(found.volume, 4 * pi / 3, 4 * pi / 3 * h * h);
    EXPECT_LT(norm(found.volume_centroid - center), h * h);
  }
}

TEST(Extract, torus_has_its_area_volume_and_one_hole) {
  const double h = 0.04;
  BlockGrid grid = box_grid({0.011, 0.002, 0.017}, h, -5, 5);
  fill_grid(grid, [&](const Vec3& x) { return std::hypot(std::hypot(x.x, x.y) - 1, x.z) - 0.4; });
  const Inspection found = inspect(extract_surface(grid).mesh);
  expect_closed_manifold(found);
  EXPECT_EQ(found.euler_characteristic, 0);
  EXPECT_EQ(found.genus, 1U);
  const double relative = (h / 0.4) * (h / 0.4);
  EXPECT_NEAR(found.area, 4 * pi * pi * 0.4, 4 * pi * pi * 0.4 * relative);
  EXPECT_NEAR(found.volume, 2 * pi * pi * 0.16, 2 * pi * pi * 0.16 * relative);
}

// The gyroid has genus 3 in a primitive cell. The cubic cell has two of them: its Euler
// characteristic is -8. Its area is 3.0915 in a cell of side 1. Schoen (1970) gives 3.091444 for
// the minimal surface, from which the trigonometric surface differs by less than 1e-3.
TEST(Extract, gyroid_has_the_euler_characteristic_of_its_cell) {
  const double h = 1.0 / 32;  // the cubic cell is 4 x 4 x 4 blocks
  BlockGrid grid = box_grid({}, h, -1, 5);
  fill_grid(grid, [](const Vec3& p) {
    const Vec3 x = 2 * pi * (p + Vec3{0.0031, 0.0017, 0.0043});
    return std::sin(x.x) * std::cos(x.y) + std::sin(x.y) * std::cos(x.z) +
           std::sin(x.z) * std::cos(x.x);
  });
  const ExtractedSurface surface = extract_surface(grid);
  const auto in_cell = [](double c) { return c >= 0 && c < 1; };
  long long vertices = 0;
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    const BlockCoordinates& c = grid.blocks[b];
    if (*std::min_element(c.begin(), c.end()) < 0 || *std::max_element(c.begin(), c.end()) > 3) {
      continue;
    }
    vertices += surface.first_vertex[b + 1] - surface.first_vertex[b];
  }
  long long triangles = 0;
  double area = 0;
  for (const Triangle& t : surface.mesh.faces) {
    const std::vector<Vec3>& v = surface.mesh.vertices;
    const Vec3 middle = (v[t[0]] + v[t[1]] + v[t[2]]) / 3;
    if (!in_cell(middle.x) || !in_cell(middle.y) || !in_cell(middle.z)) continue;
    ++triangles;
    area += norm(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]])) / 2;
  }
  EXPECT_EQ(2 * vertices - triangles, 2 * -8);  // 3 triangles have 2 x 3 half-edges
  EXPECT_NEAR(area, 3.0915, 0.01);
}

TEST(Extract, vertices_stand_behind_each_other_block_by_block_near_their_nodes) {
  const BlockGrid grid = random_grid(3, 0.4);
  const ExtractedSurface surface = extract_surface(grid);
  ASSERT_EQ(surface.first_vertex.size(), grid.n_blocks() + 1);
  EXPECT_EQ(surface.first_vertex.back(), surface.mesh.vertices.size());
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::uint32_t v = surface.first_vertex[b]; v < surface.first_vertex[b + 1]; ++v) {
      const Vec3 p = surface.mesh.vertices[v] - grid.node(b, 0, 0, 0);
      EXPECT_TRUE(std::min({p.x, p.y, p.z}) >= 0 && std::max({p.x, p.y, p.z}) < 8);
    }
  }
}

TEST(Extract, vertices_of_filled_nodes_are_marked) {
  BlockGrid grid = box_grid({}, 0.1, -2, 2);
  fill_grid(grid, [](const Vec3& x) { return norm(x) - 1; });
  grid.filled.assign(8 * grid.n_blocks(), 0);
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      if (grid.node(b, n).z > 0.45) grid.filled[8 * b + n / 64] |= std::uint64_t{1} << n % 64;
    }
  }
  const ExtractedSurface surface = extract_surface(grid);
  ASSERT_EQ(surface.filled.size(), surface.mesh.vertices.size());
  for (std::size_t v = 0; v < surface.filled.size(); ++v) {
    // Vertices between the nodes at 0.4 and 0.5 may count either way, and are not tested.
    const double z = surface.mesh.vertices[v].z;
    if (z > 0.499 || z < 0.401) {
      EXPECT_EQ(surface.filled[v] != 0, z > 0.45);
    }
  }
}

TEST(Extract, unknown_nodes_leave_borders_and_no_vertex_without_a_triangle) {
  BlockGrid grid = box_grid({}, 0.1, -2, 2);
  fill_grid(grid, [](const Vec3& x) {
    if (x.z > 0.75) return static_cast<double>(BlockGrid::kUnknown);
    return x.z < -0.95 ? std::numeric_limits<double>::infinity() : norm(x) - 1;
  });
  const Inspection found = inspect(extract_surface(grid).mesh);
  EXPECT_EQ(found.euler_characteristic, 0);  // a belt
  EXPECT_GT(found.boundary_edges, 0U);
  EXPECT_EQ(found.isolated_vertices, 0U);
  EXPECT_TRUE(found.oriented);
}

TEST(Extract, threads_do_not_change_a_bit) {
  const BlockGrid grid = random_grid(7, 0.3);
  const ExtractedSurface one = extract_surface(grid, {.threads = 1, .progress = {}});
  const ExtractedSurface two = extract_surface(grid, {.threads = 2, .progress = {}});
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(one.mesh.faces, two.mesh.faces);
  EXPECT_EQ(one.first_vertex, two.first_vertex);
  BlockGrid last = random_grid(7, 0.3);
  const ExtractedSurface released = extract_last_surface(last, {.threads = 2, .progress = {}});
  EXPECT_EQ(released.mesh.vertices, one.mesh.vertices);
  EXPECT_EQ(released.mesh.faces, one.mesh.faces);
  EXPECT_EQ(last.values.size(), 0U);
}

TEST(Extract, no_blocks_give_an_empty_mesh) {
  const BlockGrid grid = make_block_grid({}, 1, {});
  EXPECT_TRUE(extract_surface(grid).mesh.faces.empty());
}

// Every node within a disc must have its block; blocks are sorted and distinct.
TEST(BlockGrid, discs_find_the_blocks_of_all_their_nodes) {
  const Vec3 origin = {1, -2, 3};
  const double step = 0.3;
  std::vector<Disc> discs;
  for (std::uint64_t i = 0; i < 30; ++i) {
    const auto u = [&](std::uint64_t k) { return 2 * random_uniform(5, 10 * i + k) - 1; };
    discs.push_back({.center = 20 * Vec3{u(0), u(1), u(2)},
                     .normal = normalized(Vec3{u(3), u(4), u(5)}),
                     .radius = 3 + 2 * u(6),
                     .half_thickness = 1 + u(7)});
  }
  const std::vector<BlockCoordinates> blocks = list_blocks(origin, step, discs, 100000);
  const auto place = [](const BlockCoordinates& b) { return std::tuple(b[2], b[1], b[0]); };
  EXPECT_TRUE(std::adjacent_find(blocks.begin(), blocks.end(), [&](const auto& a, const auto& b) {
                return place(a) >= place(b);
              }) == blocks.end());
  const BlockGrid grid = make_block_grid(origin, step, blocks);
  const auto floor_of = [](double x) { return static_cast<std::int32_t>(std::floor(x)); };
  for (const Disc& disc : discs) {
    const Vec3 c = (disc.center - origin) / step;
    const double reach = disc.radius / step + 1;
    for (int z = floor_of(c.z - reach); z <= c.z + reach; ++z) {
      for (int y = floor_of(c.y - reach); y <= c.y + reach; ++y) {
        for (int x = floor_of(c.x - reach); x <= c.x + reach; ++x) {
          const Vec3 d = origin + step * Vec3{1.0 * x, 1.0 * y, 1.0 * z} - disc.center;
          if (norm(d) > disc.radius || std::abs(dot(d, disc.normal)) > disc.half_thickness) {
            continue;
          }
          EXPECT_NE(find_block(grid, {x >> 3, y >> 3, z >> 3}), kNoBlock);
        }
      }
    }
  }
}

TEST(BlockGrid, added_blocks_are_found_and_neighbours_know_each_other) {
  BlockGrid grid = box_grid({}, 1, 0, 2);
  fill_grid(grid, [](const Vec3& x) { return x.x + 100 * x.y + 10000 * x.z; });
  std::vector<BlockCoordinates> more;
  for (int i = -3; i < 4; ++i) more.push_back({i, 0, 0});
  add_blocks(grid, more);
  EXPECT_EQ(grid.n_blocks(), 13U);
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    EXPECT_EQ(find_block(grid, grid.blocks[b]), static_cast<std::int32_t>(b));
    for (int n = 0; n < 27; ++n) {
      const BlockCoordinates& c = grid.blocks[b];
      EXPECT_EQ(grid.neighbours[b][n],
                find_block(grid, {c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1}));
    }
    const Vec3 x = grid.node(b, 3, 5, 7);
    if (b < 8) {
      EXPECT_EQ(grid.block_values(b)[3 + 8 * 5 + 64 * 7], x.x + 100 * x.y + 10000 * x.z);
    } else {
      EXPECT_TRUE(std::isnan(grid.block_values(b)[0]));
    }
  }
}

TEST(BlockGrid, too_many_blocks_and_points_too_far_are_refused) {
  const Disc disc = {.center = {}, .normal = {0, 0, 1}, .radius = 100, .half_thickness = 1};
  EXPECT_THROW(list_blocks({}, 1, std::vector{disc}, 100), Error);
  EXPECT_NO_THROW(list_blocks({}, 1, std::vector{disc}, 1500));
  EXPECT_THROW(list_blocks({}, 1e-6, std::vector{disc}, 1000), Error);
  EXPECT_THROW(list_blocks({1e9, 0, 0}, 1, std::vector{disc}, 10000), Error);
  EXPECT_THROW(list_blocks({NAN, 0, 0}, 1, std::vector{disc}, 10000), Error);
}

}  // namespace
}  // namespace rholm
