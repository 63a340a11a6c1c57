#include "model/atlas/outer_samples.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/queries/sheet_gaps.h"
#include "surface/star/area_samples.h"

namespace rholm {
namespace {

constexpr std::size_t kProbes = 5000;
// Part of the diagonal: for closer sheets, rays cannot tell on which side of both they start.
constexpr double kLeastGap = 1e-5;
constexpr double kMostInverted = 1e-3;  // share of probes; a smaller share may be rounding

// Returns the samples on the outside; `inverted` counts the samples of parts that are inside out.
AreaSamples outer_of(const OuterSurface& surface, std::size_t n, std::size_t& inverted,
                     const Context& context) {
  AreaSamples all = sample_by_area(surface.mesh, n, surface.seed);
  inverted = 0;
  if (!surface.closed) return all;
  const std::vector<int> winding =
      outer_winding({surface.mesh, all.points, all.faces}, surface.scene, context);
  AreaSamples outer;
  for (std::size_t i = 0; i < n; ++i) {
    inverted += winding[i] < 0;
    if (winding[i] > 0) continue;
    outer.points.push_back(all.points[i]);
    outer.faces.push_back(all.faces[i]);
  }
  return outer;
}

// Returns the gap that a share `thin` of the points falls below.
double gap_of(const OuterSurface& surface, const AreaSamples& on, double thin,
              const Context& context) {
  std::vector<double> gaps =
      sheet_gaps({surface.mesh, on.points, on.faces}, surface.scene, context);
  const auto at =
      gaps.begin() + static_cast<std::ptrdiff_t>(thin * static_cast<double>(gaps.size() - 1));
  std::nth_element(gaps.begin(), at, gaps.end());
  return *at;
}

}  // namespace

SheetProbe probe_sheets(const OuterSurface& surface, double thin, const Context& context) {
  const AreaSamples all = sample_by_area(surface.mesh, kProbes, surface.seed);
  const double gap = gap_of(surface, all, thin, context);
  if (!surface.closed || gap < kLeastGap * bounds(surface.mesh.vertices).diagonal()) {
    return {gap, 0};
  }
  std::size_t inverted = 0;
  const AreaSamples outer = outer_of(surface, kProbes, inverted, context);
  const double share = static_cast<double>(inverted) / static_cast<double>(kProbes);
  if (share > kMostInverted || outer.points.empty()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{:.2g} % of the surface faces into the solid: parts of it are inside "
                            "out; 'rholm repair' turns them",
                            100 * share));
  }
  return {gap_of(surface, outer, thin, context),
          1 - static_cast<double>(outer.points.size()) / static_cast<double>(kProbes)};
}

OrientedPoints outer_samples(const OuterSurface& surface, std::size_t n, const Context& context) {
  std::size_t inverted = 0;
  AreaSamples outer = outer_of(surface, n, inverted, context);
  OrientedPoints samples;
  samples.points = std::move(outer.points);
  for (const std::uint32_t t : outer.faces) {
    const Triangle& triangle = surface.mesh.faces[t];
    samples.normals.push_back(
        normalized(face_normal(scaled_corners(surface.mesh, triangle, 1)).twice_area));
  }
  return samples;
}

}  // namespace rholm
