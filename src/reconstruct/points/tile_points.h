// The points of each tile, in a store. Layer: reconstruct, private.
//
// Points of a source go to the pieces "raw/TILE", in the order of the file, as rows (point_rows.h).
// Sorted, they are in the pieces "points/TILE": section 0 is an index, each of the others a chunk
// of points that are near each other. The piece "distributed" says that all is there, and how rows
// are laid out.
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

// Sends each finite point to its tile, except points far from all others. Does nothing if an
// earlier run has done it. Throws InvalidInput if the source is not the survey's.
struct DistributeOptions {
  std::size_t buffer_bytes = std::size_t{64} << 20;  // at least; 64 KiB for each tile if more
};
void distribute(PointSource& source, const Survey& survey, const TilePlan& plan, PieceStore& store,
                const DistributeOptions& options = {}, const Context& context = {});

// Numbers of points of a tile that sort_points() has sorted.
struct SortedTile {
  std::uint64_t points = 0;            // that stay
  std::uint64_t duplicates = 0;        // merged into these
  std::uint64_t opposite_normals = 0;  // of these, as in CleanReport
  friend bool operator==(const SortedTile&, const SortedTile&) = default;
};
// Sorts the points of a tile along a Morton curve through their box, ties by coordinates, then by
// normals. Points at one place (PlaceLattice of the survey's bounds) are merged in this order, as
// clean() does, with the attributes of the first in the file. Where points have normals, points
// with a zero normal are removed. All but attributes of merged points is the same for any order of
// the file. Removes the raw piece. Does nothing if the store has the result.
SortedTile sort_points(PieceStore& store, std::size_t tile);

// Removes points whose flag is set from a sorted tile; there is one flag per point.
void remove_points(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags);

// Index of a sorted tile: everything but its points.
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
// Returns all points of a sorted tile, in their order.
TilePoints read_points(const PieceStore& store, std::size_t tile);
// Adds the points in the box, including its borders, in their order; reads only chunks that meet
// it. `points` is empty or has points of other tiles. If wanted, `places` gets the numbers of the
// added points in their tile.
void add_points_within(const PieceStore& store, std::size_t tile, const Bounds& box,
                       TilePoints& points, std::vector<std::uint32_t>* places = nullptr);
TilePoints read_points_within(const PieceStore& store, std::size_t tile, const Bounds& box);

// Returns the box of all tiles together; {0,0,0} twice for none.
Bounds bounds_of_tiles(const PieceStore& store, const TilePlan& plan);
// Returns true if all points of all tiles lie on one line, within this part of the diagonal.
bool lie_on_line(const PieceStore& store, const TilePlan& plan, double of_diagonal);

// Names and formats of the pieces.
inline constexpr const char* kDistributed = "distributed";
inline constexpr const char* kRaw = "raw";
inline std::string raw_name(std::size_t tile) { return kRaw + ("/" + std::to_string(tile)); }
inline std::string sorted_name(std::size_t tile) { return "points/" + std::to_string(tile); }

// Layout of rows in raw pieces, and the lattice of places. Throws as PieceStore::open() does.
struct Distributed {
  PointLayout layout;
  PlaceLattice lattice;
};
Distributed read_distributed(const PieceStore& store);

std::vector<std::byte> index_bytes(const TileIndex& index);
// Reads the index of an open piece. Throws InvalidInput if its sections do not fit it.
TileIndex parse_index(const PieceReader& piece);

}  // namespace rholm
