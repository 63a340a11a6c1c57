#include "shape/make/sample_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "shape/make/surface_places.h"
#include "shape/points/plane_fit.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

// This part finds points along the curves in which planes cut a surface.

// The plane of all points x with normal . x = height.
struct Plane {
  Vec3 normal;  // unit
  double height = 0;
};

// Cuts a surface. Keeps a reference to it. Vertices at one place count as one vertex.
class PlaneCutter {
 public:
  explicit PlaneCutter(const SampledSurface& surface);

  // Returns places at equal steps of about `step` along each curve, at least one per curve. The
  // first place is random. Coordinates are in frames of the surface.
  std::vector<SurfacePlace> places(const Plane& plane, double step, RandomStream& random) const;

 private:
  const SampledSurface& surface_;
  std::vector<std::uint32_t> vertex_;  // for each vertex of the mesh: the first at its place
};

// An end of a cut through a triangle, on one of its edges.
struct End {
  std::uint64_t edge = 0;  // smaller vertex << 32 | larger
  std::array<double, 3> weights = {};
};

struct Segment {
  std::size_t triangle = 0;
  std::array<End, 2> ends;
  double length = 0;
};

// An end, sorted by edge to find the segments that meet there.
struct Meeting {
  std::uint64_t edge;
  std::uint32_t segment;
  int end;
};

// A segment that is traversed from one end to the other.
struct Step {
  std::uint32_t segment;
  bool backwards;
};

class Curves {
 public:
  explicit Curves(std::vector<Segment> segments)
      : segments_(std::move(segments)), used_(segments_.size(), 0) {
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      for (int e = 0; e < 2; ++e) meetings_.push_back({segments_[s].ends[e].edge, s, e});
    }
    std::sort(meetings_.begin(), meetings_.end(), [](const Meeting& a, const Meeting& b) {
      return a.edge != b.edge ? a.edge < b.edge : a.segment < b.segment;
    });
  }

  // Calls visit(curve) for all curves, open ones first.
  template <typename Visit>
  void for_each(const Visit& visit) {
    for (const bool closed : {false, true}) {
      for (std::uint32_t s = 0; s < segments_.size(); ++s) {
        for (const int e : {0, 1}) {
          if (used_[s] || (!closed && count(segments_[s].ends[e].edge) != 1)) continue;
          visit(follow({s, e == 1}));
        }
      }
    }
  }
  const Segment& operator[](std::uint32_t s) const { return segments_[s]; }

 private:
  std::pair<std::size_t, std::size_t> range(std::uint64_t edge) const {
    const auto [begin, end] =
        std::equal_range(meetings_.begin(), meetings_.end(), Meeting{edge, 0, 0},
                         [](const Meeting& a, const Meeting& b) { return a.edge < b.edge; });
    return {begin - meetings_.begin(), end - meetings_.begin()};
  }
  std::size_t count(std::uint64_t edge) const {
    const auto [begin, end] = range(edge);
    return end - begin;
  }

  std::vector<Step> follow(Step step) {
    std::vector<Step> curve;
    for (;;) {
      used_[step.segment] = 1;
      curve.push_back(step);
      const End& end = segments_[step.segment].ends[step.backwards ? 0 : 1];
      const auto [from, to] = range(end.edge);
      const auto next = std::find_if(meetings_.begin() + static_cast<std::ptrdiff_t>(from),
                                     meetings_.begin() + static_cast<std::ptrdiff_t>(to),
                                     [&](const Meeting& m) { return used_[m.segment] == 0; });
      if (next == meetings_.begin() + static_cast<std::ptrdiff_t>(to)) return curve;
      step = {next->segment, next->end == 1};
    }
  }

  std::vector<Segment> segments_;
  std::vector<char> used_;
  std::vector<Meeting> meetings_;
};

PlaneCutter::PlaneCutter(const SampledSurface& surface)
    : surface_(surface), vertex_(first_identical(surface.mesh().vertices)) {}

std::vector<SurfacePlace> PlaneCutter::places(const Plane& plane, double step,
                                              RandomStream& random) const {
  std::vector<Segment> segments;
  CancelPoll poll;
  for (std::size_t t = 0; t < surface_.mesh().faces.size(); ++t) {
    poll();
    const auto corners = surface_.corners(t);
    std::array<double, 3> height;
    for (int k = 0; k < 3; ++k) height[k] = dot(corners[k], plane.normal) - plane.height;
    const int above = (height[0] >= 0) + (height[1] >= 0) + (height[2] >= 0);
    if (above == 0 || above == 3 || surface_.twice_area(t) == Vec3{}) continue;
    Segment segment{.triangle = t, .ends = {}};
    int n = 0;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      if ((height[k] >= 0) == (height[l] >= 0)) continue;
      const std::uint64_t a = vertex_[surface_.mesh().faces[t][k]],
                          b = vertex_[surface_.mesh().faces[t][l]];
      End& end = segment.ends[n++];
      end.edge = std::min(a, b) << 32 | std::max(a, b);
      end.weights[k] = height[l] / (height[l] - height[k]);
      end.weights[l] = 1 - end.weights[k];
    }
    segment.length = norm(surface_.place(t, segment.ends[1].weights).point -
                          surface_.place(t, segment.ends[0].weights).point);
    segments.push_back(segment);
  }
  Curves curves(std::move(segments));
  std::vector<SurfacePlace> places;
  curves.for_each([&](const std::vector<Step>& curve) {
    double length = 0;
    for (const Step& s : curve) length += curves[s.segment].length;
    const double n = std::max(1.0, std::round(length / step));
    double next = random.uniform() * length / n, passed = 0;  // positions along the curve
    for (const Step& s : curve) {
      const Segment& segment = curves[s.segment];
      for (; next < passed + segment.length; next += length / n) {
        const double part = (next - passed) / segment.length;
        const double to = s.backwards ? 1 - part : part;
        std::array<double, 3> weights;
        for (int k = 0; k < 3; ++k) {
          weights[k] = (1 - to) * segment.ends[0].weights[k] + to * segment.ends[1].weights[k];
        }
        places.push_back(surface_.place(segment.triangle, weights));
      }
      passed += segment.length;
    }
  });
  return places;
}

using std::numbers::pi;

// Streams of random numbers that differ from all streams of points.
constexpr std::uint64_t kOffsetStream = ~std::uint64_t{1}, kCutStream = std::uint64_t{1} << 62;
// Least distance of a place from the axis of rings, relative to the mean distance.
constexpr double kOnAxis = 1e-3;

// Returns the integral of f(triangle, normal) over the area.
template <typename F>
double integrate(const SampledSurface& surface, const F& f) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.mesh().faces.size(); ++t) {
    const Vec3 twice = surface.twice_area(t);
    const double area = norm(twice) / 2;
    if (area > 0) sum += area * f(t, twice / (2 * area));
  }
  return sum;
}

double sine(double cosine) { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }

Vec3 centroid(const SampledSurface& surface, std::size_t triangle) {
  const auto [a, b, c] = surface.corners(triangle);
  return (a + b + c) / 3;
}

// Returns the places found at all planes, in their order.
std::vector<SurfacePlace> cut_all(const SampledSurface& surface, const std::vector<Plane>& planes,
                                  double step, std::uint64_t seed, const Context& context) {
  const PlaneCutter cutter(surface);
  std::vector<std::vector<SurfacePlace>> found(planes.size());
  parallel_for(planes.size(), 1, context, {.name = "sample"},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   RandomStream random(seed, kCutStream + i);
                   found[i] = cutter.places(planes[i], step, random);
                 }
               });
  std::vector<SurfacePlace> all;
  for (auto& places : found) all.insert(all.end(), places.begin(), places.end());
  return all;
}

// Returns the number of planes about `step` apart on a `length`; at most one per point.
std::size_t n_planes(double length, double step, std::size_t points) {
  constexpr double kMost = 1e6;  // chosen: each plane is a pass over the triangles
  const double most = std::min(kMost, static_cast<double>(points));
  return static_cast<std::size_t>(std::clamp(std::round(length / step), 1.0, most));
}

// Cuts by planes across the axis, H apart. At an angle with sine s, an area has s / H of curve.
std::vector<SurfacePlace> slices(const SampledSurface& surface, const SampleOptions& options,
                                 const Context& context) {
  const Vec3 axis = pattern_frame(options).axis;
  const double curves =
      integrate(surface, [&](std::size_t, const Vec3& n) { return sine(dot(n, axis)); });
  if (!(curves > 0)) return {};  // the surface is perpendicular to the axis everywhere
  const double along =
      std::sqrt(curves / (static_cast<double>(options.points) * options.pattern_ratio));
  double low = dot(surface.middle(), axis), high = low;
  for (const Vec3& vertex : surface.mesh().vertices) {
    const double height = dot(surface.frame().to_local(vertex), axis);
    low = std::min(low, height), high = std::max(high, height);
  }
  RandomStream random(options.seed, kOffsetStream);
  const std::size_t n = n_planes(high - low, options.pattern_ratio * along, options.points);
  const double step = (high - low) / static_cast<double>(n), offset = low + random.uniform() * step;
  std::vector<Plane> planes(n);
  for (std::size_t i = 0; i < n; ++i) planes[i] = {axis, offset + static_cast<double>(i) * step};
  return cut_all(surface, planes, along, options.seed, context);
}

// Cuts by planes through the axis, at equal angles; the ratio holds at the mean distance from it.
std::vector<SurfacePlace> rings(const SampledSurface& surface, const SampleOptions& options,
                                const Context& context) {
  const PatternFrame frame = pattern_frame(options);
  const auto distance = [&](std::size_t t) {
    const Vec3 from = centroid(surface, t) - surface.middle();
    return std::hypot(dot(from, frame.u), dot(from, frame.v));
  };
  const auto across = [&](std::size_t t, const Vec3& n) {
    const Vec3 from = centroid(surface, t) - surface.middle();
    const Vec3 around = cross(frame.axis, from);
    const double length = norm(around);
    return length > 0 ? sine(dot(n, around) / length) : 1.0;
  };
  const double curves = integrate(surface, across);
  if (!(curves > 0)) return {};  // the surface lies in planes through the axis
  const double mean_distance =
      integrate(surface, [&](std::size_t t, const Vec3&) { return distance(t); }) / surface.area();
  const double per_distance = integrate(surface, [&](std::size_t t, const Vec3& n) {
    return across(t, n) / std::max(distance(t), kOnAxis * mean_distance);
  });
  const double typical = curves / per_distance;
  const double along =
      std::sqrt(curves / (static_cast<double>(options.points) * options.pattern_ratio));
  RandomStream random(options.seed, kOffsetStream);
  const std::size_t n = n_planes(pi * typical, options.pattern_ratio * along, options.points);
  const double offset = random.uniform();
  std::vector<Plane> planes(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = pi * (static_cast<double>(i) + offset) / static_cast<double>(n);
    const Vec3 normal = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    planes[i] = {normal, dot(surface.middle(), normal)};
  }
  return cut_all(surface, planes, along, options.seed, context);
}

// A grid of lines along `through`, with steps along `fine` and `coarse`.
struct LineGrid {
  Vec3 through, fine, coarse;
};

using Corners = std::array<std::array<double, 2>, 3>;

// Returns the least and the largest x at which the line of constant y meets a triangle.
std::pair<double, double> on_row(const Corners& p, double y) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int k = 0; k < 3; ++k) {
    const auto &from = p[k], &to = p[(k + 1) % 3];
    if ((from[1] - y) * (to[1] - y) > 0) continue;
    const double rise = to[1] - from[1];
    const double x = rise == 0 ? to[0] : from[0] + (y - from[1]) / rise * (to[0] - from[0]);
    low = std::min(low, x), high = std::max(high, x);
    if (rise == 0) low = std::min(low, from[0]), high = std::max(high, from[0]);
  }
  return {low, high};
}

// Adds the places where lines of a grid meet a triangle that faces this grid most.
void add_grid_places(const SampledSurface& surface, std::size_t triangle, const LineGrid& grid,
                     double fine, double coarse, const std::array<double, 2>& offset,
                     std::vector<SurfacePlace>& places) {
  const auto corners = surface.corners(triangle);
  Corners p;  // in steps
  for (int k = 0; k < 3; ++k) {
    p[k] = {dot(corners[k], grid.fine) / fine - offset[0],
            dot(corners[k], grid.coarse) / coarse - offset[1]};
  }
  const auto area = [](const auto& a, const auto& b, const auto& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  };
  const double whole = area(p[0], p[1], p[2]);
  if (whole == 0) return;
  const auto [low_y, high_y] = std::minmax({p[0][1], p[1][1], p[2][1]});
  for (double y = std::ceil(low_y); y <= high_y; ++y) {
    const auto [low_x, high_x] = on_row(p, y);
    for (double x = std::ceil(low_x); x <= high_x; ++x) {
      const std::array<double, 2> at{x, y};
      const double w0 = area(at, p[1], p[2]) / whole, w1 = area(p[0], at, p[2]) / whole;
      if (w0 < 0 || w1 < 0 || w0 + w1 > 1) continue;
      places.push_back(surface.place(triangle, {w0, w1, 1 - w0 - w1}));
    }
  }
}

// Cuts by lines along three axes; each triangle uses the lines that it faces most.
std::vector<SurfacePlace> grids(const SampledSurface& surface, const SampleOptions& options,
                                const Context& context) {
  const PatternFrame frame = pattern_frame(options);
  const std::array<LineGrid, 3> along = {LineGrid{frame.axis, frame.u, frame.v},
                                         LineGrid{frame.u, frame.v, frame.axis},
                                         LineGrid{frame.v, frame.u, frame.axis}};
  const auto facing = [&](const Vec3& n) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (std::abs(dot(n, along[k].through)) > std::abs(dot(n, along[most].through))) most = k;
    }
    return most;
  };
  const double seen = integrate(surface, [&](std::size_t, const Vec3& n) {
    return std::abs(dot(n, along[facing(n)].through));
  });
  const double fine =
      std::sqrt(seen / (static_cast<double>(options.points) * options.pattern_ratio));
  RandomStream random(options.seed, kOffsetStream);
  const std::array<double, 2> offset{random.uniform(), random.uniform()};
  const std::size_t n = surface.mesh().faces.size();
  constexpr std::size_t kGrain = 1024;
  std::vector<std::vector<SurfacePlace>> found((n + kGrain - 1) / kGrain);
  parallel_for(n, kGrain, context, {.name = "sample"}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3 twice = surface.twice_area(t);
      if (twice == Vec3{}) continue;
      add_grid_places(surface, t, along[facing(twice)], fine, options.pattern_ratio * fine, offset,
                      found[begin / kGrain]);
    }
  });
  std::vector<SurfacePlace> all;
  for (auto& places : found) all.insert(all.end(), places.begin(), places.end());
  return all;
}

}  // namespace

PatternFrame pattern_frame(const SampleOptions& options) {
  const Vec3 axis = normalized(options.pattern_axis);
  const Vec3 u = perpendicular(axis);
  return {axis, u, cross(axis, u)};
}

std::vector<SurfacePlace> pattern_places(const SampledSurface& surface,
                                         const SampleOptions& options, const Context& context) {
  if (options.pattern == SamplePattern::kSlices) return slices(surface, options, context);
  if (options.pattern == SamplePattern::kRings) return rings(surface, options, context);
  return grids(surface, options, context);
}

}  // namespace rholm
