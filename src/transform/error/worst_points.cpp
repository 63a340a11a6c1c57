#include "transform/error/worst_points.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "harmonic/nonuniform/grid_function.h"
#include "transform/error/long_faces.h"
#include "transform/mesh_pass/plan/error_budget.h"

namespace rholm {
namespace {

// Up to this many points are all measured exactly at once: one more grid costs as much (chosen).
constexpr std::size_t kFew = 20'000;
// Difference between first and exact values, as a part of the errors. Both are root mean squares
// (chosen: six times the difference is a third of the errors).
constexpr double kRough = 0.05;
constexpr double kDeviations = 6;
// Number of points that are measured exactly at a time. The first time they are at least as
// numerous as the points at which closest points begin.
constexpr std::size_t kBatch = 10'000;

// Between points of a lattice of 1.5/L, waves of degree L fall to cos(0.87) = 0.65; along an edge
// they fall to cos(0.75) = 0.73. A little less is kept.
constexpr double kNearPeak = 0.6;
// The largest number of dense points that get exact values (chosen: some milliseconds).
constexpr std::size_t kMostDense = 16'384;

// Points whose first values are not far below the largest error.
struct Kept {
  ErrorPoints points;
  std::vector<double> rough;  // radial errors
  std::size_t seen = 0;

  void append(const Kept& more) {
    points.append(more.points);
    rough.insert(rough.end(), more.rough.begin(), more.rough.end());
    seen += more.seen;
  }
};

// The degrees from 1 on. The mean is kept apart, because single precision would round it.
template <typename T>
struct RoughFunction {
  RoughFunction(const NonuniformPlan& plan, const Expansion& expansion, const Context& context)
      : mean(expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi)),
        gauge(expansion.function == RadialFunction::kGauge),
        varying(plan, without_mean(expansion.coefficients), context) {}

  static Coefficients without_mean(Coefficients coefficients) {
    coefficients.c(0, 0) = 0;
    return coefficients;
  }

  double mean;
  bool gauge;
  GridFunction<T> varying;
};

// Takes points one by one, and keeps the points that may have the largest errors.
template <typename T>
class Sieve {
 public:
  // Also drops points whose error is below `part` of the largest one seen so far.
  Sieve(const RoughFunction<T>& function, const MeshView& mesh, const Vec3& center,
        const FaceScan& scan, double least, double part)
      : function_(function),
        mesh_(mesh),
        center_(center),
        scan_(scan),
        least_(least),
        part_(part) {}

  // Adds the point x, relative to the centre and times the scale. For `owner` see ErrorPoints.
  void add(const Vec3& x, std::int64_t owner) {
    if (!(dot(x, x) > 0)) return;  // the centre has no direction
    batch_.x[0][n_] = x.x;
    batch_.x[1][n_] = x.y;
    batch_.x[2][n_] = x.z;
    owners_[n_] = owner;
    if (++n_ == SourceBatch<T>::kSize) flush();
  }

  Kept finish() {
    flush();
    return std::move(kept_);
  }

 private:
  void flush() {
    PolarSources near;
    function_.varying.read(batch_, n_, false, near);
    const double to_value = 1 / function_.varying.scale(), to_shape = 1 / scan_.sizes.scale;
    double values[SourceBatch<T>::kSize], errors[SourceBatch<T>::kSize];
    for (std::size_t j = 0; j < n_; ++j) {
      const double x = batch_.x[0][j], y = batch_.x[1][j], z = batch_.x[2][j];
      const double r = to_shape * std::sqrt(x * x + y * y + z * z);
      values[j] = function_.mean + to_value * batch_.value[j];
      errors[j] = std::abs(r - (function_.gauge ? 1 / values[j] : values[j]));
      least_ = std::max(least_, part_ * errors[j]);
    }
    for (std::size_t j = 0; j < n_; ++j) {
      const double value = values[j], error = errors[j];
      if (error < least_ && value > 0) continue;
      const Vec3 x = {batch_.x[0][j], batch_.x[1][j], batch_.x[2][j]};
      const std::optional<double> cosine = cosine_at(x, owners_[j]);
      if (!cosine) continue;
      const double r = norm(x);
      kept_.points.add(x / r, to_shape * r, *cosine, owners_[j]);
      // Where the gauge has no surface, its error comes first, so that it is refused.
      kept_.rough.push_back(value > 0 || !function_.gauge ? error
                                                          : std::numeric_limits<double>::max());
    }
    kept_.seen += n_;
    n_ = 0;
  }

  // Returns 0 at vertices, which have no face.
  std::optional<double> cosine_at(const Vec3& x, std::int64_t owner) const {
    if (owner < 0) return 0.0;
    return face_cosine(mesh_, static_cast<std::size_t>(owner), center_, scan_, x);
  }

  const RoughFunction<T>& function_;
  const MeshView& mesh_;
  const Vec3& center_;
  const FaceScan& scan_;
  double least_, part_;
  SourceBatch<T> batch_;
  std::int64_t owners_[SourceBatch<T>::kSize];
  std::size_t n_ = 0;
  Kept kept_;
};

std::size_t parts(std::size_t n, std::size_t grain) { return (n + grain - 1) / grain; }

Kept joined(const std::vector<Kept>& kept) {
  Kept all;
  for (const Kept& part : kept) all.append(part);
  return all;
}

// Returns the extreme points that are kept, points at vertices first.
template <typename T>
Kept sieve(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
           const NonuniformPlan& plan, double least, const Context& context) {
  const RoughFunction<T> function(plan, expansion, context);
  constexpr std::size_t kVertices = 4096, kRuns = 8;  // sizes of a task of some 100 us
  const std::size_t n_runs = scan.sizes.angles2.size(),
                    first_run = parts(mesh.n_vertices, kVertices);
  std::vector<Kept> kept(first_run + parts(n_runs, kRuns));
  const auto fill = [&](std::size_t part, const auto& add_points) {
    const auto sieve = std::make_unique<Sieve<T>>(function, mesh, expansion.center, scan, least, 0);
    add_points(*sieve);
    kept[part] = sieve->finish();
  };
  parallel_for(mesh.n_vertices, kVertices, context, {}, [&](std::size_t begin, std::size_t end) {
    fill(begin / kVertices, [&](Sieve<T>& sieve) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!scan.is_used(i)) continue;
        sieve.add(scan.sizes.scale * (mesh.vertex(i) - expansion.center),
                  -1 - static_cast<std::int64_t>(i));
      }
    });
  });
  parallel_for(n_runs, kRuns, context, {}, [&](std::size_t begin, std::size_t end) {
    fill(first_run + begin / kRuns, [&](Sieve<T>& sieve) {
      visit_long_faces(mesh, expansion.center, scan, expansion.coefficients.degree(), begin, end,
                       [&](std::span<const Vec3> points, std::size_t t) {
                         for (const Vec3& x : points) sieve.add(x, static_cast<std::int64_t>(t));
                       });
    });
  });
  return joined(kept);
}

// Returns the dense points of some faces that are kept.
template <typename T>
Kept sieve_dense(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                 const std::vector<std::size_t>& faces, const NonuniformPlan& plan, double least,
                 const Context& context) {
  const RoughFunction<T> function(plan, expansion, context);
  // Largest number of parts: a face alone has at least ten points.
  constexpr std::size_t kMostParts = 4096;
  const std::size_t grain = faces.size() / kMostParts + 1;
  std::vector<Kept> kept(parts(faces.size(), grain));
  parallel_for(faces.size(), grain, context, {}, [&](std::size_t begin, std::size_t end) {
    const auto sieve =
        std::make_unique<Sieve<T>>(function, mesh, expansion.center, scan, least, kNearPeak);
    for (std::size_t k = begin; k < end; ++k) {
      visit_dense_points(mesh, expansion.center, scan, expansion.coefficients.degree(), faces[k],
                         [&](std::span<const Vec3> points, std::size_t t) {
                           for (const Vec3& x : points) sieve->add(x, static_cast<std::int64_t>(t));
                         });
    }
    kept[begin / grain] = sieve->finish();
  });
  return joined(kept);
}

// Returns vertices evenly through the file, which tell how large errors are at vertices.
ErrorPoints some_vertices(const MeshView& mesh, const Vec3& center, const FaceScan& scan) {
  constexpr std::size_t kSample = 8192;  // chosen
  const std::size_t step = mesh.n_vertices / kSample + 1;
  ErrorPoints points;
  for (std::size_t i = 0; i < mesh.n_vertices; i += step) {
    const Vec3 x = scan.sizes.scale * (mesh.vertex(i) - center);
    const double r = norm(x);
    if (!scan.is_used(i) || !(r > 0)) continue;
    points.add(x / r, r / scan.sizes.scale, 0, -1 - static_cast<std::int64_t>(i));
  }
  return points;
}

double root_mean_square(const std::vector<double>& values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

// Returns the first value from which on points are kept. `low` is the smaller one of the largest
// radial error and the largest distance known. The radial errors of a sample of the vertices give
// the value that keeps some 2 kBatch points.
double least_kept(std::vector<double> sample, std::size_t n_vertices, double low) {
  constexpr double kNear = 0.9, kFar = 0.5;  // parts of `low` (chosen)
  const auto part = static_cast<double>(sample.size()) / static_cast<double>(n_vertices);
  const auto rank = static_cast<std::size_t>(part * 2 * kBatch);
  if (rank >= sample.size()) return kFar * low;
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sample.begin(), at, sample.end(), std::greater<>());
  return std::clamp(*at, kFar * low, kNear * low);
}

// Returns a plan for values with errors of a small part of `rms`, the rms of the radial errors.
NonuniformPlan rough_plan(const Expansion& expansion, std::size_t n, double rms, double farthest) {
  // Errors of r are r^2 times errors of 1/r, and largest where the surface is farthest.
  const bool gauge = expansion.function == RadialFunction::kGauge;
  if (gauge) rms /= farthest * farthest;
  const int degree = expansion.coefficients.degree();
  const double size =
      norm_of_degrees(expansion.coefficients, 1, degree) / std::sqrt(4 * std::numbers::pi);
  return plan_nonuniform({.degree = degree,
                          .allowed = size > 0 ? std::clamp(kRough * rms / size, 1e-12, 1e-2) : 1e-2,
                          .sources = n});
}

}  // namespace

WorstPoints worst_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& exact, const WorstOptions& options,
                         const Context& context) {
  const auto measured = [&](const ErrorPoints& points) {
    return point_errors(points, exact, true, context);
  };
  WorstPoints worst;
  if (mesh.n_vertices + mesh.n_faces <= kFew) {
    worst.points = extreme_points(mesh, expansion.center, scan, exact.degree);
    worst.errors = measured(worst.points);
    worst.seen = worst.points.size();
    return worst;
  }
  const ErrorPoints sample = some_vertices(mesh, expansion.center, scan);
  const PointErrors of_sample = measured(sample);
  const double radial = std::max(options.radial, largest(of_sample.radial));
  double distance = std::max(options.distance, largest(of_sample.to_model));
  const double least = least_kept(of_sample.radial, mesh.n_vertices, std::min(radial, distance));
  const double rms = std::max(options.rms, root_mean_square(of_sample.radial));
  const NonuniformPlan plan = rough_plan(expansion, mesh.n_vertices, rms, largest(sample.radii));
  const Kept kept = plan.single ? sieve<float>(mesh, scan, expansion, plan, least, context)
                                : sieve<double>(mesh, scan, expansion, plan, least, context);
  worst.seen = kept.seen;
  std::vector<std::size_t> order(kept.rough.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto worse = [&](std::size_t a, std::size_t b) {
    return kept.rough[a] != kept.rough[b] ? kept.rough[a] > kept.rough[b] : a < b;
  };
  double squares = 0;
  for (std::size_t begin = 0; begin < order.size();) {
    const std::size_t end = std::min(order.size(), begin + std::max(kBatch, begin));
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(end);
    if (begin > 0) {
      const double uncertainty = kDeviations * std::sqrt(squares / static_cast<double>(begin));
      if (kept.rough[*std::min_element(first, order.end(), worse)] + uncertainty < distance) break;
    }
    std::partial_sort(first, last, order.end(), worse);
    const ErrorPoints points = kept.points.subset({first, last});
    const PointErrors errors = measured(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double difference = errors.radial[i] - kept.rough[order[begin + i]];
      squares += difference * difference;
    }
    distance = std::max({distance, largest(errors.to_model), largest(errors.to_shape)});
    worst.points.append(points);
    worst.errors.append(errors);
    begin = end;
  }
  return worst;
}

DensePoints dense_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         double rms, double largest_known, const Context& context) {
  DensePoints dense;
  const int degree = expansion.coefficients.degree();
  const std::vector<std::size_t> faces = longest_faces(mesh, expansion.center, scan, degree);
  if (faces.empty()) return dense;
  double farthest = 0;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    if (scan.is_used(i)) farthest = std::max(farthest, norm(mesh.vertex(i) - expansion.center));
  }
  // A sphere has about 20 L^2 dense points: one in each 1/L^2, and half of them on two pieces.
  const double expected = 20.0 * degree * degree;
  const NonuniformPlan plan =
      rough_plan(expansion, static_cast<std::size_t>(expected), rms, farthest);
  const double least = kNearPeak * largest_known;
  const Kept kept = plan.single
                        ? sieve_dense<float>(mesh, scan, expansion, faces, plan, least, context)
                        : sieve_dense<double>(mesh, scan, expansion, faces, plan, least, context);
  dense.seen = kept.seen;
  std::vector<std::size_t> most = indices_of_largest(kept.rough, kMostDense);
  dense.points = kept.points.subset(most);
  return dense;
}

}  // namespace rholm
