#include "reconstruct/field/narrow_blocks.h"

#include <bit>
#include <cstring>

#include "base/parallel.h"
#include "rholm/error.h"
#include "surface/grid/node_masks.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 32;  // blocks

// Head of each block, stored before its values.
struct Head {
  BlockCoordinates at = {};
  std::uint32_t n_values = 0;
  NodeBits known = {}, inside = {}, kept = {};
};

// Returns the bits of the nodes of one block at which an edge of the surface ends. Such an edge
// joins two known neighbours along an axis, one inside and one outside.
NodeBits crossed_nodes(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t b) {
  static constexpr NodeMasks kNothing = {};
  const auto masks_at = [&](int place) -> const NodeMasks& {
    const std::int32_t other = grid.neighbours[b][place];
    return other == kNoBlock ? kNothing : masks[other];
  };
  const NodeMasks& own = masks[b];
  const NodeMasks& left = masks_at(12);
  const NodeMasks& right = masks_at(14);
  const NodeMasks& before = masks_at(10);
  const NodeMasks& after = masks_at(16);
  const NodeMasks& below = masks_at(4);
  const NodeMasks& above = masks_at(22);
  NodeBits crossed = {};
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t known = own.known[z], inside = own.inside[z];
    const auto differs = [&](std::uint64_t other_known, std::uint64_t other_inside) {
      crossed[z] |= known & other_known & (inside ^ other_inside);
    };
    differs(from_next_x(known, right.known[z]), from_next_x(inside, right.inside[z]));
    differs(from_last_x(known, left.known[z]), from_last_x(inside, left.inside[z]));
    differs(from_next_y(known, after.known[z]), from_next_y(inside, after.inside[z]));
    differs(from_last_y(known, before.known[z]), from_last_y(inside, before.inside[z]));
    const NodeMasks& up = z == 7 ? above : own;
    const NodeMasks& down = z == 0 ? below : own;
    differs(up.known[(z + 1) & 7], up.inside[(z + 1) & 7]);
    differs(down.known[(z + 7) & 7], down.inside[(z + 7) & 7]);
  }
  return crossed;
}

template <typename Visit>
void for_each_node(const NodeBits& bits, const Visit& visit) {
  for (std::size_t z = 0; z < 8; ++z) {
    for (std::uint64_t word = bits[z]; word != 0; word &= word - 1) {
      visit(64 * z + static_cast<std::size_t>(std::countr_zero(word)));
    }
  }
}

[[noreturn]] void refuse() {
  throw Error(ErrorCode::kInvalidInput, "blocks of a grid that were put aside are damaged");
}

// Reads the head at `bytes`. Returns the number of bytes of the head and its values.
std::size_t read_head(std::span<const std::byte> bytes, Head& head) {
  if (bytes.size() < sizeof(Head)) refuse();
  std::memcpy(&head, bytes.data(), sizeof(Head));
  std::size_t n = 0;
  for (const std::uint64_t word : head.kept) n += static_cast<std::size_t>(std::popcount(word));
  const std::size_t size = sizeof(Head) + n * sizeof(float);
  if (n != head.n_values || bytes.size() < size) refuse();
  return size;
}

}  // namespace

std::vector<std::byte> narrow_blocks(const BlockGrid& grid, std::span<const std::uint32_t> blocks,
                                     const Context& context) {
  std::vector<NodeMasks> masks(grid.n_blocks());
  parallel_for(masks.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    node_masks(grid.block_values(begin), end - begin, &masks[begin]);
  });
  std::vector<std::vector<std::byte>> parts((blocks.size() + kGrain - 1) / kGrain);
  parallel_for(blocks.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<std::byte>& part = parts[begin / kGrain];
    std::vector<float> values;
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t b = blocks[i];
      Head head{.at = grid.blocks[b],
                .known = masks[b].known,
                .inside = masks[b].inside,
                .kept = crossed_nodes(grid, masks, b)};
      values.clear();
      for_each_node(head.kept,
                    [&](std::size_t node) { values.push_back(grid.block_values(b)[node]); });
      head.n_values = static_cast<std::uint32_t>(values.size());
      const std::size_t at = part.size();
      part.resize(at + sizeof(Head) + values.size() * sizeof(float));
      std::memcpy(part.data() + at, &head, sizeof(Head));
      if (!values.empty()) {
        std::memcpy(part.data() + at + sizeof(Head), values.data(), values.size() * sizeof(float));
      }
    }
  });
  std::size_t size = 0;
  for (const std::vector<std::byte>& part : parts) size += part.size();
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  for (const std::vector<std::byte>& part : parts) {
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  return bytes;
}

void for_narrow_blocks(std::span<const std::byte> bytes, double step,
                       const std::function<void(const NarrowBlock&)>& visit) {
  NarrowBlock block;
  const auto far = static_cast<float>(step);
  while (!bytes.empty()) {
    Head head;
    const std::size_t size = read_head(bytes, head);
    block.at = head.at;
    block.values.fill(BlockGrid::kUnknown);
    for_each_node(head.known, [&](std::size_t node) { block.values[node] = far; });
    for_each_node(head.inside, [&](std::size_t node) { block.values[node] = -far; });
    const std::byte* next = bytes.data() + sizeof(Head);
    for_each_node(head.kept, [&](std::size_t node) {
      std::memcpy(&block.values[node], next, sizeof(float));
      next += sizeof(float);
    });
    visit(block);
    bytes = bytes.subspan(size);
  }
}

std::vector<BlockCoordinates> places_of_narrow(std::span<const std::byte> bytes) {
  std::vector<BlockCoordinates> places;
  while (!bytes.empty()) {
    Head head;
    bytes = bytes.subspan(read_head(bytes, head));
    places.push_back(head.at);
  }
  return places;
}

}  // namespace rholm
