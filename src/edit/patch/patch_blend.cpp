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

// Caps whose contributions are held at once.
constexpr std::size_t kBatch = 64;
// What a cap says: for each point that it speaks for, its voice and how far along the ray through
// it the fit of each degree lies.
struct Speech {
  std::vector<std::uint32_t> points;
  std::vector<double> voices;
  std::vector<double> heights;  // over the centre
  std::vector<Vec3> rays;
  std::vector<double> lengths;  // [degree][point]
  std::size_t stride = 0;       // from one degree to the next
  double forgotten = 0;
};

void speak(const Site& site, const PatchCap& cap, bool robust, PatchScratch& scratch,
           Speech& speech) {
  speech.points.clear();
  speech.voices.clear();
  speech.rays.clear();
  const PatchFit fit = fit_patch_cap(site.local, cap, robust, site.ignored, scratch);
  if (!fit.solved) return;
  speech.forgotten = fit.forgotten;
  for (std::size_t i = 0; i < cap.points.size(); ++i) {
    if (!(cap.voices[i] > 0) || !(site.weights[cap.points[i]] > 0)) continue;
    speech.points.push_back(cap.points[i]);
    speech.voices.push_back(cap.voices[i]);
  }
  speech.stride = padded(speech.points.size());
  speech.lengths.resize((static_cast<std::size_t>(cap.degree) + 1) * speech.stride);
  evaluate_patch_cap(site.local, cap, fit, speech.points, scratch, speech.lengths.data(),
                     speech.stride);
  const std::size_t n = speech.points.size();
  speech.heights.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 offset = site.local.points[speech.points[i]] - cap.frame.center;
    speech.heights[i] = norm(offset);
    speech.rays.push_back(speech.heights[i] > 0 ? offset / speech.heights[i] : Vec3{});
  }
  for (std::size_t d = 0; d <= static_cast<std::size_t>(cap.degree); ++d) {
    double* const lengths = &speech.lengths[d * speech.stride];
    for (std::size_t i = 0; i < n; ++i) {
      lengths[i] = cap.frame.radius * (1 + lengths[i]) - speech.heights[i];
    }
  }
}

// The degrees of a cap whose waves are those of the patch's degrees.
std::array<std::size_t, kPatchDegrees> own_degrees(const PatchCap& cap) {
  std::array<std::size_t, kPatchDegrees> own;
  for (std::size_t d = 0; d < kPatchDegrees; ++d) {
    own[d] = static_cast<std::size_t>(
        std::min<long>(cap.degree, std::lround(static_cast<double>(d) * cap.size)));
  }
  return own;
}

// Sums in the order of the caps, whatever the threads did.
void add(const Speech& speech, const PatchCap& cap, Blend& blend) {
  const std::array<std::size_t, kPatchDegrees> own = own_degrees(cap);
  for (std::size_t i = 0; i < speech.points.size(); ++i) {
    const std::size_t row = blend.row[speech.points[i]];
    blend.voices[row] += speech.voices[i];
    blend.forgotten[row] += speech.voices[i] * speech.forgotten;
    const Vec3 said = speech.voices[i] * speech.rays[i];
    for (std::size_t d = 0; d < kPatchDegrees; ++d) {
      blend.moves[row * kPatchDegrees + d] += speech.lengths[own[d] * speech.stride + i] * said;
    }
  }
}

void divide(Blend& blend) {
  for (std::size_t row = 0; row < blend.voices.size(); ++row) {
    const double voice = blend.voices[row];
    if (!(voice > 0)) continue;
    blend.forgotten[row] /= voice;
    for (std::size_t d = 0; d < kPatchDegrees; ++d)
      blend.moves[row * kPatchDegrees + d] *= 1 / voice;
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
  blend.voices.assign(rows, 0);
  blend.forgotten.assign(rows, 0);
  blend.moves.assign(rows * kPatchDegrees, {});
  std::vector<Speech> speeches(std::min(kBatch, caps.size()));
  for (std::size_t first = 0; first < caps.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, caps.size() - first);
    const auto part = [&](std::size_t i) {
      return static_cast<double>(i) / static_cast<double>(caps.size());
    };
    const ParallelStage stage{"fit caps", part(first), part(first + count)};
    parallel_for(count, 4, context, stage, [&](std::size_t begin, std::size_t end) {
      PatchScratch scratch;
      for (std::size_t i = begin; i < end; ++i) {
        speak(site, caps[first + i], robust, scratch, speeches[i]);
      }
    });
    for (std::size_t i = 0; i < count; ++i) add(speeches[i], caps[first + i], blend);
  }
  divide(blend);
  return blend;
}

void follow_neighbours(const Site& site, Blend& blend) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < site.weights.size(); ++i) {
    if (site.weights[i] > 0 && !(blend.voices[blend.row[i]] > 0)) open.push_back(i);
  }
  for (std::size_t before = open.size() + 1; !open.empty() && open.size() < before;) {
    before = open.size();
    std::erase_if(open, [&](std::uint32_t i) {
      std::array<Vec3, kPatchDegrees> sum{};
      double count = 0;
      for (const std::uint32_t t : site.local.triangles_at(i)) {
        for (const std::uint32_t v : site.local.triangles[t]) {
          if (!(site.weights[v] > 0) || !(blend.voices[blend.row[v]] > 0)) continue;
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
      blend.voices[row] = 1;
      return true;
    });
  }
}

}  // namespace rholm
