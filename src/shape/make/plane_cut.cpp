#include "shape/make/plane_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/cancel.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

// Where a triangle is cut: from one of its edges to another.
struct End {
  std::uint64_t edge = 0;  // smaller vertex << 32 | larger
  std::array<double, 3> weights = {};
};
struct Segment {
  std::size_t triangle = 0;
  std::array<End, 2> ends;
  double length = 0;
};

// Ends sorted by edge, to find the segments that meet there.
struct Meeting {
  std::uint64_t edge;
  std::uint32_t segment;
  int end;
};

// A segment that is gone through from one end to the other.
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

  // Calls visit(curve) for all, those with ends first.
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

}  // namespace

PlaneCutter::PlaneCutter(const SampledSurface& surface)
    : surface_(surface), vertex_(first_identical(surface.mesh().vertices)) {}

std::vector<SurfacePlace> PlaneCutter::places(const Plane& plane, double step,
                                              RandomStream& random) const {
  std::vector<Segment> segments;
  CancelPoll poll;
  for (std::size_t t = 0; t < surface_.mesh().triangles.size(); ++t) {
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
      const std::uint64_t a = vertex_[surface_.mesh().triangles[t][k]],
                          b = vertex_[surface_.mesh().triangles[t][l]];
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
    double next = random.uniform() * length / n, passed = 0;  // along the curve
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

}  // namespace rholm
