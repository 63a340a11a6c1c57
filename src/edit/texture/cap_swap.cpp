#include "edit/texture/cap_swap.h"

#include <cmath>

#include "edit/patch/patch_fit.h"
#include "edit/patch/patch_kernels.h"
#include "rholm/error.h"
#include "rholm/transfer.h"

namespace rholm {
namespace {

struct FittedCap {
  PatchCap cap;
  PatchFit fit;
};

// Fits one cap to the whole region.
FittedCap fit_region(const TexturedPatch& textured, PatchScratch& scratch) {
  FittedCap fitted;
  fitted.cap.frame = textured.chart.frame;
  for (std::uint32_t i = 0; i < textured.local.points.size(); ++i) {
    const std::uint32_t row = textured.row[i];
    if (row == kNoRow || textured.patch.weights[row] < 1) continue;
    fitted.cap.points.push_back(i);
    fitted.cap.blend_weights.push_back(1);
  }
  fitted.cap.degree = kMaxSwapDegree;
  while (fitted.cap.degree > 0 && 1.5 * static_cast<double>(patch_basis(fitted.cap.degree)) >
                                      static_cast<double>(fitted.cap.points.size())) {
    --fitted.cap.degree;
  }
  fitted.fit = fit_patch_cap(textured.local, fitted.cap, false, {}, scratch);
  if (!fitted.fit.solved) {
    throw Error(ErrorCode::kInvalidInput, "the region has too few points for a cap of its own");
  }
  return fitted;
}

// Returns the highest degree's coefficients in the order of the basis, turned about the axis.
std::vector<double> turned(const FittedCap& fitted, double angle) {
  const std::size_t n = patch_basis(fitted.cap.degree);
  const auto last = fitted.fit.coefficients.end();
  std::vector<double> c(last - static_cast<std::ptrdiff_t>(n), last);
  for_each_patch_harmonic(fitted.cap.degree, [&](int, int m, std::size_t index) {
    if (m == 0) return;
    const double cosine = std::cos(m * angle), sine = std::sin(m * angle);
    const double a = c[index], b = c[index + 1];
    c[index] = cosine * a - sine * b;
    c[index + 1] = sine * a + cosine * b;
  });
  return c;
}

}  // namespace

std::vector<Vec3> swap_coefficients(const TexturedPatch& source, const TexturedPatch& target,
                                    int from_degree, double angle, double height) {
  PatchScratch scratch;
  const FittedCap from = fit_region(source, scratch), to = fit_region(target, scratch);
  const std::vector<double> theirs = turned(from, angle), own = turned(to, 0);
  // Change of the target's radius.
  FittedCap change = to;
  change.cap.degree = std::min(from.cap.degree, to.cap.degree);
  const std::size_t n = patch_basis(change.cap.degree);
  const auto sets = static_cast<std::size_t>(change.cap.degree);
  change.fit.coefficients.assign(n * (sets + 1), 0);
  double* const set = &change.fit.coefficients[n * sets];
  for (std::size_t i = patch_basis(std::min(from_degree, change.cap.degree)); i < n; ++i) {
    set[i] = height * theirs[i] - own[i];
  }
  const std::size_t stride = padded(to.cap.points.size());
  std::vector<double> values(stride * (sets + 1));
  evaluate_patch_cap(target.local, change.cap, change.fit, to.cap.points, scratch, values.data(),
                     stride);
  std::vector<Vec3> positions = target.patch.positions;
  const CapFrame& frame = to.cap.frame;
  for (std::size_t i = 0; i < to.cap.points.size(); ++i) {
    const std::uint32_t point = to.cap.points[i];
    const Vec3 u = normalized(target.local.points[point] - frame.center);
    positions[target.row[point]] += frame.radius * values[sets * stride + i] * u;
  }
  return positions;
}

}  // namespace rholm
