// The points of each tile, in a store. Layer: reconstruct, private.
//
// distribute() sends the points of a source to "raw/TILE", in the order of the file, as rows
// (point_rows.h). sort_points() makes "points/TILE" of that: section 0 is an index, each of the
// others a chunk of points that are near each other. The piece "distributed" says that all is
// there, and how rows are laid out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/point_rows.h"
#include "reconstruct/points/point_source.h"
#include "reconstruct/points/point_survey.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"
#include "shape/points/place_lattice.h"

namespace rholm {

using TilePoints = PointCloud;

inline constexpr std::size_t kChunkPoints = 4096;  // chosen: some 100 KB, what a disk reads at once

// Sends each finite point that is no far stray to its tile. Done already where the store has it
// from a run before. Throws InvalidInput if the source is not the one of the survey.
struct DistributeOptions {
  std::size_t buffer_bytes = std::size_t{64} << 20;  // at least; 64 KiB for each tile if more
};
void distribute(PointSource& source, const Survey& survey, const TilePlan& plan, PieceStore& store,
                const DistributeOptions& options = {}, const Context& context = {});

// What became of the points of a tile.
struct SortedTile {
  std::uint64_t points = 0;            // that stay
  std::uint64_t duplicates = 0;        // merged into these
  std::uint64_t opposite_normals = 0;  // of these, as in CleanReport
  friend bool operator==(const SortedTile&, const SortedTile&) = default;
};
// Puts them in order along a Morton curve through their box, ties by coordinates, then by normals,
// and merges those at one place (PlaceLattice of the survey's bounds) as clean() does, in that
// order; attributes are those of the first in the file. Where points have normals those whose is
// zero go. So all but attributes of merged points is
// the same for any order of the file. Removes the raw piece. Done already where the store has it.
SortedTile sort_points(PieceStore& store, std::size_t tile);

// Writes a sorted tile anew without the points whose flag is set; one flag each.
void remove_points(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags);

// What a sorted tile has, without its points.
struct TileIndex {
  struct Chunk {
    Bounds box;
    std::uint64_t points = 0;
  };
  SortedTile counts = {};
  PointLayout layout = {};
  std::vector<Chunk> chunks = {};  // sections 1 ... of the piece

  Bounds bounds() const;  // of all its points; {0,0,0} twice for none
};
TileIndex read_index(const PieceStore& store, std::size_t tile);
// All points of a sorted tile, in their order.
TilePoints read_points(const PieceStore& store, std::size_t tile);
// Those in the box, borders too, in their order; reads only chunks that meet it. They are added to
// `points`, which has none or those of other tiles; their numbers among those of the tile to
// `places`, if wanted.
void add_points_within(const PieceStore& store, std::size_t tile, const Bounds& box,
                       TilePoints& points, std::vector<std::uint32_t>* places = nullptr);
TilePoints read_points_within(const PieceStore& store, std::size_t tile, const Bounds& box);

// Of all tiles together; {0,0,0} twice for none.
Bounds bounds_of_tiles(const PieceStore& store, const TilePlan& plan);
// Whether all points of all tiles lie on one line, within this part of the diagonal.
bool lie_on_line(const PieceStore& store, const TilePlan& plan, double of_diagonal);

// Names and formats of the pieces.
inline constexpr const char* kDistributed = "distributed";
inline constexpr const char* kRaw = "raw";
inline std::string raw_name(std::size_t tile) { return kRaw + ("/" + std::to_string(tile)); }
inline std::string sorted_name(std::size_t tile) { return "points/" + std::to_string(tile); }

// How rows of the raw pieces are laid out, and what one place is. Throws as PieceStore::open().
struct Distributed {
  PointLayout layout;
  PlaceLattice lattice;
};
Distributed read_distributed(const PieceStore& store);

std::vector<std::byte> index_bytes(const TileIndex& index);
// Of an open piece. Throws InvalidInput if its sections do not fit it.
TileIndex parse_index(const PieceReader& piece);

}  // namespace rholm
