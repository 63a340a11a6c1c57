#include "rholm/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/check_fields.h"
#include "base/refuse.h"
#include "edit/patch/patch_blend.h"
#include "edit/patch/rim_detail.h"
#include "edit/region/fading.h"
#include "edit/region/local_mesh.h"

namespace rholm {
namespace {

// Lower degrees represent the surface's position and curvature, not detail.
constexpr int kLowestDegree = 2;
// Least weight of a vertex in a bridged region; files may have fractional weights.
constexpr double kInRegion = 0.5;
// Width of the rim around a bridged region whose surface is
// compared with the fits, in wavelengths, and at least in edges.
constexpr double kRim = 0.5, kRimEdges = 4;
// Widest bridged region in wavelengths. The advised width is half a
// wavelength; at this width fits become undetermined in the middle.
constexpr double kWidestBridge = 0.8;
// A repair moves points within this distance of an outlier, in wavelengths, and fades
// over the second length. The flanks of a scratch deviate less than its middle.
constexpr double kRepairCore = 0.25, kRepairReach = 0.25;
// Least deviation of an outlier as a part of the wavelength, even if the fit is
// exact. Chosen: far below any detail, far above the rounding of coordinates.
constexpr double kLeastOutstanding = 1e-6;
// Largest coordinate, because fourth powers of coordinates are computed.
constexpr double kLargest = 1e70;

// Reduces weights to 0 away from points that deviate from the fits.
void keep_outstanding(const Blend& blend, double wavelength, Site& site) {
  std::vector<double> distance(site.weights.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (!(site.weights[i] > 0)) continue;
    const double off = norm(blend.moves[blend.row[i] * kPatchDegrees + kPatchDegree]);
    const double enough = std::max(blend.rejection[blend.row[i]], kLeastOutstanding * wavelength);
    if (off > enough) distance[i] = 0;
  }
  const double reach = kRepairReach * wavelength;
  march(site.local, kRepairCore * wavelength + reach, distance);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    site.weights[i] *= fading((distance[i] - kRepairCore * wavelength) / reach);
  }
}

Bounds bounds_of_weights(const Mesh& mesh, std::span<const double> weights) {
  std::vector<Vec3> inside;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0) inside.push_back(mesh.vertices[i]);
  }
  return bounds(inside);
}

void check_mesh(const Mesh& mesh, double wavelength) {
  validate(mesh);
  const Bounds box = bounds(mesh.vertices);
  const double diagonal = box.diagonal();
  if (!(diagonal < kLargest) || !(wavelength > 1 / kLargest) || !(wavelength < kLargest)) {
    refuse(fmt::format("lengths must be within {:g} ... {:g}; scale the shape", 1 / kLargest,
                       kLargest));
  }
  if (wavelength > diagonal) {
    refuse(fmt::format("the wavelength is {:g}, longer than the diagonal of the shape, {:g}",
                       wavelength, diagonal));
  }
}

// Marks the points of the regions; they and the points within `rim` get a weight.
void ignore_regions(const Mesh& mesh, std::span<const Region> regions, double rim, Site& site) {
  const std::vector<double> weights = region_weights(mesh, regions, 0);
  const std::size_t n = site.local.points.size();
  site.ignored.assign(n, 0);
  std::vector<double> distance(n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::uint32_t v : site.local.members_of(i)) {
      if (weights[v] >= kInRegion) site.ignored[i] = 1;
    }
    if (site.ignored[i] != 0) distance[i] = 0;
  }
  march(site.local, rim, distance);
  for (std::size_t i = 0; i < n; ++i) site.weights[i] = distance[i] <= rim ? 1 : 0;
}

Site make_site(const Mesh& mesh, std::span<const Region> regions, const PatchOptions& options) {
  const double transition = options.transition.value_or(options.wavelength);
  const std::vector<double> weights = region_weights(mesh, regions, transition);
  Bounds box = bounds_of_weights(mesh, weights);
  const double reach = kPatchRadius * options.wavelength;
  box.min -= {reach, reach, reach};
  box.max += {reach, reach, reach};
  Site site;
  site.local = cut_out(mesh, box);
  site.weights.assign(site.local.points.size(), 0);
  for (std::size_t i = 0; i < site.weights.size(); ++i) {
    for (const std::uint32_t v : site.local.members_of(i)) {
      site.weights[i] = std::max(site.weights[i], weights[v]);
    }
  }
  const double spacing = median_edge(site.local.points, site.local.faces, site.weights);
  if (options.wavelength < kFewestEdges * spacing) {
    refuse(
        fmt::format("a wavelength of {:g} is not in the mesh, whose edges are {:g} long in the "
                    "region; take {:g} or more",
                    options.wavelength, spacing, kFewestEdges * spacing));
  }
  if (options.fitting == PatchFitting::kAround) {
    ignore_regions(mesh, regions, std::max(kRim * options.wavelength, kRimEdges * spacing), site);
  }
  return site;
}

// Throws if a region left out of the fits is too wide for waves to span it.
void check_bridged(const Site& site, double wavelength) {
  if (site.ignored.empty()) return;
  if (std::find(site.ignored.begin(), site.ignored.end(), 1) == site.ignored.end()) {
    refuse(
        fmt::format("no vertex has a weight of {:g} or more: nothing is to be bridged", kInRegion));
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> inwards(site.ignored.size());
  for (std::size_t i = 0; i < inwards.size(); ++i) inwards[i] = site.ignored[i] ? kInfinity : 0;
  march(site.local, kLargest, inwards);
  const double widest = 2 * *std::max_element(inwards.begin(), inwards.end());
  if (widest <= kWidestBridge * wavelength) return;
  refuse(widest < kInfinity
             ? fmt::format("the region is {:g} wide, too wide to be bridged by waves of {:g}; take "
                           "a wavelength of {:g} or more",
                           widest, wavelength, widest / kWidestBridge)
             : std::string("a part of the region has nothing around it that could be bridged"));
}

}  // namespace

EnumNames names_of(PatchFitting) {
  static constexpr std::array kNames = {"mean", "robust", "around"};
  return {"fitting", kNames};
}

Patch analyze_patch(const Mesh& mesh, std::span<const Region> regions, const PatchOptions& options,
                    const Context& context) {
  check_fields(options);
  check_mesh(mesh, options.wavelength);
  if (regions.empty()) refuse("there is no region to work on; give one");
  Site site = make_site(mesh, regions, options);
  check_bridged(site, options.wavelength);
  const std::vector<PatchCap> caps = cover_patch(site.local, site.weights, options.wavelength);
  const bool robust = options.fitting != PatchFitting::kMean || options.repair;
  Blend blend = blend_caps(site, caps, robust, context);
  follow_neighbours(site, blend);
  if (options.fitting == PatchFitting::kAround) {
    carry_rim_detail(site, blend);
    for (std::size_t i = 0; i < site.weights.size(); ++i) site.weights[i] = site.ignored[i];
  }
  if (options.repair) keep_outstanding(blend, options.wavelength, site);
  Patch patch;
  patch.wavelength = options.wavelength;
  patch.degree = kPatchDegree;
  patch.caps = caps.size();
  patch.moves.reserve(blend.moves.size());
  for (std::size_t i = 0; i < site.weights.size(); ++i) {
    if (!(site.weights[i] > 0)) continue;
    const std::size_t row = blend.row[i];
    for (const std::uint32_t v : site.local.members_of(i)) {
      if (!(blend.weight_sums[row] > 0)) {
        ++patch.unreached;
        continue;
      }
      patch.vertices.push_back(v);
      patch.positions.push_back(mesh.vertices[v]);
      patch.weights.push_back(site.weights[i]);
      const Vec3* const moves = &blend.moves[row * kPatchDegrees];
      patch.moves.insert(patch.moves.end(), moves, moves + kPatchDegrees);
    }
  }
  return patch;
}

double longest_wavelength(const Patch& patch) {
  return patch.wavelength * patch.degree / kLowestDegree;
}

std::vector<Vec3> update(const Patch& patch, const PatchUpdate& wanted) {
  const double wavelength = wanted.wavelength == 0 ? patch.wavelength : wanted.wavelength;
  if (!(wavelength >= patch.wavelength) || !(wavelength <= longest_wavelength(patch))) {
    refuse(fmt::format("the patch is made for wavelengths {:g} ... {:g}, not {:g}",
                       patch.wavelength, longest_wavelength(patch), wavelength));
  }
  if (!std::isfinite(wanted.strength)) refuse("the strength must be finite");
  if (wanted.strength == 0) return patch.positions;
  // Between two degrees, the mean of their fits is taken.
  const double cut = patch.degree * patch.wavelength / wavelength;
  const auto low = std::min(static_cast<std::size_t>(cut), static_cast<std::size_t>(patch.degree));
  const double part = cut - static_cast<double>(low);
  const std::size_t high = std::min(low + 1, static_cast<std::size_t>(patch.degree));
  const auto n_degrees = static_cast<std::size_t>(patch.degree + 1);
  std::vector<Vec3> moved(patch.vertices.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vec3* const moves = &patch.moves[i * n_degrees];
    const Vec3 whole = (1 - part) * moves[low] + part * moves[high];
    moved[i] = patch.positions[i] + wanted.strength * patch.weights[i] * whole;
  }
  return moved;
}

void apply(const Patch& patch, std::span<const Vec3> positions, Mesh& mesh) {
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    mesh.vertices[patch.vertices[i]] = positions[i];
  }
  update_normals(mesh, patch.vertices);
}

}  // namespace rholm
