#include "edit/patch_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/parallel.h"
#include "edit/patch_fit.h"

namespace rholm {
namespace {

// Caps whose contributions are held at once.
constexpr std::size_t kBatch = 64;
// Points of a cap that are evaluated at once: their rows stay in the second-level cache.
constexpr std::size_t kBlock = 256;
// What a cap says: for each point that it speaks for, its voice and where it wants the point to be
// for each degree of the patch, relative to where it is.
struct Speech {
  std::vector<std::uint32_t> points;
  std::vector<double> voices;
  std::vector<Vec3> moves;  // [point][degree]
  double forgotten = 0;
};

void speak(const Site& site, const PatchCap& cap, bool robust, PatchScratch& scratch,
           Speech& speech) {
  speech.points.clear();
  speech.voices.clear();
  const PatchFit fit = fit_patch_cap(site.local, cap, robust, site.ignored, scratch);
  if (!fit.solved) return;
  speech.forgotten = fit.forgotten;
  for (std::size_t i = 0; i < cap.points.size(); ++i) {
    if (!(cap.voices[i] > 0) || !(site.weights[cap.points[i]] > 0)) continue;
    speech.points.push_back(cap.points[i]);
    speech.voices.push_back(cap.voices[i]);
  }
  speech.moves.resize(speech.points.size() * kPatchDegrees);
  std::array<std::size_t, kPatchDegrees> own;  // degrees of this cap with the same waves
  for (std::size_t d = 0; d < kPatchDegrees; ++d) {
    own[d] = static_cast<std::size_t>(
        std::min<long>(cap.degree, std::lround(static_cast<double>(d) * cap.size)));
  }
  std::vector<double> values((static_cast<std::size_t>(cap.degree) + 1) * kBlock);
  for (std::size_t first = 0; first < speech.points.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, speech.points.size() - first);
    const std::span block(&speech.points[first], count);
    evaluate_patch_cap(site.local, cap, fit, block, scratch, values.data(), kBlock);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3& at = site.local.points[block[i]];
      const Vec3 u = normalized(at - cap.frame.center);
      for (std::size_t d = 0; d < kPatchDegrees; ++d) {
        const double r = cap.frame.radius * (1 + values[own[d] * kBlock + i]);
        speech.moves[(first + i) * kPatchDegrees + d] = cap.frame.center + r * u - at;
      }
    }
  }
}

// Sums in the order of the caps, whatever the threads did.
void add(const Speech& speech, Blend& blend) {
  for (std::size_t i = 0; i < speech.points.size(); ++i) {
    const std::size_t row = blend.row[speech.points[i]];
    blend.voices[row] += speech.voices[i];
    blend.forgotten[row] += speech.voices[i] * speech.forgotten;
    for (std::size_t d = 0; d < kPatchDegrees; ++d) {
      blend.moves[row * kPatchDegrees + d] +=
          speech.voices[i] * speech.moves[i * kPatchDegrees + d];
    }
  }
}

void divide(Blend& blend) {
  for (std::size_t row = 0; row < blend.voices.size(); ++row) {
    const double voice = blend.voices[row];
    if (!(voice > 0)) continue;
    blend.forgotten[row] /= voice;
    for (std::size_t d = 0; d < kPatchDegrees; ++d) {
      blend.moves[row * kPatchDegrees + d] = blend.moves[row * kPatchDegrees + d] / voice;
    }
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
    for (std::size_t i = 0; i < count; ++i) add(speeches[i], blend);
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
