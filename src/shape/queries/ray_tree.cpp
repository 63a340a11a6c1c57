// Traces rays without Embree: through boxes of a TriangleTree, and triangles as Woop, Benthin, Wald
// do (Watertight Ray/Triangle Intersection, Journal of Computer Graphics Techniques 2, 2013).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "shape/queries/ray_scene.h"
#include "shape/queries/triangle_tree.h"

namespace rholm {
namespace {

using Components = std::array<double, 3>;

constexpr float kRounding = 0x1p-24F;  // relative rounding of a float
// Farther away, float boxes cannot separate triangles, and every triangle is tried. Products in
// enter_boxes() stay below 2^128.
constexpr double kFarthest = 0x1p50;

Components components(const Vec3& v) { return {v.x, v.y, v.z}; }

float to_float(double x) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -kLargest, kLargest));
}

struct Span {
  float near = 0, far = 0;  // distances in the frame: near < t <= far
};

Span span_of(double near, double far, double scale) {
  return {to_float(std::max(near * scale, 0.0)), to_float(far * scale)};
}

struct Hit {
  float distance = 0, u = 0, v = 0;
};

// --- What a ray meets ----------------------------------------------------------------------

// Shears space so that the ray is along an axis. Edges become lines in a plane, and the origin
// lies on one of their sides.
class TriangleRay {
 public:
  TriangleRay(const Vec3& origin, const Vec3& direction) : origin_(origin) {
    const Components d = components(direction);
    const auto longer = [&](std::size_t a, std::size_t b) {
      return std::abs(d[a]) < std::abs(d[b]);
    };
    z_ = std::max({std::size_t{0}, std::size_t{1}, std::size_t{2}}, longer);
    x_ = (z_ + 1) % 3, y_ = (z_ + 2) % 3;
    shear_x_ = d[x_] / d[z_], shear_y_ = d[y_] / d[z_], scale_z_ = 1 / d[z_];
  }

  // Takes corners in the frame. A ray through an edge meets both of its triangles, a ray through a
  // vertex all of them, and a ray in a triangle's plane none.
  std::optional<Hit> meet(const std::array<Vec3, 3>& corners, const Span& span) const {
    const Sheared a = sheared(corners[0]), b = sheared(corners[1]), c = sheared(corners[2]);
    // Products of floats are exact in double, so their difference has the right sign. It is
    // opposite for the triangle beyond the edge: no ray slips through.
    const double u = c.x * b.y - c.y * b.x;
    const double v = a.x * c.y - a.y * c.x;
    const double w = b.x * a.y - b.y * a.x;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return std::nullopt;
    const double sum = u + v + w;
    const double t = (u * a.z + v * b.z + w * c.z) / sum;
    if (sum == 0 || !std::isfinite(t)) return std::nullopt;
    const auto distance = static_cast<float>(t);
    if (!(distance > span.near && distance <= span.far)) return std::nullopt;
    return Hit{distance, static_cast<float>(v / sum), static_cast<float>(w / sum)};
  }

 private:
  struct Sheared {
    double x, y, z;  // x and y are values of float
  };
  // Returns the same bits for a vertex in every triangle.
  Sheared sheared(const Vec3& corner) const {
    const Components p = components(corner - origin_);
    return {static_cast<float>(p[x_] - shear_x_ * p[z_]),
            static_cast<float>(p[y_] - shear_y_ * p[z_]), scale_z_ * p[z_]};
  }

  Vec3 origin_;
  std::size_t x_, y_, z_;
  double shear_x_, shear_y_, scale_z_;
};

std::optional<Hit> meet_ball(const Vec3& origin, const Vec3& direction, const Vec3& center,
                             double radius, const Span& span) {
  const Vec3 to_center = center - origin;
  const double length2 = dot(direction, direction);
  const double along = dot(to_center, direction) / length2;
  const Vec3 off = to_center - along * direction;
  const double chord2 = (radius * radius - dot(off, off)) / length2;
  if (!(chord2 >= 0)) return std::nullopt;
  const double half = std::sqrt(chord2);
  for (const double t : {along - half, along + half}) {
    const auto distance = static_cast<float>(t);
    if (distance > span.near && distance <= span.far) return Hit{distance, 0, 0};
  }
  return std::nullopt;
}

// --- The walk ------------------------------------------------------------------------------

// A ray for tests of boxes. Box, origin and their difference have each a rounding of their moduli:
// boxes grow by twice their sum. Quotients have three relative roundings.
struct BoxRay {
  BoxRay(const Vec3& at, const Vec3& direction, double radius) {
    const Components o = components(at), d = components(direction);
    double largest = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      constexpr double kLeast = 1e-18;  // chosen: a smaller slope changes no box
      const double slope = std::copysign(std::max(std::abs(d[axis]), kLeast), d[axis]);
      origin[axis] = static_cast<float>(o[axis]);
      inverse[axis] = static_cast<float>(1 / slope);
      largest = std::max(largest, std::abs(o[axis]));
    }
    margin = static_cast<float>(radius + 8 * kRounding * (1 + largest));
  }
  std::array<float, 3> origin, inverse;
  float margin;
};

constexpr float kSlack = 1 + 8 * kRounding;

// Computes where the ray enters and leaves each box.
void enter_boxes(const BoxGroup& group, const BoxRay& ray, const Span& span, TreeRow& enter,
                 TreeRow& leave) {
  enter.fill(span.near);
  leave.fill(span.far);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float low_shift = ray.origin[axis] + ray.margin;
    const float high_shift = ray.origin[axis] - ray.margin;
    const float inverse = ray.inverse[axis];
    for (std::size_t k = 0; k < kTreeWidth; ++k) {
      const float a = (group.low[axis][k] - low_shift) * inverse;
      const float b = (group.high[axis][k] - high_shift) * inverse;
      enter[k] = std::max(enter[k], std::min(a, b));
      leave[k] = std::min(leave[k], std::max(a, b));
    }
  }
}

// Calls visit(leaf) for leaves that the ray may meet, usually near ones first.
// `visit` may reduce span.far.
template <typename Visit>
void walk(const TriangleTreeNodes& tree, const BoxRay& ray, Span& span, const Visit& visit) {
  struct Waiting {
    float enter;
    std::uint32_t node;
  };
  constexpr std::size_t kMostLevels = 11;  // 8^11 = 2^33 triangles
  std::array<Waiting, kMostLevels * kTreeWidth> stack;
  std::size_t n = 0;
  const std::size_t leaves = tree.leaves.size();
  stack[n++] = {0, static_cast<std::uint32_t>(leaves + tree.inner.size() - 1)};
  while (n > 0) {
    const Waiting at = stack[--n];
    if (at.enter > span.far * kSlack) continue;
    if (at.node < leaves) {
      visit(at.node);
      continue;
    }
    const BoxGroup& group = tree.inner[at.node - leaves];
    TreeRow enter, leave;
    enter_boxes(group, ray, span, enter, leave);
    const std::size_t first = n;
    for (std::uint32_t k = 0; k < kTreeWidth; ++k) {
      if (group.low[0][k] == kFloatInfinity) break;  // missing boxes are the last ones
      if (enter[k] > leave[k] * kSlack) continue;
      std::size_t i = n++;  // keeps the nearest on top
      for (; i > first && stack[i - 1].enter < enter[k]; --i) stack[i] = stack[i - 1];
      stack[i] = {enter[k], group.first + k};
    }
  }
}

// Returns a mesh with a triangle of size zero at each vertex.
Mesh points_of(const Mesh& mesh) {
  Mesh points;
  points.vertices = mesh.vertices;
  points.faces.reserve(mesh.vertices.size());
  for (std::uint32_t k = 0; k < mesh.vertices.size(); ++k) points.faces.push_back({k, k, k});
  return points;
}

}  // namespace

struct RayScene::Impl {
  const Mesh& mesh;
  const UnitFrame& frame;
  double radius;  // radius of balls in the frame; 0 for triangles
  Mesh centers;
  std::optional<TriangleTree> tree;  // empty if there is nothing to meet

  Impl(const Mesh& m, const UnitFrame& f, int threads, double ball_radius)
      : mesh(m), frame(f), radius(ball_radius * f.scale) {
    if (ball_radius > 0) centers = points_of(m);
    const Mesh& held = ball_radius > 0 ? centers : mesh;
    if (!held.faces.empty())
      tree.emplace(held, frame, PortionNumbers{}, Context{.threads = threads});
  }

  // Calls take(number, hit) for all hits within the span, which `take` may shorten.
  template <typename Take>
  void for_each_hit(const Vec3& origin, const Vec3& direction, Span& span, const Take& take) const {
    const Vec3 q = frame.to_local(origin);
    if (!tree || !is_finite(q) || !is_finite(direction)) return;
    const TriangleRay ray(q, direction);
    const auto try_one = [&](std::uint32_t k) {
      const std::optional<Hit> hit =
          radius > 0 ? meet_ball(q, direction, frame.to_local(mesh.vertices[k]), radius, span)
                     : ray.meet(corners(mesh.faces[k]), span);
      if (hit) take(k, *hit);
    };
    if (!(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) < kFarthest)) {
      const std::size_t n = radius > 0 ? mesh.vertices.size() : mesh.faces.size();
      for (std::uint32_t k = 0; k < n; ++k) try_one(k);
      return;
    }
    const std::span<const std::uint32_t> order = tree->order();
    walk(tree->nodes(), BoxRay(q, direction, radius), span, [&](std::uint32_t leaf) {
      const auto numbers = order.subspan(leaf * kTreeWidth, kTreeWidth);
      for (std::size_t k = 0; k < kTreeWidth; ++k) {
        if (k > 0 && numbers[k] == numbers[k - 1]) break;  // the last triangle repeated
        try_one(numbers[k]);
      }
    });
  }

  std::array<Vec3, 3> corners(const Triangle& t) const {
    return {frame.to_local(mesh.vertices[t[0]]), frame.to_local(mesh.vertices[t[1]]),
            frame.to_local(mesh.vertices[t[2]])};
  }
};

RayScene::RayScene(const Mesh& mesh, const Context& context, double ball_radius, RayTree)
    : mesh_(mesh),
      frame_(ray_frame(mesh, ball_radius)),
      impl_(std::make_unique<Impl>(mesh, frame_, context.threads, ball_radius)) {}
RayScene::~RayScene() = default;

RayHit RayScene::first_hit(const Vec3& origin, const Vec3& direction, double near,
                           double far) const {
  Span span = span_of(near, far, frame_.scale);
  RayHit first;
  impl_->for_each_hit(origin, direction, span, [&](std::uint32_t k, const Hit& hit) {
    // If several have the same distance (a shared edge), the smallest index wins.
    if (first.hit && hit.distance == span.far && k > first.triangle) return;
    span.far = hit.distance;
    first = {true, k, hit.u, hit.v, hit.distance / frame_.scale};
  });
  return first;
}

bool RayScene::occluded(const Vec3& origin, const Vec3& direction, double near, double far) const {
  Span span = span_of(near, far, frame_.scale);
  bool found = false;
  impl_->for_each_hit(origin, direction, span, [&](std::uint32_t, const Hit&) {
    found = true;
    span.far = -1;  // no box is so near: ends the walk
  });
  return found;
}

std::vector<RayHit> RayScene::first_hits(std::span<const Ray> rays) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<RayHit> hits;
  hits.reserve(rays.size());
  for (const Ray& ray : rays) hits.push_back(first_hit(ray.origin, ray.direction, 0, kInfinity));
  return hits;
}

std::vector<bool> RayScene::occluded(std::span<const Ray> rays) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<bool> found;
  found.reserve(rays.size());
  for (const Ray& ray : rays) found.push_back(occluded(ray.origin, ray.direction, 0, kInfinity));
  return found;
}

std::vector<std::uint32_t> RayScene::triangles_met(const Vec3& origin,
                                                   const Vec3& direction) const {
  Span span = span_of(0, std::numeric_limits<double>::infinity(), frame_.scale);
  std::vector<std::uint32_t> met;
  impl_->for_each_hit(origin, direction, span,
                      [&](std::uint32_t k, const Hit&) { met.push_back(k); });
  return met;
}

}  // namespace rholm
