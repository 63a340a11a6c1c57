#include "shape/points/gauss_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr float kOpening = 2;
constexpr std::size_t kGrain = 16;  // leaves of some 16 points
// Least squared width of a patch. Single precision still separates places at this distance, and
// cubes of widths do not underflow.
constexpr float kLeastWidth2 = 1e-12f;
constexpr double kFourPi = 4 * std::numbers::pi;

float distance(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

std::array<float, 3> single(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

float squared(double width) { return std::max(static_cast<float>(width * width), kLeastWidth2); }

}  // namespace

struct GaussField::Strengths {
  std::vector<std::array<float, 3>> points, nodes;
};

struct GaussField::List {
  std::vector<float> column[7];
  std::vector<std::uint32_t> open;  // nodes still to be looked at, with their levels
  std::vector<std::uint8_t> level;

  void clear() {
    for (std::vector<float>& c : column) c.clear();
  }
  void add(const std::array<float, 3>& at, const std::array<float, 3>& a, float width2) {
    for (std::size_t k = 0; k < 3; ++k) {
      column[k].push_back(at[k]);
      column[3 + k].push_back(a[k]);
    }
    column[6].push_back(width2);
  }
  // Pads with a far source of strength zero, which adds nothing.
  void pad() {
    while (column[0].size() % kGaussLanes != 0) add({8, 8, 8}, {0, 0, 0}, 1);
  }
  GaussSources view() const {
    return {column[0].data(), column[1].data(),
            column[2].data(), {column[3].data(), column[4].data(), column[5].data()},
            column[6].data(), column[0].size()};
  }
};

GaussField::GaussField(const PointTree& tree, std::span<const Vec3> points,
                       std::span<const double> areas, const Context& context)
    : tree_(tree), areas_(areas.begin(), areas.end()), width2_(points.size(), kLeastWidth2) {
  points_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points_[i] = single(points[i]);
  // The tree is complete: nodes are sets of 1, 2, 4, ... leaves.
  for (std::size_t n = tree.n_leaves();; n = (n + 1) / 2) {
    level_begin_.push_back(nodes_.size());
    nodes_.resize(nodes_.size() + n);
    if (n == 1) break;
  }
  level_begin_.push_back(nodes_.size());
  report_progress(context, "", 0);
  const auto place_node = [&](std::size_t node, std::size_t begin, std::size_t end) {
    std::array<double, 3> sum{};
    double weight = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const double w = areas_[i] + 1e-30;
      for (std::size_t a = 0; a < 3; ++a) sum[a] += w * points_[i][a];
      weight += w;
    }
    Node& made = nodes_[node];
    for (std::size_t a = 0; a < 3; ++a) made.middle[a] = static_cast<float>(sum[a] / weight);
    for (std::size_t i = begin; i < end; ++i) {
      made.radius = std::max(made.radius, distance(points_[i], made.middle));
    }
  };
  for (std::size_t level = 0; level + 1 < level_begin_.size(); ++level) {
    const std::size_t first = level_begin_[level], n = level_begin_[level + 1] - first;
    parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) {
        const std::size_t leaves = tree.n_leaves();
        const std::size_t a = std::min(j << level, leaves), b = std::min((j + 1) << level, leaves);
        place_node(first + j, tree.leaf_begin(a), tree.leaf_begin(b));
      }
    });
  }
}

void GaussField::set_widths(std::span<const double> widths) {
  for (std::size_t i = 0; i < width2_.size(); ++i) {
    width2_[i] = squared(widths[i]);
  }
}

GaussField::Strengths GaussField::strengths(std::span<const Vec3> a) const {
  Strengths s;
  s.points.resize(points_.size());
  s.nodes.resize(nodes_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    s.points[i] = single(a[i]);
  }
  const std::size_t leaves = tree_.n_leaves();
  for (std::size_t j = 0; j < leaves; ++j) {
    for (std::size_t i = tree_.leaf_begin(j); i < tree_.leaf_begin(j + 1); ++i) {
      for (std::size_t k = 0; k < 3; ++k) s.nodes[j][k] += s.points[i][k];
    }
  }
  for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) {
    const std::size_t below = level_begin_[level - 1], n_below = level_begin_[level] - below;
    for (std::size_t j = 0; j < n_below; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        s.nodes[level_begin_[level] + j / 2][k] += s.nodes[below + j][k];
      }
    }
  }
  return s;
}

void GaussField::gather(const std::array<float, 3>& middle, float radius,
                        const Strengths& strengths, List& list) const {
  list.clear();
  list.open = {0};
  list.level = {static_cast<std::uint8_t>(level_begin_.size() - 2)};
  while (!list.open.empty()) {
    const std::uint32_t j = list.open.back();
    const std::uint8_t level = list.level.back();
    list.open.pop_back(), list.level.pop_back();
    const std::size_t node = level_begin_[level] + j;
    if (distance(nodes_[node].middle, middle) - radius > kOpening * nodes_[node].radius) {
      list.add(nodes_[node].middle, strengths.nodes[node], kLeastWidth2);
    } else if (level == 0) {
      for (std::size_t i = tree_.leaf_begin(j); i < tree_.leaf_begin(j + 1); ++i) {
        list.add(points_[i], strengths.points[i], width2_[i]);
      }
    } else {
      const std::size_t n_below = level_begin_[level] - level_begin_[level - 1];
      for (std::uint32_t child = 2 * j + 2; child-- > 2 * j;) {
        if (child >= n_below) continue;
        list.open.push_back(child);
        list.level.push_back(static_cast<std::uint8_t>(level - 1));
      }
    }
  }
  list.pad();
}

template <typename Visit>
void GaussField::for_places(const PointTree& tree, std::span<const std::array<float, 3>> places,
                            const Strengths& strengths, const Context& context,
                            const Visit& visit) const {
  parallel_for(tree.n_leaves(), kGrain, context, {}, [&](std::size_t first, std::size_t last) {
    List list;
    for (std::size_t leaf = first; leaf < last; ++leaf) {
      const std::size_t begin = tree.leaf_begin(leaf), end = tree.leaf_begin(leaf + 1);
      if (begin == end) continue;
      std::array<float, 3> middle{};
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
          middle[k] += places[i][k] / static_cast<float>(end - begin);
        }
      }
      float radius = 0;
      for (std::size_t i = begin; i < end; ++i) {
        radius = std::max(radius, distance(places[i], middle));
      }
      gather(middle, radius, strengths, list);
      const GaussSources sources = list.view();
      for (std::size_t i = begin; i < end; ++i) visit(i, places[i].data(), sources);
    }
  });
}

std::vector<double> GaussField::winding(std::span<const Vec3> area_normals,
                                        const Context& context) const {
  std::vector<double> w(size());
  for_places(tree_, points_, strengths(area_normals), context,
             [&](std::size_t i, const float* at, const GaussSources& sources) {
               w[i] = gauss_value(sources, at) / kFourPi;
             });
  return w;
}

std::vector<Vec3> GaussField::adjoint(std::span<const double> r, const Context& context) const {
  std::vector<Vec3> charges(r.size()), result(size());
  for (std::size_t i = 0; i < r.size(); ++i) charges[i].x = r[i];
  for_places(tree_, points_, strengths(charges), context,
             [&](std::size_t i, const float* at, const GaussSources& sources) {
               float sum[3];
               gauss_adjoint(sources, at, width2_[i], sum);
               result[i] = Vec3{sum[0], sum[1], sum[2]} / -kFourPi;
             });
  return result;
}

std::vector<Vec3> GaussField::fall(std::span<const Vec3> area_normals,
                                   const Context& context) const {
  std::vector<Vec3> result(size());
  for_places(tree_, points_, strengths(area_normals), context,
             [&](std::size_t i, const float* at, const GaussSources& sources) {
               float sum[3];
               gauss_fall(sources, at, width2_[i], sum);
               result[i] = Vec3{sum[0], sum[1], sum[2]} / kFourPi;
             });
  return result;
}

std::vector<Vec3> GaussField::fall_at(const PointTree& tree, std::span<const Vec3> places,
                                      std::span<const double> widths,
                                      std::span<const Vec3> area_normals,
                                      const Context& context) const {
  std::vector<std::array<float, 3>> local(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) local[i] = single(places[i]);
  std::vector<Vec3> result(places.size());
  for_places(tree, local, strengths(area_normals), context,
             [&](std::size_t i, const float* at, const GaussSources& sources) {
               float sum[3];
               gauss_fall(sources, at, squared(widths[i]), sum);
               result[i] = Vec3{sum[0], sum[1], sum[2]} / kFourPi;
             });
  return result;
}

}  // namespace rholm
