#include "shape/queries/winding_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/cancel.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/queries/morton.h"

namespace rholm {
namespace {

using std::numbers::pi;

// Measured (scripts/constants): the times of 4 to 16 are within a tenth of each other.
constexpr std::uint32_t kLeafSize = 8;
// Least radius of a patch, relative to the points' extent. A patch of area zero has the term 0 /
// radius^3, which must not become 0 / 0.
constexpr double kLeastRadius = 1e-30;
// Number of queries evaluated at a time; a multiple of any vector's length.
constexpr std::size_t kGrain = 1024;
constexpr std::size_t kSorted = 4096;            // chosen
constexpr std::size_t kNodesPerQuestion = 4096;  // between two cancel checks

void check_finite(std::span<const Vec3> vectors, const char* what) {
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (is_finite(vectors[i])) continue;
    throw Error(ErrorCode::kInvalidInput,
                std::string(what) + " " + std::to_string(i) + " is not finite: remove it");
  }
}

// Returns the form (a . r) (b . r).
QuadraticForm product(const Vec3& a, const Vec3& b) {
  return {a.x * b.x,
          a.y * b.y,
          a.z * b.z,
          a.x * b.y + a.y * b.x,
          a.x * b.z + a.z * b.x,
          a.y * b.z + a.z * b.y};
}

// Returns the form p(r) (b . r).
CubicForm product(const QuadraticForm& p, const Vec3& b) {
  return {p[0] * b.x,
          p[1] * b.y,
          p[2] * b.z,
          p[0] * b.y + p[3] * b.x,
          p[0] * b.z + p[4] * b.x,
          p[1] * b.x + p[3] * b.y,
          p[1] * b.z + p[5] * b.y,
          p[2] * b.x + p[4] * b.z,
          p[2] * b.y + p[5] * b.z,
          p[3] * b.z + p[4] * b.y + p[5] * b.x};
}

template <typename Form>
void add(Form& sum, const Form& form, double factor = 1) {
  for (std::size_t k = 0; k < form.size(); ++k) sum[k] += factor * form[k];
}

// Adds moments that are moved from centre + offset to the centre: sum a (o + offset)
// and sum a (o + offset)^2.
void add_moments(WindingNode& sum, const WindingNode& part, const Vec3& offset) {
  const QuadraticForm moved = product(part.area_normal, offset);
  sum.area_normal += part.area_normal;
  add(sum.first, part.first);
  add(sum.first, moved);
  add(sum.second, part.second);
  add(sum.second, product(part.first, offset), 2);
  add(sum.second, product(moved, offset));
}

Vec3 laplacian(const CubicForm& q) {
  return {6 * q[0] + 2 * (q[5] + q[7]), 6 * q[1] + 2 * (q[3] + q[8]), 6 * q[2] + 2 * (q[4] + q[6])};
}

}  // namespace

WindingTree::WindingTree(std::span<const Vec3> points, std::span<const Vec3> area_normals) {
  check_finite(points, "point");
  std::vector<Vec3> local(points.begin(), points.end());
  const Bounds box = bounds(local);
  middle_ = 0.5 * box.min + 0.5 * box.max;
  const Vec3 half = box.max - middle_;
  const double extent = std::max({half.x, half.y, half.z});
  scale_ = extent > 0 ? 1 / extent : 1;
  for (Vec3& p : local) p = scale_ * (p - middle_);
  const std::vector<Key> keys = sorted_keys(local, {.threads = 1});
  order_.resize(keys.size());
  points_.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    order_[i] = keys[i].index;
    points_[i].at = local[keys[i].index];
  }
  nodes_.reserve(keys.size() / 2);  // a third for surfaces; unused memory is not touched
  if (!keys.empty()) split(keys, 0, static_cast<std::uint32_t>(keys.size()), kMortonLevels);
  set_area_normals(area_normals);
}

std::vector<WindingTree::Key> WindingTree::sorted_keys(std::span<const Vec3> local,
                                                       const Context& context) {
  std::vector<Key> keys(local.size());
  const auto before = [](const Key& a, const Key& b) {
    return a.morton != b.morton ? a.morton < b.morton : a.index < b.index;
  };
  const auto at = [&](std::size_t i) { return keys.begin() + static_cast<std::ptrdiff_t>(i); };
  // Sorts parts, then merges pairs of parts.
  parallel_for(keys.size(), kSorted, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      keys[i] = {morton(local[i]), static_cast<std::uint32_t>(i)};
    }
    std::sort(at(begin), at(end), before);
  });
  for (std::size_t half = kSorted; half < keys.size(); half *= 2) {
    parallel_for(keys.size(), 2 * half, context, {}, [&](std::size_t begin, std::size_t end) {
      if (begin + half < end) std::inplace_merge(at(begin), at(begin + half), at(end), before);
    });
  }
  return keys;
}

// Appends the node of points begin ... end - 1, whose keys agree above 3 `level` bits, and the
// nodes below it. A node with only one child is omitted.
void WindingTree::split(std::span<const Key> keys, std::uint32_t begin, std::uint32_t end,
                        int level) {
  const auto digit = [&](std::uint32_t i) { return keys[i].morton >> 3 * (level - 1) & 7; };
  const bool leaf = end - begin <= kLeafSize || level == 0;
  if (!leaf && digit(begin) == digit(end - 1)) return split(keys, begin, end, level - 1);
  const std::size_t self = nodes_.size();
  if (self % kNodesPerQuestion == 0) ask_cancel();
  WindingNode node;
  node.begin = begin;
  node.end = end;
  node.leaf = leaf;
  nodes_.push_back(node);
  while (!leaf && begin < end) {
    std::uint32_t next = begin;
    while (next < end && digit(next) == digit(begin)) ++next;
    split(keys, begin, next, level - 1);
    begin = next;
  }
  WindingNode& done = nodes_[self];
  done.skip = static_cast<std::uint32_t>(nodes_.size());
  for (std::size_t j = done.begin; j < done.end; ++j) done.center += points_[j].at;
  done.center = done.center / (done.end - done.begin);
}

void WindingTree::set_area_normals(std::span<const Vec3> area_normals) {
  if (area_normals.size() != points_.size()) {
    throw Error(ErrorCode::kInvalidInput, std::to_string(area_normals.size()) +
                                              " normals were given for " +
                                              std::to_string(points_.size()) + " points");
  }
  check_finite(area_normals, "normal");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3 a = scale_ * (scale_ * area_normals[order_[i]]);
    points_[i].area_normal = a;
    points_[i].least2 = std::max(norm(a) / pi, kLeastRadius * kLeastRadius);
  }
  sum_moments();
}

// Radii include the patches, because the far field does not hold within a patch.
void WindingTree::sum_moments() {
  CancelPoll poll;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    poll();
    WindingNode& node = nodes_[i];
    node.area_normal = {};
    node.first = {};
    node.second = {};
    node.radius = 0;
    const auto add_part = [&](const WindingNode& part) {
      const Vec3 offset = part.center - node.center;
      add_moments(node, part, offset);
      node.radius = std::max(node.radius, norm(offset) + part.radius);
    };
    if (node.leaf) {
      for (std::size_t j = node.begin; j < node.end; ++j) {
        WindingNode point;
        point.center = points_[j].at;
        point.area_normal = points_[j].area_normal;
        point.radius = std::sqrt(points_[j].least2);
        add_part(point);
      }
    } else {
      for (std::size_t c = i + 1; c < node.skip; c = nodes_[c].skip) add_part(nodes_[c]);
    }
    node.second_laplacian = laplacian(node.second);
  }
}

WindingTree WindingTree::top(int levels) const {
  WindingTree kept;
  kept.middle_ = middle_, kept.scale_ = scale_;
  struct Parent {
    std::size_t kept, end;  // index in `kept`, and the first node here that is not below it
  };
  std::vector<Parent> parents;
  const auto close = [&](std::size_t at) {
    while (!parents.empty() && parents.back().end <= at) {
      kept.nodes_[parents.back().kept].skip = static_cast<std::uint32_t>(kept.nodes_.size());
      parents.pop_back();
    }
  };
  for (std::size_t i = 0; i < nodes_.size();) {
    close(i);
    const WindingNode& node = nodes_[i];
    const bool is_last = node.leaf || parents.size() == static_cast<std::size_t>(levels);
    parents.push_back({kept.nodes_.size(), node.skip});
    kept.nodes_.push_back(node);
    kept.nodes_.back().leaf = false;
    kept.nodes_.back().begin = kept.nodes_.back().end = 0;
    if (is_last) kept.left_out_.push_back({node.center, node.radius});
    i = is_last ? node.skip : i + 1;
  }
  close(nodes_.size());
  return kept;
}

bool WindingTree::has_all(const Vec3& x, double opening) const {
  // Rounding must not decide: places within this margin are evaluated in the whole tree.
  constexpr double kMargin = 1 + 1e-9;
  const Vec3 local = scale_ * (x - middle_);
  return std::none_of(left_out_.begin(), left_out_.end(), [&](const WindingBall& ball) {
    return norm(local - ball.center) <= kMargin * opening * ball.radius;
  });
}

WindingNumbers WindingTree::numbers(const Context& context) const {
  return [this, context](std::span<const Vec3> x, double opening) {
    return winding(x, context, opening);
  };
}

std::vector<double> WindingTree::winding(std::span<const Vec3> x, const Context& context,
                                         double opening) const {
  std::vector<Vec3> local(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) local[i] = scale_ * (x[i] - middle_);
  // Sorts the queries, because near queries walk through the tree together.
  const std::vector<Key> keys = sorted_keys(local, context);
  std::vector<double> result(x.size());
  parallel_for(x.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3> at;
    for (std::size_t i = begin; i < end; ++i) at.push_back(local[keys[i].index]);
    std::vector<double> sums(at.size());
    sum_winding(nodes_, points_, at, opening, sums.data());
    for (std::size_t i = begin; i < end; ++i) {
      result[keys[i].index] = sums[i - begin] / (4 * pi);
    }
  });
  return result;
}

}  // namespace rholm
