#include "reconstruct/caps/tile_caps.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "atlas/cap/cap_pole.h"
#include "atlas/cap/cap_support.h"
#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Number of caps that are read together: in the order of a tree, they lie near each other.
constexpr std::size_t kChunk = 1024;
constexpr std::size_t kGrain = 64;  // of a loop over caps
// Number of supports within which other caps influence the band of a cap (cap_bands.cpp).
constexpr double kBeside = 4;

void add(CapExtent& extent, const CapExtent& part) {
  if (part.n == 0) return;
  extent.middles = extent.n == 0 ? part.middles : joined(extent.middles, part.middles);
  extent.n += part.n, extent.coefficients += part.coefficients;
  extent.half_axis = std::max(extent.half_axis, part.half_axis);
  extent.support = std::max(extent.support, part.support);
  extent.deviation = std::max(extent.deviation, part.deviation);
}

CapExtent extent_of(const Cap& cap) {
  const Vec3 middle = support_middle(cap);
  return {.n = 1,
          .middles = {middle, middle},
          .half_axis = longer_half_axis(cap.where),
          .support = cap.frame.support,
          .deviation = cap.deviation};
}

bool meets(const Bounds& reach, std::span<const Bounds> boxes) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Bounds& box) { return meet(reach, box); });
}

std::vector<Bounds> met_by(const Bounds& reach, std::span<const Bounds> boxes) {
  std::vector<Bounds> some;
  std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(some),
               [&](const Bounds& box) { return meet(reach, box); });
  return some;
}

}  // namespace

Bounds grown(const Bounds& box, double by) {
  const Vec3 margin{by, by, by};
  return {box.min - margin, box.max + margin};
}

bool meet(const Bounds& a, const Bounds& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

Bounds joined(const Bounds& a, const Bounds& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y), std::min(a.min.z, b.min.z)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y), std::max(a.max.z, b.max.z)}};
}

Bounds CapExtent::reach(double least_band) const {
  return grown(middles, half_axis + std::max(least_band, band_of_support(support)) + deviation);
}

std::string TileCaps::name_of(const char* what, std::size_t tile) const {
  return what + round_ + "/" + std::to_string(tile);
}

void TileCaps::write_rejected(std::size_t tile, const std::vector<std::uint32_t>& places) {
  const std::span<const std::byte> sections[] = {bytes_of(places)};
  store_.write(name_of("rejected", tile), sections);
}

std::vector<std::uint32_t> TileCaps::rejected(std::size_t tile) const {
  return store_.open(name_of("rejected", tile)).values<std::uint32_t>(0);
}

// The sections of a chunk are parts of the lists of all caps: a store in memory makes no copies.
void TileCaps::write(std::size_t tile, Cover&& found, const Context& context) {
  const auto atlas = std::make_shared<Atlas>();
  atlas->caps = std::move(found.caps), atlas->coefficients = std::move(found.coefficients);
  const std::size_t n = atlas->caps.size();
  std::vector<CapPatch> patches(n);
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Cap& cap = atlas->caps[c];
      const CapFoot foot = cap_foot(*atlas, cap);
      patches[c] = {foot.point, foot.normal, cap.frame.support, cap.area, cap.error};
    }
  });
  std::vector<CapExtent> extents;
  std::vector<SectionBytes> sections(1);
  for (std::size_t begin = 0; begin < n; begin += kChunk) {
    const std::size_t end = std::min(n, begin + kChunk), first = atlas->caps[begin].first,
                      last = end < n ? atlas->caps[end].first : atlas->coefficients.size();
    CapExtent extent;
    for (std::size_t c = begin; c < end; ++c) {
      add(extent, extent_of(atlas->caps[c]));
      atlas->caps[c].first -= first;
    }
    extent.coefficients = last - first;
    extents.push_back(extent);
    sections.push_back(
        {bytes_of(std::span<const Cap>(atlas->caps).subspan(begin, end - begin)), atlas});
    sections.push_back(
        {bytes_of(std::span<const double>(atlas->coefficients).subspan(first, last - first)),
         atlas});
  }
  sections.front() = {bytes_of(extents)};
  write_values(store_, name_of("patches", tile), std::move(patches));
  store_.write(name_of("caps", tile), std::move(sections));
}

bool TileCaps::has(std::size_t tile) const { return store_.has(name_of("caps", tile)); }

void TileCaps::read_extents() {
  for (std::size_t tile = 0; tile < indices_.size(); ++tile) {
    Index& index = indices_[tile];
    index.chunks = store_.open(name_of("caps", tile)).values<CapExtent>(0);
    index.whole = {};
    for (const CapExtent& chunk : index.chunks) add(index.whole, chunk);
  }
}

std::vector<CapPatch> TileCaps::patches(std::size_t tile) const {
  return store_.open(name_of("patches", tile)).values<CapPatch>(0);
}

bool TileCaps::have_bands() const {
  return std::any_of(indices_.begin(), indices_.end(), [&](const Index& index) {
    return band_of_support(index.whole.support) > least_band();
  });
}

bool TileCaps::has_bands(std::size_t tile) const { return store_.has(name_of("bands", tile)); }

void TileCaps::find_bands(std::size_t tile, const Context& context) {
  Atlas atlas = scene_;
  std::size_t first = 0, n = 0;
  const CapExtent& own = extent(tile);
  const Bounds box = grown(own.middles, kBeside * own.support);
  for (std::size_t other = 0; other < indices_.size(); ++other) {
    if (other == tile) first = atlas.caps.size();
    if (own.n > 0) append(other, std::span(&box, 1), Which::kChunks, atlas, nullptr);
    if (other == tile) n = atlas.caps.size() - first;
  }
  const CapBands bands(atlas, step_, context);
  std::vector<double> found(n);
  for (std::size_t c = 0; c < n; ++c) found[c] = bands[first + c];
  const std::span<const std::byte> bytes = bytes_of(found);
  store_.write(name_of("bands", tile), {{bytes.begin(), bytes.end()}});
}

void TileCaps::append(std::size_t tile, std::span<const Bounds> boxes, Which which, Atlas& atlas,
                      std::vector<double>* bands) const {
  const Index& index = indices_[tile];
  if (index.whole.n == 0) return;
  const std::vector<Bounds> near = met_by(index.whole.reach(least_band()), boxes);
  if (near.empty()) return;
  const PieceReader piece = store_.open(name_of("caps", tile));
  std::vector<double> own_bands;
  if (bands != nullptr) {
    own_bands = store_.open(name_of("bands", tile)).values<double>(0);
  }
  std::size_t first = 0;  // cap of the chunk
  for (std::size_t k = 0; k < index.chunks.size(); first += index.chunks[k++].n) {
    const std::vector<Bounds> nearer = met_by(index.chunks[k].reach(least_band()), near);
    if (nearer.empty()) continue;
    const auto some = piece.values<Cap>(1 + 2 * k);
    const auto coefficients = piece.values<double>(2 + 2 * k);
    for (std::size_t c = 0; c < some.size(); ++c) {
      Cap cap = some[c];
      if (which == Which::kEach && !meets(extent_of(cap).reach(least_band()), nearer)) continue;
      const auto own = coefficients.begin() + static_cast<std::ptrdiff_t>(cap.first);
      cap.first = atlas.coefficients.size();
      atlas.caps.push_back(cap);
      atlas.coefficients.insert(
          atlas.coefficients.end(), own,
          own + static_cast<std::ptrdiff_t>(n_coefficients(cap.basis, cap.degree)));
      if (bands != nullptr) bands->push_back(own_bands.at(first + c));
    }
  }
}

Atlas TileCaps::all() const {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const Bounds space{{-kAnywhere, -kAnywhere, -kAnywhere}, {kAnywhere, kAnywhere, kAnywhere}};
  Atlas atlas = scene_;
  CapExtent whole;
  for (const Index& index : indices_) add(whole, index.whole);
  atlas.caps.reserve(whole.n), atlas.coefficients.reserve(whole.coefficients);
  for (std::size_t tile = 0; tile < indices_.size(); ++tile) {
    append(tile, std::span(&space, 1), Which::kChunks, atlas, nullptr);
  }
  return atlas;
}

void TileCaps::forget() {
  if (store_.is_kept()) return;
  for (std::size_t tile = 0; tile < indices_.size(); ++tile) {
    for (const char* what : {"caps", "patches", "rejected"}) store_.remove(name_of(what, tile));
  }
}

NearCaps TileCaps::near(std::span<const Bounds> boxes) const {
  Atlas atlas = scene_;
  std::vector<double> own;
  const bool have = have_bands();
  for (std::size_t tile = 0; tile < indices_.size(); ++tile) {
    append(tile, boxes, Which::kEach, atlas, have ? &own : nullptr);
  }
  NearCaps near{std::move(atlas), CapBands(least_band(), std::move(own)), {}};
  near.discs = discs_of(near.atlas, near.bands);
  return near;
}

}  // namespace rholm
