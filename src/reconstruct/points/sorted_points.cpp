#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "reconstruct/points/tile_points.h"
#include "rholm/error.h"
#include "shape/points/place_lattice.h"
#include "shape/queries/morton.h"

namespace rholm {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

// Sorts by the highest 36 bits of 63, digit by digit, the lowest first. Items with equal bits keep
// their order. A million points of a surface rarely agree in 12 bits per axis.
constexpr int kBits = 12, kDigits = 3;  // chosen: counts stay in the first cache
constexpr int kLowest = 3 * kMortonLevels - kBits * kDigits;

void sort_by_high_bits(std::vector<Keyed>& items) {
  constexpr std::size_t kValues = std::size_t{1} << kBits;
  const auto digit = [](std::uint64_t key, int d) {
    return key >> (kLowest + kBits * d) & (kValues - 1);
  };
  std::vector<std::array<std::uint32_t, kValues>> counts(kDigits);
  for (auto& count : counts) count.fill(0);
  for (const Keyed& item : items) {
    for (int d = 0; d < kDigits; ++d) ++counts[static_cast<std::size_t>(d)][digit(item.key, d)];
  }
  std::vector<Keyed> other(items.size());
  for (int d = 0; d < kDigits; ++d) {
    auto& places = counts[static_cast<std::size_t>(d)];
    const bool same = std::any_of(places.begin(), places.end(),
                                  [&](std::uint32_t c) { return c == items.size(); });
    if (same) continue;
    std::uint32_t next = 0;
    for (std::uint32_t& place : places) next += std::exchange(place, next);
    for (const Keyed& item : items) other[places[digit(item.key, d)]++] = item;
    items.swap(other);
  }
}

PointCloud read_raw(const PieceReader& piece, const PointLayout& layout) {
  std::uint64_t bytes = 0;
  for (std::size_t k = 0; k < piece.n_sections(); ++k) bytes += piece.size(k);
  const std::uint64_t n = bytes / layout.row_bytes();
  if (n >= 0xffffffffU) {
    throw Error(ErrorCode::kUnsupported,
                "a tile has 2^32 points or more: nearly all points lie at one place");
  }
  PointCloud cloud = empty_cloud(layout);
  reserve_rows(layout, n, cloud);
  for (std::size_t k = 0; k < piece.n_sections(); ++k) {
    take_rows(layout, piece.read(k), cloud);
    ask_cancel();
  }
  return cloud;
}

// Returns the indices of the points in their order.
std::vector<std::uint32_t> order_of(const PointCloud& cloud) {
  const Bounds box = bounds(cloud.points);
  const Vec3 size = box.max - box.min, middle = 0.5 * box.min + 0.5 * box.max;
  const double longest = std::max({size.x, size.y, size.z});
  const double scale = longest > 0 ? 2 / longest : 0;
  std::vector<Keyed> items(cloud.points.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    items[i] = {morton(scale * (cloud.points[i] - middle)), i};
  }
  sort_by_high_bits(items);
  const auto is_before = [&](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    const Vec3 &p = cloud.points[a.index], &q = cloud.points[b.index];
    if (!(p == q)) return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    if (cloud.normals.empty()) return a.index < b.index;
    const Vec3 &m = cloud.normals[a.index], &n = cloud.normals[b.index];
    return std::tie(m.x, m.y, m.z, a.index) < std::tie(n.x, n.y, n.z, b.index);
  };
  for (auto begin = items.begin(); begin != items.end();) {
    auto end = begin + 1;
    while (end != items.end() && end->key >> kLowest == begin->key >> kLowest) ++end;
    if (end - begin > 1) std::sort(begin, end, is_before);
    begin = end;
  }
  std::vector<std::uint32_t> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& from) {
  std::vector<T> gathered(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) gathered[i] = values[from[i]];
  values.swap(gathered);
}

// Moves the values that are kept to the front.
template <class T>
void keep_first(std::vector<T>& values, const std::vector<std::uint32_t>& first) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) values[kept++] = values[i];
  }
  values.resize(kept);
}

// Removes points without a normal, which are of no use where others have one.
void drop_zero_normals(PointCloud& cloud, std::vector<std::uint32_t>& order) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!(norm(cloud.normals[i]) > 0)) continue;
    cloud.points[kept] = cloud.points[i], cloud.normals[kept] = cloud.normals[i];
    order[kept++] = order[i];
  }
  cloud.points.resize(kept), cloud.normals.resize(kept), order.resize(kept);
}

SortedTile put_in_order(PointCloud& cloud, const PlaceLattice& lattice) {
  std::vector<std::uint32_t> order = order_of(cloud);
  gather(cloud.points, order);
  if (!cloud.normals.empty()) gather(cloud.normals, order);
  ask_cancel();
  SortedTile counts;
  const std::vector<std::uint32_t> first =
      first_in_place(cloud.points, lattice, Context{.threads = 1});
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) continue;
    ++counts.duplicates;
    order[first[i]] = std::min(order[first[i]], order[i]);  // the first in the file
  }
  if (counts.duplicates > 0) {
    if (!cloud.normals.empty()) counts.opposite_normals = merge_normals(first, cloud.normals);
    keep_first(cloud.points, first);
    if (!cloud.normals.empty()) keep_first(cloud.normals, first);
    keep_first(order, first);
  }
  if (!cloud.normals.empty()) drop_zero_normals(cloud, order);
  for (Attribute& attribute : cloud.attributes) gather(attribute.values, order);
  counts.points = cloud.points.size();
  return counts;
}

// Rows of each chunk, behind the index.
std::vector<std::vector<std::byte>> sections_of(const PointCloud& cloud, TileIndex& index) {
  std::vector<std::vector<std::byte>> sections(1);
  const std::size_t bytes = index.layout.row_bytes(), n = cloud.points.size();
  for (std::size_t begin = 0; begin < n; begin += kChunkPoints) {
    const std::size_t end = std::min(n, begin + kChunkPoints);
    std::vector<std::byte>& rows = sections.emplace_back((end - begin) * bytes);
    Bounds box{.min = cloud.points[begin], .max = cloud.points[begin]};
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& p = cloud.points[i];
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
      put_row(index.layout, cloud, i, rows.data() + (i - begin) * bytes);
    }
    index.chunks.push_back({.box = box, .points = end - begin});
  }
  sections[0] = index_bytes(index);
  return sections;
}

}  // namespace

SortedTile sort_points(PieceStore& store, std::size_t tile) {
  const std::string name = sorted_name(tile);
  if (store.has(name)) {
    store.remove(raw_name(tile));
    return read_index(store, tile).counts;
  }
  const Distributed given = read_distributed(store);
  PointCloud cloud = read_raw(store.open(raw_name(tile)), given.layout);
  TileIndex index{.counts = put_in_order(cloud, given.lattice), .layout = given.layout};
  // Means of normals are no floats, as a rule.
  if (index.counts.duplicates > 0) index.layout.single_normals = false;
  store.write(name, sections_of(cloud, index));
  store.remove(raw_name(tile));
  return index.counts;
}

void remove_points(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags) {
  TileIndex index = read_index(store, tile);
  PointCloud cloud = read_points(store, tile);
  const auto keep = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (flags.at(i) == 0) values[kept++] = values[i];
    }
    values.resize(kept);
  };
  keep(cloud.points);
  keep(cloud.normals);
  for (Attribute& attribute : cloud.attributes) keep(attribute.values);
  index.chunks.clear();
  index.counts.points = cloud.points.size();
  store.write(sorted_name(tile), sections_of(cloud, index));
}

}  // namespace rholm
