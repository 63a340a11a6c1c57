// Names and formats of the pieces of bricks. Layer: model, private.
#pragma once

#include <cstddef>
#include <string>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_points.h"
#include "shape/points/place_lattice.h"

namespace rholm {

inline constexpr const char* kDistributed = "distributed";
inline constexpr const char* kRaw = "raw";
inline std::string raw_name(std::size_t brick) { return kRaw + ("/" + std::to_string(brick)); }
inline std::string sorted_name(std::size_t brick) { return "points/" + std::to_string(brick); }

// How rows of the raw pieces are laid out, and what one place is. Throws as PieceStore::open().
struct Distributed {
  PointLayout layout;
  PlaceLattice lattice;
};
Distributed read_distributed(const PieceStore& store);

std::vector<std::byte> index_bytes(const BrickIndex& index);
// Of an open piece. Throws InvalidInput if its sections do not fit it.
BrickIndex parse_index(const PieceReader& piece);

}  // namespace rholm
