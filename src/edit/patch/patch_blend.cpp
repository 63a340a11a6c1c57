#include "edit/patch/patch_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "edit/patch/patch_fit.h"
#include "edit/patch/patch_kernels.h"

namespace rholm {
namespace {

// Number of caps whose contributions are held at once.
constexpr std::size_t kBatch = 64;
// Contribution of a cap to the blend: at each point with a blend
// weight, the distance along its ray to the fit of each degree.
struct CapContribution {
  std::vector<std::uint32_t> points;
  std::vector<double> blend_weights;
  std::vector<double> heights;  // distance from the centre
  std::vector<Vec3> rays;
  std::vector<double> lengths;  // lengths [degree][point]
  std::size_t stride = 0;       // distance from one degree to the next in `lengths`
  double rejection = 0;         // see PatchFit::rejection
};

void contribute(const Site& site, const PatchCap& cap, bool robust, PatchScratch& scratch,
                CapContribution& contribution) {
  contribution.points.clear();
  contribution.blend_weights.clear();
  contribution.rays.clear();
  const PatchFit fit = fit_patch_cap(site.local, cap, robust, site.ignored, scratch);
  if (!fit.solved) return;
  contribution.rejection = fit.rejection;
  for (std::size_t i = 0; i < cap.points.size(); ++i) {
    if (!(cap.blend_weights[i] > 0) || !(site.weights[cap.points[i]] > 0)) continue;
    contribution.points.push_back(cap.points[i]);
    contribution.blend_weights.push_back(cap.blend_weights[i]);
  }
  contribution.stride = padded(contribution.points.size());
  contribution.lengths.resize((static_cast<std::size_t>(cap.degree) + 1) * contribution.stride);
  evaluate_patch_cap(site.local, cap, fit, contribution.points, scratch,
                     contribution.lengths.data(), contribution.stride);
  const std::size_t n = contribution.points.size();
  contribution.heights.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 offset = site.local.points[contribution.points[i]] - cap.frame.center;
    contribution.heights[i] = norm(offset);
    contribution.rays.push_back(contribution.heights[i] > 0 ? offset / contribution.heights[i]
                                                            : Vec3{});
  }
  for (std::size_t d = 0; d <= static_cast<std::size_t>(cap.degree); ++d) {
    double* const lengths = &contribution.lengths[d * contribution.stride];
    for (std::size_t i = 0; i < n; ++i) {
      lengths[i] = cap.frame.radius * (1 + lengths[i]) - contribution.heights[i];
    }
  }
}

// Returns the cap's degrees that have the same wavelengths as the patch's degrees.
std::array<std::size_t, kPatchDegrees> own_degrees(const PatchCap& cap) {
  std::array<std::size_t, kPatchDegrees> own;
  for (std::size_t d = 0; d < kPatchDegrees; ++d) {
    own[d] = static_cast<std::size_t>(
        std::min<long>(cap.degree, std::lround(static_cast<double>(d) * cap.size)));
  }
  return own;
}

// Sums in the order of the caps, so that the result does not depend on threads.
void add(const CapContribution& contribution, const PatchCap& cap, Blend& blend) {
  const std::array<std::size_t, kPatchDegrees> own = own_degrees(cap);
  for (std::size_t i = 0; i < contribution.points.size(); ++i) {
    const std::size_t row = blend.row[contribution.points[i]];
    blend.weight_sums[row] += contribution.blend_weights[i];
    blend.rejection[row] += contribution.blend_weights[i] * contribution.rejection;
    const Vec3 weighted_ray = contribution.blend_weights[i] * contribution.rays[i];
    for (std::size_t d = 0; d < kPatchDegrees; ++d) {
      blend.moves[row * kPatchDegrees + d] +=
          contribution.lengths[own[d] * contribution.stride + i] * weighted_ray;
    }
  }
}

void divide(Blend& blend) {
  for (std::size_t row = 0; row < blend.weight_sums.size(); ++row) {
    const double sum = blend.weight_sums[row];
    if (!(sum > 0)) continue;
    blend.rejection[row] /= sum;
    for (std::size_t d = 0; d < kPatchDegrees; ++d) blend.moves[row * kPatchDegrees + d] *= 1 / sum;
  }
}

}  // namespace

Blend blend_caps(const Site& site, const std::vector<PatchCap>& caps, bool robust,
                 const Context& context) {
  Blend blend;
  blend.row.resize(site.weights.size());
  std::uint32_t rows = 0;
  for (std::size_t i = 0; i < site.weights.size(); ++i) {
    if (site.weights[i] > 0) blend.row[i] = rows++;
  }
  blend.weight_sums.assign(rows, 0);
  blend.rejection.assign(rows, 0);
  blend.moves.assign(rows * kPatchDegrees, {});
  std::vector<CapContribution> contributions(std::min(kBatch, caps.size()));
  for (std::size_t first = 0; first < caps.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, caps.size() - first);
    const auto part = [&](std::size_t i) {
      return static_cast<double>(i) / static_cast<double>(caps.size());
    };
    const ParallelStage stage{"fit caps", part(first), part(first + count)};
    parallel_for(count, 4, context, stage, [&](std::size_t begin, std::size_t end) {
      PatchScratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        contribute(site, caps[first + i], robust, scratch, contributions[i]);
      }
    });
    for (std::size_t i = 0; i < count; ++i) add(contributions[i], caps[first + i], blend);
  }
  divide(blend);
  return blend;
}

void follow_neighbours(const Site& site, Blend& blend) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < site.weights.size(); ++i) {
    if (site.weights[i] > 0 && !(blend.weight_sums[blend.row[i]] > 0)) open.push_back(i);
  }
  for (std::size_t before = open.size() + 1; !open.empty() && open.size() < before;) {
    before = open.size();
    std::erase_if(open, [&](std::uint32_t i) {
      std::array<Vec3, kPatchDegrees> sum{};
      double count = 0;
      for (const std::uint32_t t : site.local.triangles_at(i)) {
        for (const std::uint32_t v : site.local.faces[t]) {
          if (!(site.weights[v] > 0) || !(blend.weight_sums[blend.row[v]] > 0)) continue;
          const Vec3* const moves = &blend.moves[blend.row[v] * kPatchDegrees];
          const Vec3 apart = site.local.points[v] - site.local.points[i];
          for (std::size_t d = 0; d < kPatchDegrees; ++d) sum[d] += apart + moves[d];
          ++count;
        }
      }
      if (count == 0) return false;
      const std::size_t row = blend.row[i];
      for (std::size_t d = 0; d < kPatchDegrees; ++d)
        blend.moves[row * kPatchDegrees + d] = sum[d] / count;
      blend.weight_sums[row] = 1;
      return true;
    });
  }
}

}  // namespace rholm
