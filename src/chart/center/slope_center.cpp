// Finds the point of least slope.
//
// A star-shaped surface has the radius r(u). The slope int |grad_S r|^2 dOmega is the sum over
// the degrees l of l(l+1) times the energy of degree l. So a radius of small slope has little
// energy in high degrees. A face at distance rho, whose plane is at distance d, has tan^2 gamma =
// rho^2 / d^2 - 1 and dOmega = d / rho^3 dA. Its part of the slope is int (rho / d - d / rho) dA.
//
// The point is sought on the line through the middle of the kernel and the centroid of the solid.
// Both points keep every symmetry of the body, and so do all points of the line.
//
// A sample of the faces gives a first guess. Passes over all faces then find the zero of the
// slope's derivative, so that the point does not depend on the order of the faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "chart/center/kernel.h"
#include "chart/center/slope_scan.h"

namespace rholm {
namespace {

// A point of a face, seen from middle + t way: d = d_0 - t d_way and rho^2 = rho2_0 - 2 t along +
// t^2 |way|^2.
struct SurfacePoint {
  double d_0, d_way;
  double rho2_0, along;
  double area;
};

// Returns the derivative of the slope at one place, as sum_rises() does for faces.
double rise_at(const std::vector<SurfacePoint>& points, const SlopeLine& line, double t) {
  const double way2 = dot(line.way, line.way), least = line.least;
  double rise = 0;
  for (const SurfacePoint& p : points) {
    const double d = std::max(p.d_0 - t * p.d_way, least), rho_rise = t * way2 - p.along;
    const double rho2 = std::max(p.rho2_0 - t * (p.along - rho_rise), least * least);
    // Formula: rho rho' (1 / (rho d) + d / rho^3) - d' (rho / d^2 + 1 / rho)
    rise += p.area * (rho2 + d * d) * (rho_rise * d + p.d_way * rho2) /
            (d * d * rho2 * std::sqrt(rho2));
  }
  return rise;
}

// Adds the middles of the side^2 parts into which kPieceSize divides a face.
void add_points(const LocalView& view, std::size_t triangle, const SlopeLine& line, double weight,
                std::vector<SurfacePoint>& points) {
  constexpr double kMostSides = 64;  // chosen: faces that need more are rare
  const FacePlane face = view.plane(triangle);
  if (!face.exists()) return;
  std::array<Vec3, 3> corners = view.corners(triangle);
  for (Vec3& corner : corners) corner -= view.frame.center + line.middle;
  const auto& [a, b, c] = corners;
  const double area = norm(cross(b - a, c - a)) / 2;
  const Vec3 middle = (a + b + c) / 3;
  const double sides = std::sqrt(area / (kPieceSize * dot(middle, middle)));
  const int side = static_cast<int>(std::clamp(std::round(sides), 1.0, kMostSides));
  const double part = weight * area / (side * side);
  const Vec3 along_b = (b - a) / side, along_c = (c - a) / side;
  const auto add = [&](const Vec3& m) {
    points.push_back({.d_0 = dot(face.normal, m),
                      .d_way = dot(face.normal, line.way),
                      .rho2_0 = dot(m, m),
                      .along = dot(m, line.way),
                      .area = part});
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side - i; ++j) {
      const Vec3 corner = a + i * along_b + j * along_c;
      add(corner + (along_b + along_c) / 3);
      if (i + j + 1 < side) add(corner + 2 * (along_b + along_c) / 3);
    }
  }
}

// Returns points of one random face out of every `step` faces. A fixed choice could always meet the
// same row of a lattice.
std::vector<SurfacePoint> sampled_points(const LocalView& view, const SlopeLine& line) {
  // Chosen: this many faces locate the least slope to some hundredths of the way.
  constexpr std::size_t kSampled = 1024;
  const std::size_t n = view.mesh.n_faces;
  const std::size_t step = std::max<std::size_t>(1, n / kSampled);
  std::vector<SurfacePoint> points;
  points.reserve(4 * kSampled);
  for (std::size_t first = 0; first < n; first += step) {
    const std::size_t room = std::min(step, n - first);
    const std::size_t t = first + static_cast<std::size_t>(random_bits(0, first) % room);
    add_points(view, t, line, static_cast<double>(room), points);
  }
  return points;
}

// Ends of the search, in units of the way. Chosen: it extends beyond the middle of the kernel, and
// beyond the centroid, by the distance between the two.
constexpr double kFirst = -1, kLast = 2;

// Returns where the slope of a sample stops falling, on the way down from the kernel's middle.
double guess(const std::vector<SurfacePoint>& sample, const SlopeLine& line) {
  constexpr double kStep = 0.25;  // chosen: no second minimum is narrower
  constexpr int kHalvings = 4;
  const double step = rise_at(sample, line, 0) < 0 ? kStep : -kStep;
  const auto falls = [&](double t) { return rise_at(sample, line, t) * step < 0; };
  double before = 0, beyond = step;
  while (beyond > kFirst && beyond < kLast && falls(beyond)) before = beyond, beyond += step;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = (before + beyond) / 2;
    (falls(t) ? before : beyond) = t;
  }
  return (before + beyond) / 2;
}

// Computes the derivative of the slope by t, over all faces.
class Slope {
 public:
  Slope(const LocalView& view, const SlopeLine& line, const Context& context)
      : view_(view), line_(line), context_(context) {}

  Rises rises(const Places& places, std::size_t n_places) {
    const std::size_t n = view_.mesh.n_faces, grain = triangle_grain(n);
    struct Part {
      Rises rises;
      std::vector<std::size_t> large;
    };
    std::vector<Part> parts((n + grain - 1) / grain);
    parallel_for(n, grain, context_, {}, [&](std::size_t begin, std::size_t end) {
      Part& part = parts[begin / grain];
      part.rises = sum_rises(view_, begin, end, line_, places, n_places, [&](std::size_t triangle) {
        if (!points_) part.large.push_back(triangle);
      });
    });
    if (!points_) {
      points_.emplace();
      for (const Part& part : parts) {
        for (const std::size_t t : part.large) add_points(view_, t, line_, 1, *points_);
      }
    }
    Rises whole;
    for (const Part& part : parts) whole.too_near |= part.rises.too_near;
    for (std::size_t k = 0; k < n_places; ++k) {
      for (const Part& part : parts) whole.sums[k] += part.rises.sums[k];
      whole.sums[k] += rise_at(*points_, line_, places[k]);
    }
    for (const double t : {places.front(), places[n_places - 1]}) {
      for (const SurfacePoint& p : *points_) whole.too_near |= p.d_0 - t * p.d_way < line_.least;
    }
    return whole;
  }

 private:
  const LocalView& view_;
  const SlopeLine& line_;
  const Context& context_;
  std::optional<std::vector<SurfacePoint>> points_;  // points of large faces
};

// Limits how far along the line the centre may move.
class Reach {
 public:
  using Share = std::function<double(double)>;  // allowed share of the way to t
  explicit Reach(Share share) : share_(std::move(share)) {}
  void allow(double low, double high) {
    down_.allowed = std::min(low, 0.0), up_.allowed = std::max(high, 0.0);
  }
  // Returns t if it is allowed, otherwise the last allowed place before t.
  double operator()(double t) {
    const bool up = t > 0;
    Side& side = up ? up_ : down_;
    const double wanted = std::clamp(t, kFirst, kLast);
    if (up ? wanted <= side.allowed : wanted >= side.allowed) return wanted;
    if (side.ends) return side.allowed;
    const double share = share_(wanted);
    side = {.allowed = share * wanted, .ends = share < 1};
    return side.allowed;
  }

 private:
  struct Side {
    double allowed = 0;
    bool ends = false;
  };
  Share share_;
  Side up_, down_;
};

// A place t and the derivative f of the slope there.
struct Known {
  double t, f;
};

// Returns the value at 0 of the polynomial t(f) through some points.
double inverse_at_zero(std::span<const Known> points) {
  double sum = 0;
  for (const Known& p : points) {
    double term = p.t;
    for (const Known& q : points) {
      if (&q != &p) term *= q.f / (q.f - p.f);
    }
    sum += term;
  }
  return sum;
}

// Describes where a curve turns from falling to rising: the interval low ... high, the estimate
// `at` and its error.
struct Turn {
  double low, high;
  double at, error;
};

// Estimates the turn by the polynomial through the points around it. The error is the difference to
// the polynomial without the farthest of these points. `points` ascend by t; the curve falls at the
// first point and not at the last.
Turn turn_of(const std::vector<Known>& points) {
  constexpr std::size_t kNear = 5, kBefore = 2;
  const auto above = std::find_if(points.begin(), points.end(), [](auto& p) { return p.f >= 0; });
  const auto i = std::clamp<std::size_t>(static_cast<std::size_t>(above - points.begin()), 1,
                                         points.size() - 1);
  const double low = points[i - 1].t, high = points[i].t;
  if (points[i].f == 0) return {.low = low, .high = high, .at = high, .error = 0};
  const std::size_t n = std::min(kNear, points.size());
  const std::size_t begin = std::min(i > kBefore ? i - kBefore : 0, points.size() - n);
  const auto near = std::span(points).subspan(begin, n);
  bool rises = true;
  for (std::size_t k = 1; k < n; ++k) rises &= near[k - 1].f < near[k].f;
  const double at = rises ? inverse_at_zero(near) : high;
  if (!(at > low && at < high)) {
    return {.low = low, .high = high, .at = (low + high) / 2, .error = (high - low) / 2};
  }
  const bool first_is_farther = at - near.front().t > near.back().t - at;
  const double other = inverse_at_zero(near.subspan(first_is_farther, n - 1));
  return {.low = low, .high = high, .at = at, .error = std::abs(at - other)};
}

// Interval of a search, as far as the centre may move.
struct Window {
  double low, high;
  bool ends_low = false, ends_high = false;  // the centre may not move beyond this end
};

Window window(Reach& reach, double low, double high) {
  // Asks for the farther end first; the nearer end is then known to be allowed.
  const double first = reach(high > 0 ? high : low), second = reach(high > 0 ? low : high);
  Window w = {.low = high > 0 ? second : first, .high = high > 0 ? first : second};
  if (!(w.low < w.high)) {  // the interval lies beyond an end: move it back to there
    if (w.high < high) {
      low = w.high - (high - low);
      w.low = reach(low);
    } else {
      high = w.low + (high - low);
      w.high = reach(high);
    }
  }
  w.ends_low = w.low > low, w.ends_high = w.high < high;
  return w;
}

// Returns the place of the least slope, starting from a guess.
double least_place(Slope& slope, Reach& reach, double guess) {
  // Chosen. The guess is seldom off by more than kFarthest. If two polynomials of different degree
  // agree within kMet, the higher one is far more accurate than their difference. If the error is
  // within kGood of a cell, one more place is enough.
  constexpr double kFarthest = 0.1, kMet = 1e-7, kGood = 0.05;
  constexpr int kMostPasses = 40;  // two for most bodies, one where the centre may move no farther
  std::vector<Known> points;
  const auto look = [&](const Places& places, std::size_t n) {
    const Rises rises = slope.rises(places, n);
    for (std::size_t k = 0; k < n; ++k) points.push_back({places[k], rises.sums[k]});
    std::sort(points.begin(), points.end(), [](auto& a, auto& b) { return a.t < b.t; });
    return !rises.too_near;
  };
  const auto look_over = [&](double low, double high) {
    const double third = (high - low) / 3;
    points.clear();
    return look({low, low + third, high - third, high}, kMostPlaces);
  };
  // For most bodies the first interval is allowed as a whole; then no pass has to find its ends.
  Window w = {.low = std::clamp(guess - kFarthest, kFirst, kLast),
              .high = std::clamp(guess + kFarthest, kFirst, kLast)};
  w.ends_low = w.low == kFirst, w.ends_high = w.high == kLast;
  if (look_over(w.low, w.high)) {
    reach.allow(w.low, w.high);
  } else {
    w = window(reach, guess - kFarthest, guess + kFarthest);
    look_over(w.low, w.high);
  }
  for (int pass = 1; pass < kMostPasses; ++pass) {
    const double width = 4 * (w.high - w.low);
    if (points.back().f < 0) {
      if (w.ends_high) return w.high;
      w = window(reach, w.high, w.high + width);
      look_over(w.low, w.high);
    } else if (points.front().f > 0) {
      if (w.ends_low) return w.low;
      w = window(reach, w.low - width, w.low);
      look_over(w.low, w.high);
    } else {
      const Turn turn = turn_of(points);
      const double cell = turn.high - turn.low;
      if (turn.error < kMet || !(cell > kMet)) return turn.at;
      if (turn.error < kGood * cell) {
        look({turn.at}, 1);
      } else {
        const double step = cell / 5;
        look({turn.low + step, turn.low + 2 * step, turn.high - 2 * step, turn.high - step},
             kMostPlaces);
      }
    }
  }
  return turn_of(points).at;
}

}  // namespace

Vec3 least_slope(const LocalView& view, const KernelCenter& middle, const Vec3& centroid,
                 const Context& context) {
  const SlopeLine line = {
      .middle = middle.point, .way = centroid - middle.point, .least = kMargin * middle.value};
  Slope slope(view, line, context);
  Reach reach(
      [&](double t) { return share_of_way(view, middle, line.middle + t * line.way, context); });
  const double t = least_place(slope, reach, guess(sampled_points(view, line), line));
  return line.middle + t * line.way;
}

}  // namespace rholm
