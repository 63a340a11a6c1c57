// Fits a cap's points by least squares: phi = r / R_0 - 1 in the patch harmonics of the opened
// sphere. Area there is the weight, so that the fit is close to a projection onto them.
//
// The robust fit reweights from low to high degree, because a low degree cannot follow a
// scratch. Points far off the fit, and points near them, are left out (Tukey's measure).
// They return only if a higher degree, fitted without them, agrees. The first solutions
// use Huber's measure, which is convex, so the result does not depend on the start.
#include "edit/patch/patch_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/poison.h"
#include "base/random.h"
#include "edit/patch/patch_kernels.h"

namespace rholm {
namespace {

// Points per coefficient for fits that only detect outliers, and for the last
// fit, which averages. The last fit leaves 1 / sqrt(n) of the finer detail with
// n points, half of that where caps overlap. Every cap draws its own points.
constexpr double kPointsForWeights = 6;
constexpr double kPointsPerCoefficient = 400;
// If there are at most this many times the first number, all points are used in both fits.
constexpr double kFew = 1.5;
// Factor of (l (l + 1))^2 relative to the weights; it matters only for undetermined fits.
constexpr double kPenalty = 1e-8;
// Largest share of ignored points; with more, the region is guessed, not bridged. A region
// half a wavelength wide is a sixth of a cap, and a third of a cap that had to shrink.
constexpr double kMostIgnored = 0.45;
// Smaller pivots have lost too many digits.
constexpr double kLeastPivot = 1e-12;
constexpr int kFirstDegree = 2, kDegreeStep = 2, kConvex = 3;
// Where Huber's measure turns linear, in medians of |e|; 1.48 medians are a standard deviation.
constexpr double kTurn = 1;
// Residual at which Tukey's measure rejects points, in medians too, and the
// halo of a rejected point in half wavelengths. On scratches 0.4 wavelengths
// wide (scripts/constants), 4 ... 7 and 0.5 ... 1 are equally good. The
// scratch disappears five times as well as with the convex measure alone.
constexpr double kRejection = 5;
constexpr double kHalo = 0.8;
// Least rejection as a share of the detail in the fit. On perfectly smooth
// surroundings the smallest misfit of a wide feature would otherwise be an outlier.
constexpr double kLeastScale = 0.05;

// Chooses about `wanted` points, distributed over the cap.
void choose_points(const PatchCap& cap, double wanted, std::span<const std::uint8_t> ignored,
                   PatchScratch& scratch) {
  const double share = wanted / static_cast<double>(cap.points.size());
  scratch.taken.clear();
  for (const std::uint32_t v : cap.points) {
    if (!ignored.empty() && ignored[v] != 0) continue;
    if (share >= 1 || random_uniform(cap.points.front(), v) < share) scratch.taken.push_back(v);
  }
}

// Returns the block length; a small number of points forms one block with rows made once.
std::size_t block_length(std::size_t n) { return n <= 2 * kPatchBlock ? n : kPatchBlock; }

void fill_offsets(const LocalMesh& local, const CapFrame& frame,
                  std::span<const std::uint32_t> points, PatchScratch& scratch) {
  const std::size_t n = padded(points.size());
  const Vec3 seed = frame.seed();
  scratch.offsets.resize(3 * n);
  poison_scratch(std::span(scratch.offsets));
  for (std::size_t first = 0; first < n; first += block_length(n)) {
    const std::size_t m = std::min(block_length(n), n - first);
    double* const x = &scratch.offsets[3 * first];
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t at = first + i;
      const Vec3 offset = at < points.size() ? local.points[points[at]] - seed : Vec3{};
      x[i] = offset.x, x[m + i] = offset.y, x[2 * m + i] = offset.z;
    }
  }
}

// Computes the weights of a block's m points before robust weighting:
// area on the opened sphere, less at the rim, 0 for the padding.
void base_weights(const LocalMesh& local, const PatchCap& cap, std::size_t first, std::size_t m,
                  PatchScratch& scratch) {
  const double support2 = cap.frame.support * cap.frame.support;
  const double* const x = &scratch.offsets[3 * first];
  for (std::size_t i = 0; i < m; ++i) {
    double& weight = scratch.base[first + i];
    weight = 0;
    if (first + i >= scratch.taken.size()) continue;
    const Vec3 offset = {x[i], x[m + i], x[2 * m + i]};
    const double rim = 1.15 - std::min(1.0, dot(offset, offset) / support2);  // see method 7.8
    weight = local.areas[scratch.taken[first + i]] * scratch.area[first + i] * rim;
  }
}

// Calls visit(first, m) for each block of chosen points, with its rows and base weights. The rows
// of several blocks are recomputed each time, which is faster than reading them from memory.
template <class Visit>
void for_each_block(const LocalMesh& local, const PatchCap& cap, PatchScratch& scratch,
                    const Visit& visit) {
  const std::size_t n = padded(scratch.taken.size());
  for (std::size_t first = 0; first < n; first += block_length(n)) {
    const std::size_t m = std::min(block_length(n), n - first);
    if (!scratch.rows_made) {
      patch_rows(cap.frame, cap.degree, &scratch.offsets[3 * first], m, scratch.rows.data(),
                 &scratch.area[first]);
      clear_beyond(scratch.rows.data(), 1 + patch_basis(cap.degree), m);
      base_weights(local, cap, first, m, scratch);
    }
    scratch.rows_made = m == n;
    visit(first, m);
  }
}

// Returns the solutions of the leading equations of degree 0, 1, ... `degree` in sequence.
std::vector<double> solve_family(int degree, PatchScratch& scratch) {
  std::vector<std::size_t> sizes;
  for (int d = 0; d <= degree; ++d) sizes.push_back(patch_basis(d));
  std::vector<double> coefficients;
  scratch.factor.solve_nested(sizes, coefficients);
  return coefficients;
}

// Makes and factors the normal equations of the chosen points.
bool make_equations(const LocalMesh& local, const PatchCap& cap, int degree,
                    PatchScratch& scratch) {
  const std::size_t n = patch_basis(degree);
  if (scratch.taken.size() < n) return false;
  scratch.matrix.assign((n + 1) * (n + 1), 0);
  const std::vector<double>& weights = scratch.weights.empty() ? scratch.base : scratch.weights;
  for_each_block(local, cap, scratch, [&](std::size_t first, std::size_t m) {
    add_normal_matrix({.rows = scratch.rows.data(),
                       .count = n + 1,
                       .length = m,
                       .stride = m,
                       .weights = &weights[first]},
                      scratch.matrix.data());
  });
  double sum = 0;
  for (const double w : weights) sum += w;
  for (int l = 1; l <= degree; ++l) {
    const double square = static_cast<double>(l) * (l + 1) * l * (l + 1);
    for (std::size_t i = patch_basis(l - 1); i < patch_basis(l); ++i) {
      scratch.matrix[normal_diagonal(i, n)] += kPenalty * sum * square;
    }
  }
  return scratch.factor.factor(scratch.matrix.data(), n, kLeastPivot) == n;
}

bool solve(const LocalMesh& local, const PatchCap& cap, int degree, PatchScratch& scratch) {
  if (!make_equations(local, cap, degree, scratch)) return false;
  scratch.factor.solve(patch_basis(degree), scratch.solution);
  return true;
}

// Chooses points and gives all of them their base weights.
void take_points(const LocalMesh& local, const PatchCap& cap, double per_coefficient,
                 std::span<const std::uint8_t> ignored, PatchScratch& scratch) {
  const std::size_t n = patch_basis(cap.degree);
  choose_points(cap, per_coefficient * static_cast<double>(n), ignored, scratch);
  const std::size_t n_points = padded(scratch.taken.size());
  fill_offsets(local, cap.frame, scratch.taken, scratch);
  scratch.rows.resize((n + 5) * block_length(n_points));
  scratch.area.resize(n_points);
  poison_scratch(std::span(scratch.rows));
  poison_scratch(std::span(scratch.area));
  scratch.base.resize(n_points);
  poison_scratch(std::span(scratch.base));
  scratch.weights.clear();
  scratch.rows_made = false;
}

double halo_of(const PatchCap& cap) { return kHalo * cap.frame.support / cap.degree; }

// Computes |e| of the solution at the points.
void find_residuals(const LocalMesh& local, const PatchCap& cap, PatchScratch& scratch) {
  scratch.residual.resize(padded(scratch.taken.size()));
  poison_scratch(std::span(scratch.residual));
  for_each_block(local, cap, scratch, [&](std::size_t first, std::size_t m) {
    double* const residual = &scratch.residual[first];
    const double* const wanted = scratch.rows.data();
    patch_sum(wanted + m, scratch.solution.data(), scratch.solution.size(), m, residual);
    for (std::size_t i = 0; i < m; ++i) residual[i] = std::abs(residual[i] - wanted[i]);
  });
}

double median_residual(PatchScratch& scratch) {
  scratch.order.assign(
      scratch.residual.begin(),
      scratch.residual.begin() + static_cast<std::ptrdiff_t>(scratch.taken.size()));
  const auto middle = scratch.order.begin() + static_cast<std::ptrdiff_t>(scratch.order.size() / 2);
  std::nth_element(scratch.order.begin(), middle, scratch.order.end());
  return *middle;
}

// Returns the rms of the solution beyond degree 2, by Parseval on the opened hemisphere.
double detail_of(std::size_t n, const PatchScratch& scratch) {
  double sum = 0;
  for (std::size_t i = patch_basis(2); i < n; ++i) sum += scratch.solution[i] * scratch.solution[i];
  return std::sqrt(sum / (4 * std::numbers::pi));
}

void weigh_by_huber(double turn, PatchScratch& scratch) {
  scratch.weights = scratch.base;
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    const double e = scratch.residual[i];
    scratch.weights[i] = scratch.base[i] * (e > turn ? turn / e : 1);
  }
}

void weigh_by_tukey(double rejection, double halo, PatchScratch& scratch) {
  scratch.weights = scratch.base;
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    const double part = scratch.residual[i] / rejection;
    const double rest = std::max(0.0, 1 - part * part);
    scratch.weights[i] *= rest * rest;
  }
  // Without a halo, the flanks of a rejected feature would hold the fit at the feature.
  const std::size_t n = padded(scratch.taken.size()), length = block_length(n);
  for (std::size_t i = 0; i < scratch.taken.size(); ++i) {
    if (!(scratch.residual[i] > rejection)) continue;
    const std::size_t own = i / length * length, own_m = std::min(length, n - own);
    const double* const x = &scratch.offsets[3 * own + i - own];
    const double at[3] = {x[0], x[own_m], x[2 * own_m]};
    for (std::size_t first = 0; first < n; first += length) {
      const std::size_t m = std::min(length, n - first);
      zero_weights_within(&scratch.offsets[3 * first], m, at, halo, &scratch.weights[first]);
    }
  }
}

// Computes the next weights from the residuals of the last solution. Returns the
// residual at which points are rejected, or 0 if every point is fitted exactly.
double weigh_again(const LocalMesh& local, const PatchCap& cap, bool convex,
                   PatchScratch& scratch) {
  find_residuals(local, cap, scratch);
  const double median = median_residual(scratch);
  if (!(median > 0)) return 0;
  const double rejection =
      std::max(kRejection * median, kLeastScale * detail_of(scratch.solution.size(), scratch));
  if (convex) {
    weigh_by_huber(kTurn * median, scratch);
  } else {
    weigh_by_tukey(rejection, halo_of(cap), scratch);
  }
  return rejection;
}

// Solves the robust fit of the chosen points; returns false if there is no solution.
bool solve_robustly(const LocalMesh& local, const PatchCap& cap, PatchScratch& scratch,
                    double& rejection) {
  const int first = std::min(kFirstDegree, cap.degree);
  if (!solve(local, cap, first, scratch)) return false;
  for (int i = 0; i < kConvex; ++i) {
    if (weigh_again(local, cap, true, scratch) == 0) break;
    if (!solve(local, cap, first, scratch)) return false;
  }
  for (int degree = first;; degree = std::min(cap.degree, degree + kDegreeStep)) {
    rejection = weigh_again(local, cap, false, scratch);
    if (!solve(local, cap, degree, scratch)) return false;
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
  const double some = kPointsForWeights * static_cast<double>(patch_basis(cap.degree));
  const bool few = static_cast<double>(cap.points.size()) <= kFew * some;
  double rejection = 0;
  if (robust) {
    take_points(local, cap, few ? kPointsPerCoefficient : kPointsForWeights, ignored, scratch);
    if (!solve_robustly(local, cap, scratch, rejection)) return fit;
  }
  if (!robust || !few) take_points(local, cap, kPointsPerCoefficient, ignored, scratch);
  if (rejection > 0) {
    find_residuals(local, cap, scratch);
    weigh_by_tukey(rejection, halo_of(cap), scratch);
  }
  if (!make_equations(local, cap, cap.degree, scratch)) return fit;
  fit.coefficients = solve_family(cap.degree, scratch);
  fit.rejection = rejection * cap.frame.radius;
  fit.solved = true;
  return fit;
}

void evaluate_patch_cap(const LocalMesh& local, const PatchCap& cap, const PatchFit& fit,
                        std::span<const std::uint32_t> points, PatchScratch& scratch,
                        double* values, std::size_t stride) {
  const std::size_t n = patch_basis(cap.degree), n_points = padded(points.size());
  fill_offsets(local, cap.frame, points, scratch);
  scratch.rows.resize((n + 5) * block_length(n_points));
  scratch.area.resize(n_points);
  poison_scratch(std::span(scratch.rows));
  poison_scratch(std::span(scratch.area));
  for (std::size_t first = 0; first < n_points; first += block_length(n_points)) {
    const std::size_t m = std::min(block_length(n_points), n_points - first);
    patch_rows(cap.frame, cap.degree, &scratch.offsets[3 * first], m, scratch.rows.data(),
               &scratch.area[first]);
    patch_sums(&scratch.rows[m], fit.coefficients.data(), cap.degree, m, values + first, stride);
  }
}

}  // namespace rholm
