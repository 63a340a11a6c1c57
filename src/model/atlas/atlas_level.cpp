#include "model/atlas/atlas_level.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atlas/compress/cap_level.h"
#include "atlas/compress/cap_samples.h"
#include "atlas/compress/cap_shares.h"
#include "model/atlas/atlas_fit.h"
#include "rholm/error.h"
#include "surface/star/area_samples.h"

namespace rholm {
namespace {

constexpr std::size_t kSamples = 100000;  // chosen: half as many as the finest models use
// Chosen: on a bunny, a single sweep leaves a level of 4 with 8 % more badly turned normals.
constexpr int kSweeps = 3;

// A slope above this angle that is due to disagreeing caps shows as a ledge.
constexpr double kLedgeAngle = 10 * std::numbers::pi / 180;
// Largest share of the surface that ledges may take beyond the share in the whole model. Chosen by
// pictures (scripts/atlas-figures --levels): above, plates show, mostly at degrees 1 and 2.
constexpr double kMoreLedges = 0.01;

// Where caps disagree, one grid may produce a handle that another does not: relative bands to try.
constexpr double kBands[] = {1, 1.5, 2, 0.7};

SampleLevels samples_of(const Mesh& surface, const Context& context) {
  const AreaSamples area = sample_by_area(surface, kSamples, 1);
  std::vector<Vec3> normals;
  normals.reserve(area.points.size());
  for (const std::uint32_t triangle : area.faces) {
    const Triangle& t = surface.faces[triangle];
    const Vec3& a = surface.vertices[t[0]];
    normals.push_back(normalized(cross(surface.vertices[t[1]] - a, surface.vertices[t[2]] - a)));
  }
  return make_levels(area.points, normals, context);
}

double ledges_of(const Atlas& atlas, const SampleLevel& samples, const Context& context) {
  return share_of_ledges(shares_of(atlas, samples, atlas.band, context), std::tan(kLedgeAngle));
}

Atlas fitted(const Atlas& atlas, int degree, const SampleLevel& samples, const Context& context) {
  Atlas level = at_degree(atlas, degree);
  const double lost = lost_at_degree(atlas, degree);
  if (!(lost > 0)) return level;
  const AgreeOptions options{.tolerance = lost, .band = level.band, .all = true};
  for (int sweep = 0; sweep < kSweeps; ++sweep) agree(samples, options, level, context);
  return level;
}

}  // namespace

LevelMaker::LevelMaker(const Atlas& atlas, const Mesh& surface, const Context& context)
    : atlas_(atlas), samples_(samples_of(surface, context)), context_(context) {
  most_ledges_ = ledges_of(atlas, samples_.finest(), context) + kMoreLedges;
}

AtlasLevel LevelMaker::at(int degree) const {
  AtlasLevel level{.degree = degree,
                   .atlas = fitted(atlas_, degree, samples_.finest(), context_),
                   .lost = lost_at_degree(atlas_, degree)};
  level.ledges = ledges_of(level.atlas, samples_.finest(), context_);
  level.usable = degree >= highest_degree(atlas_) || level.ledges <= most_ledges_;
  return level;
}

AtlasLevel LevelMaker::usable_from(int degree) const {
  AtlasLevel level = at(degree);
  while (!level.usable) level = at(level.degree + 1);
  return level;
}

AtlasLevel LevelMaker::usable_at(int degree) const {
  AtlasLevel level = at(degree);
  if (level.usable) return level;
  throw Error(ErrorCode::kUnsupported,
              fmt::format("caps of degree {} cannot agree where they meet: {:.1f} % of the surface "
                          "would be ledges between them; the least degree that will do for this "
                          "model is {}",
                          degree, 100 * level.ledges, usable_from(degree + 1).degree));
}

Mesh level_surface(const Atlas& level, const Mesh& whole, const AtlasSurfaceOptions& options,
                   const Context& context) {
  const Topology wanted = topology_of(inspect(whole));
  Mesh best;
  std::size_t least = std::numeric_limits<std::size_t>::max();  // wrong handles
  for (std::size_t i = 0; i < std::size(kBands) && least > 0; ++i) {
    if (i > 1 && least > kFewHandles && !best.faces.empty()) break;
    Atlas other = level;
    other.band *= kBands[i];
    Mesh surface = extract_atlas(other, options, context).mesh;
    if (surface.faces.empty()) continue;
    const std::size_t wrong = n_wrong_handles(topology_of(inspect(surface)), wanted);
    if (wrong < least) least = wrong, best = std::move(surface);
  }
  return best;
}

}  // namespace rholm
