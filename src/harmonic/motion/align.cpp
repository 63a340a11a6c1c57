#include "rholm/align.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/check_fields.h"
#include "base/parallel.h"
#include "base/refuse.h"
#include "harmonic/motion/align_newton.h"
#include "harmonic/motion/align_search.h"
#include "rholm/harmonic.h"
#include "rholm/recenter.h"

namespace rholm {
namespace {

constexpr std::size_t kMostPeaks = 64;        // chosen: the group of a cube has 24 rotations
constexpr std::size_t kMostAmbiguities = 32;  // chosen
// Two maxima closer than this angle are one. It is half the step of a grid of degree 64.
constexpr double kSameRotation = 0.01;
// Largest change in the relative correlation of a peak by its last refinement.
constexpr double kSlack = 0.1;
// Two correlations closer than this difference are equal up to rounding.
constexpr double kSameCorrelation = 1e-12;
// An axis of rotation counts as a free axis if the cosine between them is above this: 6 degrees.
constexpr double kSameAxis = 0.995;

// Smallest significant coefficients relative to the mean. Smaller ones are due to rounding and to
// the limited precision of an analysis.
constexpr double kNothing = 1e-10;

// Largest degree for which surfaces are expanded about their centroids: takes about a second.
constexpr int kMaxCenteredDegree = 256;

void check(const Coefficients& a, const Coefficients& b, const AlignOptions& options) {
  check_fields(options);
  for (const Coefficients* f : {&a, &b}) {
    for (const double value : f->values()) {
      if (!std::isfinite(value)) refuse("a coefficient to align is not finite");
    }
  }
}

double largest_of(const Coefficients& f) {
  double largest = 0;
  for (const double value : f.values()) largest = std::max(largest, std::abs(value));
  return largest;
}

// Returns the degrees 0 ... L divided by `unit`, so that squares neither overflow nor underflow.
Coefficients scaled(const Coefficients& f, int degree, double unit) {
  Coefficients result = f.resized(degree);
  for (double& value : result.values()) value /= unit;
  return result;
}

// Both functions up to the degree of the refinement, in units of their largest coefficients.
struct Pair {
  Coefficients a, b;
  double norms = 0;  // |a| |b| without degree 0; 0 if one is a sphere

  Pair(const Coefficients& a_all, const Coefficients& b_all, const AlignOptions& options) {
    const int degree =
        std::min(options.refine_degree, std::max({a_all.degree(), b_all.degree(), 1}));
    const double unit_a = largest_of(a_all), unit_b = largest_of(b_all);
    if (!(unit_a > 0 && unit_b > 0)) return;
    a = scaled(a_all, degree, unit_a);
    b = scaled(b_all, degree, unit_b);
    const double of_a = std::sqrt(correlation(a, a)), of_b = std::sqrt(correlation(b, b));
    const double to_norm = std::sqrt(4 * std::numbers::pi);
    const auto turns = [&](double norm, double mean, double unknown) {
      return norm > std::max(kNothing * std::abs(mean), to_norm * unknown);
    };
    if (turns(of_a, a.c(0, 0), options.unknown_a / unit_a) &&
        turns(of_b, b.c(0, 0), options.unknown_b / unit_b)) {
      norms = of_a * of_b;
    }
  }
};

std::vector<Rotation> starts(const Pair& pair, const AlignOptions& options,
                             const Context& context) {
  if (options.start == AlignStart::kCorrelation) {
    // The identity is added, because it may be one among many rotations that are equally good.
    std::vector<Rotation> peaks =
        correlation_peaks(pair.a, pair.b, options.bandwidth, kMostPeaks, context);
    peaks.push_back({});
    return peaks;
  }
  const Rotation from = principal_axes(pair.a).to_axes;
  const Rotation to = inverse(principal_axes(pair.b).to_axes);
  std::vector<Rotation> result = {compose(to, from)};
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    result.push_back(compose(to, compose(rotation_about(axis, std::numbers::pi), from)));
  }
  return result;
}

// Sorts by value; drops repeated rotations and maxima more than `below` under the best.
void keep_best(std::vector<CorrelationMaximum>& maxima, double below) {
  std::stable_sort(maxima.begin(), maxima.end(),
                   [](const auto& x, const auto& y) { return x.value > y.value; });
  std::vector<CorrelationMaximum> kept;
  for (const CorrelationMaximum& m : maxima) {
    const bool same = std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
      return angle_between(m.rotation, other.rotation) < kSameRotation;
    });
    if (!same && m.value >= maxima.front().value - below) kept.push_back(m);
  }
  maxima = std::move(kept);
}

// Runs Newton's iteration from all starts: first with the degrees of the search, which is fast. The
// best maxima are then refined with all degrees.
std::vector<CorrelationMaximum> find_maxima(const Pair& pair, const AlignOptions& options,
                                            const Context& context) {
  const int coarse = std::min(options.bandwidth, pair.a.degree());
  const Coefficients a = pair.a.resized(coarse), b = pair.b.resized(coarse);
  std::vector<CorrelationMaximum> maxima;
  const std::vector<Rotation> from = starts(pair, options, context);
  const Context quiet{.threads = context.threads, .progress = {}};
  for (const Rotation& start : from) {
    report_progress(
        context, "align",
        0.5 + 0.4 * static_cast<double>(maxima.size()) / static_cast<double>(from.size()));
    maxima.push_back(refine_rotation(a, b, start, quiet));
  }
  keep_best(maxima, (options.margin + kSlack) * pair.norms);
  for (CorrelationMaximum& m : maxima) {
    report_progress(context, "align", 0.9);
    m = refine_rotation(pair.a, pair.b, m.rotation, quiet);
  }
  keep_best(maxima, options.margin * pair.norms);
  return maxima;
}

// Returns the axes about which a rotation hardly changes the correlation.
std::vector<Vec3> free_axes_of(const CorrelationMaximum& best, double norms, double margin) {
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i) {
    if (best.curvature.values[i] / 2 <= std::max(margin, 1e-12) * norms) {
      axes.push_back(best.curvature.vectors[i]);
    }
  }
  return axes;
}

// Returns true if a and b differ only by a rotation about a free axis.
bool is_along(const std::vector<Vec3>& axes, const Rotation& a, const Rotation& b) {
  const Vec3 axis = axis_angle_of(compose(a, inverse(b))).axis;
  return axes.size() > 1 || std::any_of(axes.begin(), axes.end(), [&](const Vec3& other) {
           return std::abs(dot(axis, other)) > kSameAxis;
         });
}

struct Found {
  std::vector<AlignedRotation> rotations;  // best first; the identity for a sphere
  std::vector<Vec3> free_axes;
};

Found find_rotations(const Coefficients& a, const Coefficients& b, bool mirrored,
                     const AlignOptions& options, const Context& context) {
  const Pair pair(a, b, options);
  Found found;
  if (pair.norms == 0) {
    found.free_axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    found.rotations.push_back({.rotation = {}, .mirrored = mirrored});
    return found;
  }
  const auto maxima = find_maxima(pair, options, context);
  found.free_axes = free_axes_of(maxima.front(), pair.norms, options.margin);
  for (const CorrelationMaximum& m : maxima) {
    if (!found.rotations.empty() &&
        is_along(found.free_axes, m.rotation, maxima.front().rotation)) {
      continue;
    }
    found.rotations.push_back({m.rotation, mirrored, m.value / pair.norms, 0});
    if (found.rotations.size() > kMostAmbiguities) break;
  }
  return found;
}

// Sorts the best first. Rounding decides which of several equally good rotations is the largest.
// They are therefore sorted by their angle, with mirrored ones last.
void sort_by_correlation(std::vector<AlignedRotation>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& x, const auto& y) { return x.correlation > y.correlation; });
  const double least = all.front().correlation - kSameCorrelation;
  const auto end = std::find_if(all.begin(), all.end(),
                                [&](const AlignedRotation& r) { return r.correlation < least; });
  std::stable_sort(all.begin(), end, [](const auto& x, const auto& y) {
    if (x.mirrored != y.mirrored) return y.mirrored;
    return angle_between(x.rotation, {}) < angle_between(y.rotation, {});
  });
}

// Returns the RMS of the truncated part of a radius if it is known, and otherwise 0.
double left_out(const Expansion& expansion) {
  const bool known = expansion.errors && expansion.function == RadialFunction::kRadius;
  return known ? expansion.errors->rms.value_or(0) : 0;
}

Expansion about_centroid(const Expansion& expansion, const Context& context) {
  Expansion low = expansion;
  if (low.coefficients.degree() > kMaxCenteredDegree) {
    low.coefficients = low.coefficients.resized(kMaxCenteredDegree);
  }
  return recentered(low, volume_centroid(low, context), context);
}

}  // namespace

double distance(const Coefficients& a, const Coefficients& b) {
  const int degree = std::max(a.degree(), b.degree());
  const double unit = std::max(largest_of(a), largest_of(b));
  if (!(unit > 0)) return 0;
  const Coefficients x = a.resized(degree), y = b.resized(degree);
  double square = 0;
  for (std::size_t i = 0; i < x.values().size(); ++i) {
    square += std::pow((x.values()[i] - y.values()[i]) / unit, 2);
  }
  return unit * std::sqrt(square / (4 * std::numbers::pi));
}

double descriptor_distance(const Coefficients& a, const Coefficients& b) {
  const double unit = std::max(largest_of(a), largest_of(b));
  if (!(unit > 0)) return 0;
  const int degree = std::max(a.degree(), b.degree());
  const auto x = power_spectrum(scaled(a, degree, unit)),
             y = power_spectrum(scaled(b, degree, unit));
  double square = 0;
  for (std::size_t l = 0; l < x.size(); ++l) {
    square += std::pow(std::sqrt(x[l]) - std::sqrt(y[l]), 2);
  }
  return unit * std::sqrt(square / (4 * std::numbers::pi));
}

Alignment align(const Coefficients& a, const Coefficients& b, const AlignOptions& options,
                const Context& context) {
  check(a, b, options);
  const Coefficients image = options.mirror ? mirror(a, Axis::kX) : Coefficients();
  Found found = find_rotations(a, b, false, options, context);
  if (options.mirror) {
    const Found other = find_rotations(image, b, true, options, context);
    const double gain = other.rotations[0].correlation - found.rotations[0].correlation;
    if (gain > kSameCorrelation) found.free_axes = other.free_axes;
    found.rotations.insert(found.rotations.end(), other.rotations.begin(), other.rotations.end());
  }
  sort_by_correlation(found.rotations);
  Alignment result;
  result.free_axes = std::move(found.free_axes);
  result.unaligned_distance = distance(a, b);
  const double least = found.rotations[0].correlation - options.margin;
  for (AlignedRotation& r : found.rotations) {
    if (r.correlation < least || result.ambiguities.size() == kMostAmbiguities) break;
    r.distance = distance(rotate(r.mirrored ? image : a, r.rotation, context), b);
    if (&r == &found.rotations[0]) {
      result.best = r;
    } else {
      result.ambiguities.push_back(r);
    }
  }
  return result;
}

Placement align(const Expansion& a, const Expansion& b, AlignCenters centers,
                const AlignOptions& options, const Context& context) {
  require_surface(a);
  require_surface(b);
  if (a.function != b.function) {
    refuse(std::string("one expansion is of the ") + to_string(a.function) + ", the other of the " +
           to_string(b.function) + ": make both in the same way");
  }
  AlignOptions wanted = options;
  wanted.unknown_a = std::max(options.unknown_a, left_out(a));
  wanted.unknown_b = std::max(options.unknown_b, left_out(b));
  Placement placement;
  const auto turn = [&](const Expansion& from, const Expansion& to) {
    placement.alignment = align(from.coefficients, to.coefficients, wanted, context);
    placement.from = from.center;
    placement.to = to.center;
    return placement;
  };
  placement.centers = AlignCenters::kOwn;
  if (centers == AlignCenters::kOwn) return turn(a, b);
  std::optional<Expansion> x, y;
  try {
    x = about_centroid(a, context);
    y = about_centroid(b, context);
  } catch (const Error& error) {
    if (centers == AlignCenters::kVolume || error.code() == ErrorCode::kCancelled) throw;
    placement.why_own = error.what();
    return turn(a, b);
  }
  placement.centers = AlignCenters::kVolume;
  return turn(*x, *y);
}

EnumNames names_of(AlignStart) {
  static constexpr std::array kNames = {"correlation", "principal-axes"};
  return {"start of the search", kNames};
}

EnumNames names_of(AlignCenters) {
  static constexpr const char* kNames[] = {"auto", "volume", "own"};
  return {"choice of centres", kNames};
}

Expansion placed(const Expansion& a, const Placement& placement, const Context& context) {
  const AlignedRotation& best = placement.alignment.best;
  Expansion result = best.mirrored ? mirror(a, Axis::kX, placement.from) : a;
  result = rotate(result, best.rotation, placement.from, context);
  result.center += placement.to - placement.from;
  return result;
}

namespace {

// Returns the smallest rotation that takes one unit vector to another.
Rotation turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = cross(from, to);
  if (norm(axis) > 1e-15) return rotation_about(axis, std::atan2(norm(axis), dot(from, to)));
  if (dot(from, to) > 0) return {};
  const Vec3 across = cross(from, std::abs(from.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  return rotation_about(across, std::numbers::pi);
}

// Where two values are equal, only the axis of the third is defined; the other axes follow from it.
void settle_equal_axes(double mean, PrincipalAxes& found) {
  const auto equal = [&](int i) {
    return found.values[i] - found.values[i + 1] <= kNothing * std::abs(mean);
  };
  if (!equal(0) && !equal(1)) return;
  constexpr Vec3 kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};
  found.to_axes = {};
  if (equal(0) && equal(1)) {
    found.free_axes = {kX, kY, kZ};
  } else {
    const Vec3 alone = found.axes[equal(0) ? 2 : 0];
    found.free_axes = {alone};
    found.to_axes = turn_between(alone, equal(0) ? kZ : kX);
  }
  const Rotation back = inverse(found.to_axes);
  found.axes = {rotate(kX, back), rotate(kY, back), rotate(kZ, back)};
}

}  // namespace

// The harmonics of degree 2 in this basis, where the squares have positive factors:
//   sqrt(5/16pi) (2z^2 - x^2 - y^2), sqrt(15/4pi) xz, yz, xy, sqrt(15/16pi) (x^2 - y^2).
PrincipalAxes principal_axes(const Coefficients& coefficients, RadialFunction function) {
  const Coefficients f = coefficients.resized(3);
  const double sign = function == RadialFunction::kGauge ? -1 : 1;
  const double zonal = sign * std::sqrt(5 / (16 * std::numbers::pi)) * f.c(2, 0);
  const double k = sign * std::sqrt(15 / (16 * std::numbers::pi));
  const Eigen3 eigen = eigen_of_symmetric({{{k * f.c(2, 2) - zonal, k * f.s(2, 2), k * f.c(2, 1)},
                                            {0, -k * f.c(2, 2) - zonal, k * f.s(2, 1)},
                                            {0, 0, 2 * zonal}}});
  PrincipalAxes result{.axes = eigen.vectors, .values = eigen.values, .to_axes = {}};
  Coefficients odd(3);
  for (int m = 0; m <= 3; ++m) odd.c(3, m) = sign * f.c(3, m), odd.s(3, m) = sign * f.s(3, m);
  const std::vector<double> values = evaluate(odd, result.axes, {.engine = Engine::kDirect});
  // Below this, degree 3 does not choose the sign: the axis points along its coordinate axis.
  const double mean = f.c(0, 0), least = kNothing * std::abs(mean);
  const auto choose_sign = [&](Vec3& axis, double value, double nearer) {
    if (std::abs(value) > least ? value < 0 : nearer < 0) axis = -axis;
  };
  const bool oblate = result.values[0] - result.values[1] <= least;
  choose_sign(result.axes[0], values[0], result.axes[0].x);
  choose_sign(result.axes[1], values[1], result.axes[1].y);
  if (oblate) {
    choose_sign(result.axes[2], values[2], result.axes[2].z);
  } else {
    result.axes[2] = cross(result.axes[0], result.axes[1]);
    result.to_axes = rotation_of(RotationMatrix{result.axes[0], result.axes[1], result.axes[2]});
  }
  settle_equal_axes(mean, result);
  return result;
}

}  // namespace rholm
