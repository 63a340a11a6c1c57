#include "surface/grid/block_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/cancel.h"
#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  // 2^64 / golden ratio, odd
constexpr std::uint64_t kEmpty = ~std::uint64_t{0};       // no key has its highest bit set
// Number of discs, and of blocks, per task.
constexpr std::size_t kDiscGrain = 2048;
constexpr std::size_t kBlockGrain = 64;
// Number of blocks (8 MB) copied between two checks for cancellation.
constexpr std::size_t kBlocksPerQuestion = 4096;
// One block in kRoom is reserved for blocks that holes and sharp edges add.
// Untouched reserve costs nothing, but a grid that is moved is paged in twice.
constexpr std::size_t kRoom = 16;
// The box of a disc may have this many times the allowed blocks, because a disc
// is flat and its box is not. Chosen: it limits the time of a hopeless request.
constexpr double kBoxPerBlock = 64;

std::uint64_t key_of(const BlockCoordinates& b) {
  const auto part = [](std::int32_t c) { return static_cast<std::uint64_t>(c) + (1U << 20); };
  return part(b[2]) << 42 | part(b[1]) << 21 | part(b[0]);
}

BlockCoordinates coordinates_of(std::uint64_t key) {
  const auto part = [](std::uint64_t k) {
    return static_cast<std::int32_t>(k & ((1U << 21) - 1)) - (1 << 20);
  };
  return {part(key), part(key >> 21), part(key >> 42)};
}

// Returns the size of a hash table of n entries: a power of two, at least twice n.
std::size_t n_slots(std::size_t n) { return std::bit_ceil(2 * n + 16); }
std::size_t first_slot(std::uint64_t key, std::size_t n) {
  return static_cast<std::size_t>((key * kGolden) >> (64 - std::countr_zero(n)));
}

// Hash set of keys that grows.
class KeySet {
 public:
  KeySet() : slots_(n_slots(1000), kEmpty) {}
  void insert(std::uint64_t key) {
    std::size_t slot = first_slot(key, slots_.size());
    while (slots_[slot] != kEmpty) {
      if (slots_[slot] == key) return;
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = key;
    keys_.push_back(key);
    if (2 * keys_.size() > slots_.size()) grow();
  }
  const std::vector<std::uint64_t>& keys() const { return keys_; }

 private:
  void grow() {
    slots_.assign(2 * slots_.size(), kEmpty);
    for (const std::uint64_t key : keys_) {
      std::size_t slot = first_slot(key, slots_.size());
      while (slots_[slot] != kEmpty) slot = (slot + 1) & (slots_.size() - 1);
      slots_[slot] = key;
    }
  }
  std::vector<std::uint64_t> slots_;
  std::vector<std::uint64_t> keys_;
};

[[noreturn]] void throw_too_many(std::size_t max_blocks) {
  throw Error(
      ErrorCode::kOutOfMemory,
      fmt::format("the grid needs more than {} blocks ({:.0f} MiB): take a coarser "
                  "resolution, or allow more memory",
                  max_blocks, static_cast<double>(block_grid_bytes(max_blocks)) / (1 << 20)));
}

// Disc in units of the step.
struct LocalDisc {
  std::array<double, 3> center, normal;
  double radius, half_thickness;
};

LocalDisc localize(const Disc& disc, const Vec3& origin, double step) {
  const Vec3 c = (disc.center - origin) / step;
  return {{c.x, c.y, c.z},
          {disc.normal.x, disc.normal.y, disc.normal.z},
          disc.radius / step,
          disc.half_thickness / step};
}

// Range of blocks whose nodes 8 b ... 8 b + 7 meet the box around a disc.
struct BlockBox {
  std::array<std::int32_t, 3> low, high;
};

BlockBox box_of(const LocalDisc& disc, std::size_t max_blocks) {
  BlockBox box{};
  double volume = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double n = disc.normal[a];
    // The flat disc reaches `flat` along the axis; the slab's thickness adds to it.
    const double flat = disc.radius * std::sqrt(std::max(0.0, 1 - n * n));
    const double reach = std::min(disc.radius, flat + disc.half_thickness * std::abs(n));
    const double low = std::ceil((disc.center[a] - reach - 7) / 8);
    const double high = std::floor((disc.center[a] + reach) / 8);
    if (!(low >= -kBlockLimit && high <= kBlockLimit)) {
      throw Error(ErrorCode::kInvalidInput,
                  fmt::format("a point lies {:.3g} grid steps from the grid's origin, the limit is "
                              "{}: take a coarser resolution, or remove points far away",
                              std::abs(disc.center[a]) + reach, 8 * kBlockLimit));
    }
    box.low[a] = static_cast<std::int32_t>(low);
    box.high[a] = static_cast<std::int32_t>(high);
    volume *= std::max(0.0, high - low + 1);
  }
  if (volume > kBoxPerBlock * static_cast<double>(max_blocks)) throw_too_many(max_blocks);
  return box;
}

bool meets(const LocalDisc& disc, const BlockCoordinates& b) {
  double along = 0;      // height of the block's centre over the plane
  double half_side = 0;  // half extent of the block along the normal
  double distance = 0;   // squared distance of the block from the disc's centre
  for (std::size_t a = 0; a < 3; ++a) {
    const double d = 8.0 * b[a] + 3.5 - disc.center[a];
    along += disc.normal[a] * d;
    half_side += 3.5 * std::abs(disc.normal[a]);
    const double outside = std::max(0.0, std::abs(d) - 3.5);
    distance += outside * outside;
  }
  return std::abs(along) <= disc.half_thickness + half_side &&
         distance <= disc.radius * disc.radius;
}

void mark(const LocalDisc& disc, std::size_t max_blocks, KeySet& marked) {
  const BlockBox box = box_of(disc, max_blocks);
  for (std::int32_t z = box.low[2]; z <= box.high[2]; ++z) {
    for (std::int32_t y = box.low[1]; y <= box.high[1]; ++y) {
      for (std::int32_t x = box.low[0]; x <= box.high[0]; ++x) {
        if (meets(disc, {x, y, z})) marked.insert(key_of({x, y, z}));
      }
    }
  }
  if (marked.keys().size() > max_blocks) throw_too_many(max_blocks);
}

void insert_slot(BlockGrid& grid, std::size_t block) {
  const std::size_t n = grid.slots.size();
  std::size_t slot = first_slot(key_of(grid.blocks[block]), n);
  while (grid.slots[slot] != kNoBlock) slot = (slot + 1) & (n - 1);
  grid.slots[slot] = static_cast<std::int32_t>(block);
}

void index_all(BlockGrid& grid) {
  grid.slots.assign(n_slots(grid.n_blocks()), kNoBlock);
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) insert_slot(grid, b);
}

void find_neighbours(BlockGrid& grid, std::size_t block) {
  const BlockCoordinates& b = grid.blocks[block];
  for (int n = 0; n < 27; ++n) {
    grid.neighbours[block][n] =
        find_block(grid, {b[0] + n % 3 - 1, b[1] + n / 3 % 3 - 1, b[2] + n / 9 - 1});
  }
}

void set_unknown(BlockGrid& grid, std::size_t begin, std::size_t end) {
  std::fill(grid.block_values(begin), grid.block_values(end), BlockGrid::kUnknown);
}

}  // namespace

std::int32_t find_block(const BlockGrid& grid, const BlockCoordinates& coordinates) {
  const std::size_t n = grid.slots.size();
  if (n == 0) return kNoBlock;
  for (const std::int32_t c : coordinates) {
    if (std::abs(c) > kBlockLimit + 1) return kNoBlock;
  }
  std::size_t slot = first_slot(key_of(coordinates), n);
  // Comparing arrays with != would be a function call.
  const auto is_other = [&](const BlockCoordinates& b) {
    return ((b[0] ^ coordinates[0]) | (b[1] ^ coordinates[1]) | (b[2] ^ coordinates[2])) != 0;
  };
  while (grid.slots[slot] != kNoBlock && is_other(grid.blocks[grid.slots[slot]])) {
    slot = (slot + 1) & (n - 1);
  }
  return grid.slots[slot];
}

std::vector<BlockCoordinates> list_blocks(const Vec3& origin, double step,
                                          std::span<const Disc> discs, std::size_t max_blocks,
                                          const Context& context) {
  const std::size_t chunks = (discs.size() + kDiscGrain - 1) / kDiscGrain;
  std::vector<std::vector<std::uint64_t>> found(chunks);
  parallel_for(discs.size(), kDiscGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    KeySet marked;
    for (std::size_t d = begin; d < end; ++d) {
      mark(localize(discs[d], origin, step), max_blocks, marked);
    }
    found[begin / kDiscGrain] = marked.keys();
  });
  KeySet all;
  for (const auto& keys : found) {
    for (const std::uint64_t key : keys) all.insert(key);
    if (all.keys().size() > max_blocks) throw_too_many(max_blocks);
  }
  std::vector<std::uint64_t> keys = all.keys();
  std::sort(keys.begin(), keys.end());
  std::vector<BlockCoordinates> blocks(keys.size());
  std::transform(keys.begin(), keys.end(), blocks.begin(), coordinates_of);
  return blocks;
}

BlockGrid make_block_grid(const Vec3& origin, double step, std::vector<BlockCoordinates> blocks,
                          const Context& context) {
  BlockGrid grid;
  grid.origin = origin;
  grid.step = step;
  grid.blocks = std::move(blocks);
  grid.values =
      AlignedArray<float>((grid.n_blocks() + grid.n_blocks() / kRoom) * BlockGrid::kNodes);
  grid.neighbours.resize(grid.n_blocks());
  index_all(grid);
  parallel_for(grid.n_blocks(), kBlockGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    set_unknown(grid, begin, end);
    for (std::size_t b = begin; b < end; ++b) find_neighbours(grid, b);
  });
  return grid;
}

void add_blocks(BlockGrid& grid, std::span<const BlockCoordinates> blocks) {
  const std::size_t before = grid.n_blocks();
  CancelPoll poll;
  for (const BlockCoordinates& b : blocks) {
    poll();
    if (find_block(grid, b) != kNoBlock) continue;
    grid.blocks.push_back(b);
    if (n_slots(grid.n_blocks()) > grid.slots.size()) {
      index_all(grid);
    } else {
      insert_slot(grid, grid.n_blocks() - 1);
    }
  }
  const std::size_t n = grid.n_blocks();
  if (n * BlockGrid::kNodes > grid.values.size()) {
    AlignedArray<float> larger((n + n / 2) * BlockGrid::kNodes);
    for (std::size_t b = 0; b < before; b += kBlocksPerQuestion) {
      ask_cancel();
      std::copy(grid.block_values(b), grid.block_values(std::min(before, b + kBlocksPerQuestion)),
                larger.data() + b * BlockGrid::kNodes);
    }
    grid.values = std::move(larger);
  }
  set_unknown(grid, before, n);
  if (!grid.filled.empty()) grid.filled.resize(8 * n, 0);
  grid.neighbours.resize(n);
  for (std::size_t b = before; b < n; ++b) {
    poll();
    find_neighbours(grid, b);
    for (int direction = 0; direction < 27; ++direction) {
      const std::int32_t other = grid.neighbours[b][direction];
      if (other != kNoBlock) grid.neighbours[other][26 - direction] = static_cast<std::int32_t>(b);
    }
  }
}

std::size_t block_grid_bytes(std::size_t n_blocks) {
  return n_blocks * (BlockGrid::kNodes * sizeof(float) + sizeof(BlockCoordinates) +
                     sizeof(std::array<std::int32_t, 27>)) +
         n_slots(n_blocks) * sizeof(std::int32_t);
}

}  // namespace rholm
