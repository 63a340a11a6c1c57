// The least squares of a cap's points: phi = r / R_0 - 1 by the patch harmonics of the opened
// sphere, weighted by area there, so that the fit is close to a projection onto them.
//
// The robust fit reweights, from coarse to fine: a low degree cannot follow a scratch, so that what
// lies off it far more than the rest, and what is near that, is left out (Tukey's measure), and
// comes back only if a higher degree, fitted without it, agrees. The first solutions take Huber's
// measure, which is convex: whatever the start, it finds the same.
#include "edit/patch_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "edit/patch_kernels.h"

namespace rholm {
namespace {

// Points per coefficient: of the fits that only tell what stands out, and of the last, which
// averages over what is left: what n of them leave of finer detail is 1 / sqrt(n) of it, half of
// that where caps overlap. Every cap draws its own.
constexpr double kPointsForWeights = 6;
constexpr double kPointsPerCoefficient = 400;
// Of (l (l + 1))^2 against the weights: only where points leave a fit undetermined it matters.
constexpr double kPenalty = 1e-8;
// With fewer points around it than this, a region is not bridged but guessed. Half a wavelength
// across a cap is a sixth, and a third where caps had to shrink.
constexpr double kMostIgnored = 0.45;
// A pivot that has lost so many digits is none.
constexpr double kLeastPivot = 1e-12;
constexpr int kFirstDegree = 2, kDegreeStep = 2, kConvex = 3;
// Where Huber's measure turns linear, in medians of |e|; 1.48 medians are a standard deviation.
constexpr double kTurn = 1;
// Where Tukey's has forgotten, likewise, and how near to such a point others are left out with it,
// in half wavelengths. Measured on scratches four tenths of a wavelength wide: 4 ... 7 and 0.5 ...
// 1 are alike, the scratch disappears five times as well as with the convex measure alone.
constexpr double kForgotten = 5;
constexpr double kHalo = 0.8;
// No less than this part of the detail that the fit has found: where the surroundings are
// perfectly smooth the smallest misfit of a wide feature would stand out.
constexpr double kLeastScale = 0.05;

// About `wanted` of the points, all over the cap.
void choose_points(const PatchCap& cap, double wanted, std::span<const std::uint8_t> ignored,
                   PatchScratch& scratch) {
  const double share = wanted / static_cast<double>(cap.points.size());
  scratch.taken.clear();
  for (const std::uint32_t v : cap.points) {
    if (!ignored.empty() && ignored[v] != 0) continue;
    if (share >= 1 || random_uniform(cap.points.front(), v) < share) scratch.taken.push_back(v);
  }
}

void fill_offsets(const LocalMesh& local, const CapFrame& frame,
                  std::span<const std::uint32_t> points, PatchScratch& scratch) {
  const std::size_t n = padded(points.size());
  const Vec3 seed = frame.seed();
  scratch.offsets.assign(3 * n, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 offset = local.points[points[i]] - seed;
    scratch.offsets[i] = offset.x;
    scratch.offsets[n + i] = offset.y;
    scratch.offsets[2 * n + i] = offset.z;
  }
}

// Weights before any robustness: area on the opened sphere, less at the rim, 0 for the padding.
void base_weights(const LocalMesh& local, const PatchCap& cap, PatchScratch& scratch) {
  const std::size_t n = padded(scratch.taken.size());
  const double support2 = cap.frame.support * cap.frame.support;
  scratch.base.assign(n, 0);
  double sum = 0;
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    const Vec3 offset = {scratch.offsets[i], scratch.offsets[n + i], scratch.offsets[2 * n + i]};
    const double rim = 1.15 - std::min(1.0, dot(offset, offset) / support2);  // method 7.8
    scratch.base[i] = local.areas[scratch.taken[i]] * scratch.area[i] * rim;
    sum += scratch.base[i];
  }
  if (!(sum > 0)) return;
  for (double& w : scratch.base) w /= sum;
}

// Factors the normal equations of n unknowns, b and then A in the matrix of n + 1: U^T U = A, row
// by row so that the compiler can work in vectors, and U^-T b beside it. False if a pivot is lost.
bool factorize(std::size_t n, PatchScratch& scratch) {
  const std::vector<double>& matrix = scratch.matrix;
  std::vector<double>& upper = scratch.factor;  // [n][n + 1], the last column is U^-T b
  upper.resize(n * (n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) upper[i * (n + 1) + j] = matrix[(j + 1) * (n + 1) + i + 1];
    upper[i * (n + 1) + n] = matrix[(i + 1) * (n + 1)];
  }
  for (std::size_t k = 0; k < n; ++k) {
    double* const row = &upper[k * (n + 1)];
    if (!(row[k] > kLeastPivot * matrix[(k + 1) * (n + 2)])) return false;
    const double inverse = 1 / std::sqrt(row[k]);
    for (std::size_t j = k; j <= n; ++j) row[j] *= inverse;
    for (std::size_t i = k + 1; i < n; ++i) {
      double* const below = &upper[i * (n + 1)];
      const double times = row[i];
      for (std::size_t j = i; j <= n; ++j) below[j] -= times * row[j];
    }
  }
  return true;
}

// The solution of the leading `count` equations.
void back_substitute(const std::vector<double>& upper, std::size_t n, std::size_t count,
                     double* x) {
  for (std::size_t i = count; i-- > 0;) {
    const double* const row = &upper[i * (n + 1)];
    double value = row[n];
    for (std::size_t j = i + 1; j < count; ++j) value -= row[j] * x[j];
    x[i] = value / row[i];
  }
}

bool solve(int degree, PatchScratch& scratch) {
  const std::size_t n = patch_basis(degree);
  if (scratch.taken.size() < n) return false;
  const std::size_t n_points = padded(scratch.taken.size());
  scratch.matrix.resize((n + 1) * (n + 1));
  patch_gram(scratch.rows.data(), n + 1, scratch.weights.data(), n_points, scratch.matrix.data());
  double sum = 0;
  for (const double w : scratch.weights) sum += w;
  for (int l = 1; l <= degree; ++l) {
    const double square = static_cast<double>(l) * (l + 1) * l * (l + 1);
    for (std::size_t i = patch_basis(l - 1); i < patch_basis(l); ++i) {
      scratch.matrix[(i + 1) * (n + 2)] += kPenalty * sum * square;
    }
  }
  if (!factorize(n, scratch)) return false;
  scratch.solution.resize(n);
  back_substitute(scratch.factor, n, n, scratch.solution.data());
  return true;
}

// Points, their rows and their weights.
void take_points(const LocalMesh& local, const PatchCap& cap, double per_coefficient,
                 std::span<const std::uint8_t> ignored, PatchScratch& scratch) {
  const std::size_t n = patch_basis(cap.degree);
  choose_points(cap, per_coefficient * static_cast<double>(n), ignored, scratch);
  const std::size_t n_points = padded(scratch.taken.size());
  fill_offsets(local, cap.frame, scratch.taken, scratch);
  scratch.rows.resize((n + 5) * n_points);
  scratch.area.resize(n_points);
  patch_rows(cap.frame, cap.degree, scratch.offsets.data(), n_points, scratch.rows.data(),
             scratch.area.data());
  base_weights(local, cap, scratch);
  scratch.weights = scratch.base;
}

// |e| of the solution at the points.
void find_residuals(std::size_t n, PatchScratch& scratch) {
  const std::size_t n_points = padded(scratch.taken.size());
  scratch.residual.resize(n_points);
  patch_sum(&scratch.rows[n_points], scratch.solution.data(), n, n_points, scratch.residual.data());
  const double* const wanted = scratch.rows.data();
  for (std::size_t i = 0; i < n_points; ++i) {
    scratch.residual[i] = std::abs(scratch.residual[i] - wanted[i]);
  }
}

double median_residual(PatchScratch& scratch) {
  scratch.order.assign(
      scratch.residual.begin(),
      scratch.residual.begin() + static_cast<std::ptrdiff_t>(scratch.taken.size()));
  const auto middle = scratch.order.begin() + static_cast<std::ptrdiff_t>(scratch.order.size() / 2);
  std::nth_element(scratch.order.begin(), middle, scratch.order.end());
  return *middle;
}

// The rms of what the solution has beyond degree 2, by Parseval on the opened hemisphere.
double detail_of(std::size_t n, const PatchScratch& scratch) {
  double sum = 0;
  for (std::size_t i = patch_basis(2); i < n; ++i) sum += scratch.solution[i] * scratch.solution[i];
  return std::sqrt(sum / (4 * std::numbers::pi));
}

void weigh_by_huber(double turn, PatchScratch& scratch) {
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    const double e = scratch.residual[i];
    scratch.weights[i] = scratch.base[i] * (e > turn ? turn / e : 1);
  }
}

void weigh_by_tukey(double forgotten, double halo, PatchScratch& scratch) {
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    const double part = scratch.residual[i] / forgotten;
    const double rest = std::max(0.0, 1 - part * part);
    scratch.weights[i] = scratch.base[i] * rest * rest;
  }
  // The flanks of what stands out would hold the fit where its middle was.
  const std::size_t n = padded(scratch.taken.size());
  const std::size_t n_taken = scratch.taken.size();
  const double* const x = scratch.offsets.data();
  double* const weights = scratch.weights.data();
  for (std::size_t i = 0; i < n_taken; ++i) {
    if (!(scratch.residual[i] > forgotten)) continue;
    for (std::size_t j = 0; j < n_taken; ++j) {
      const double dx = x[i] - x[j], dy = x[n + i] - x[n + j], dz = x[2 * n + i] - x[2 * n + j];
      weights[j] = dx * dx + dy * dy + dz * dz < halo * halo ? 0 : weights[j];
    }
  }
}

// Weights for the next solution, from what the last one leaves; returns the residual from which
// on points are forgotten, 0 if every point is fitted exactly.
double weigh_again(const PatchCap& cap, bool convex, PatchScratch& scratch) {
  find_residuals(scratch.solution.size(), scratch);
  const double median = median_residual(scratch);
  if (!(median > 0)) return 0;
  const double forgotten =
      std::max(kForgotten * median, kLeastScale * detail_of(scratch.solution.size(), scratch));
  if (convex) {
    weigh_by_huber(kTurn * median, scratch);
  } else {
    weigh_by_tukey(forgotten, kHalo * cap.frame.support / cap.degree, scratch);
  }
  return forgotten;
}

// The solution of the robust fit of some points; false if there is none.
bool solve_robustly(const LocalMesh& local, const PatchCap& cap,
                    std::span<const std::uint8_t> ignored, PatchScratch& scratch,
                    double& forgotten) {
  take_points(local, cap, kPointsForWeights, ignored, scratch);
  const int first = std::min(kFirstDegree, cap.degree);
  if (!solve(first, scratch)) return false;
  for (int i = 0; i < kConvex; ++i) {
    if (weigh_again(cap, true, scratch) == 0) break;
    if (!solve(first, scratch)) return false;
  }
  for (int degree = first;; degree = std::min(cap.degree, degree + kDegreeStep)) {
    forgotten = weigh_again(cap, false, scratch);
    if (!solve(degree, scratch)) return false;
    if (degree == cap.degree) break;
  }
  return true;
}

}  // namespace

PatchFit fit_patch_cap(const LocalMesh& local, const PatchCap& cap, bool robust,
                       std::span<const std::uint8_t> ignored, PatchScratch& scratch) {
  PatchFit fit;
  const auto count = std::count_if(cap.points.begin(), cap.points.end(), [&](std::uint32_t v) {
    return !ignored.empty() && ignored[v] != 0;
  });
  const double share = static_cast<double>(count) / static_cast<double>(cap.points.size());
  if (share > kMostIgnored) return fit;
  const std::size_t n = patch_basis(cap.degree);
  double forgotten = 0;
  if (robust && !solve_robustly(local, cap, ignored, scratch, forgotten)) return fit;
  take_points(local, cap, kPointsPerCoefficient, ignored, scratch);
  if (forgotten > 0) {
    find_residuals(n, scratch);
    weigh_by_tukey(forgotten, kHalo * cap.frame.support / cap.degree, scratch);
  }
  if (!solve(cap.degree, scratch)) return fit;
  fit.coefficients.assign(n * static_cast<std::size_t>(cap.degree + 1), 0);
  for (int d = 0; d <= cap.degree; ++d) {
    back_substitute(scratch.factor, n, patch_basis(d),
                    &fit.coefficients[n * static_cast<std::size_t>(d)]);
  }
  fit.forgotten = forgotten * cap.frame.radius;
  fit.solved = true;
  return fit;
}

void evaluate_patch_cap(const LocalMesh& local, const PatchCap& cap, const PatchFit& fit,
                        std::span<const std::uint32_t> points, PatchScratch& scratch,
                        double* values, std::size_t stride) {
  const std::size_t n = patch_basis(cap.degree);
  const std::size_t n_points = padded(points.size());
  fill_offsets(local, cap.frame, points, scratch);
  scratch.rows.resize((n + 5) * n_points);
  scratch.area.resize(n_points);
  patch_rows(cap.frame, cap.degree, scratch.offsets.data(), n_points, scratch.rows.data(),
             scratch.area.data());
  for (int d = 0; d <= cap.degree; ++d) {
    patch_sum(&scratch.rows[n_points], &fit.coefficients[n * static_cast<std::size_t>(d)],
              patch_basis(d), n_points, values + stride * static_cast<std::size_t>(d));
  }
}

}  // namespace rholm
