// The caps of a sphere, and grids near them.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "support/test_points.h"
#include "surface/field/cap_field.h"

namespace rholm::test {

// Returns the atlas of the part of a unit sphere for which `keep` is true.
template <typename Keep>
Atlas sphere_atlas(std::size_t n, const Keep& keep) {
  std::vector<Vec3> all, points;
  for (const Vec3& p : sphere_points(n).points) {
    if (keep(p)) all.push_back(p);
  }
  const PointTree tree(all);
  for (const std::uint32_t i : tree.order()) points.push_back(all[i]);
  Cover made = cover({tree, points, points}, {}, {});
  Atlas atlas;
  atlas.caps = std::move(made.caps);
  atlas.coefficients = std::move(made.coefficients);
  atlas.spacing = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
  atlas.diagonal = 2 * std::sqrt(3.0);
  return atlas;
}

inline Atlas whole_sphere(std::size_t n) {
  return sphere_atlas(n, [](const Vec3&) { return true; });
}

inline double largest_support(const Atlas& atlas) {
  double largest = 0;
  for (const Cap& cap : atlas.caps) largest = std::max(largest, cap.frame.support);
  return largest;
}

struct Field {
  BlockGrid grid;
  CapLists lists;
};

inline Field make_field(const Atlas& atlas, double step) {
  const std::vector<Disc> discs = discs_of(atlas, CapBands(atlas, step));
  const Vec3 origin{-1.3, -1.2, -1.25};
  Field field;
  field.grid = make_block_grid(origin, step, list_blocks(origin, step, discs, 1000000));
  field.lists = list_caps(field.grid, discs);
  return field;
}

}  // namespace rholm::test
