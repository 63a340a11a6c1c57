// The points of each brick, in a store. Layer: model, private.
//
// distribute() sends the points of a source to "raw/BRICK", in the order of the file, as rows
// (point_rows.h). sort_points() makes "points/BRICK" of that: section 0 is an index, each of the
// others a chunk of points that are near each other. The piece "distributed" says that all is
// there, and how rows are laid out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/point_rows.h"
#include "model/bricks/point_source.h"
#include "model/bricks/point_survey.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"
#include "shape/points/place_lattice.h"

namespace rholm {

using BrickPoints = PointCloud;

inline constexpr std::size_t kChunkPoints = 4096;  // chosen: some 100 KB, what a disk reads at once

// Sends each finite point that is no far stray to its brick. Done already where the store has it
// from a run before. Throws InvalidInput if the source is not the one of the survey.
struct DistributeOptions {
  std::size_t buffer_bytes = std::size_t{64} << 20;  // at least; 64 KiB for each brick if more
};
void distribute(PointSource& source, const Survey& survey, const BrickPlan& plan, PieceStore& store,
                const DistributeOptions& options = {}, const Context& context = {});

// What became of the points of a brick.
struct SortedBrick {
  std::uint64_t points = 0;            // that stay
  std::uint64_t duplicates = 0;        // merged into these
  std::uint64_t opposite_normals = 0;  // of these, as in CleanReport
  friend bool operator==(const SortedBrick&, const SortedBrick&) = default;
};
// Puts them in order along a Morton curve through their box, ties by coordinates, then by normals,
// and merges those at one place (PlaceLattice of the survey's bounds) as clean() does, in that
// order; attributes are those of the first in the file. Where points have normals those whose is
// zero go. So all but attributes of merged points is
// the same for any order of the file. Removes the raw piece. Done already where the store has it.
SortedBrick sort_points(PieceStore& store, std::size_t brick);

// Writes a sorted brick anew without the points whose flag is set; one flag each.
void remove_points(PieceStore& store, std::size_t brick, const std::vector<std::uint8_t>& flags);

// What a sorted brick has, without its points.
struct BrickIndex {
  struct Chunk {
    Bounds box;
    std::uint64_t points = 0;
  };
  SortedBrick counts = {};
  PointLayout layout = {};
  std::vector<Chunk> chunks = {};  // sections 1 ... of the piece

  Bounds bounds() const;  // of all its points; {0,0,0} twice for none
};
BrickIndex read_index(const PieceStore& store, std::size_t brick);
// All points of a sorted brick, in their order.
BrickPoints read_points(const PieceStore& store, std::size_t brick);
// Those in the box, borders too, in their order; reads only chunks that meet it. They are added to
// `points`, which has none or those of other bricks; their numbers among those of the brick to
// `places`, if wanted.
void add_points_within(const PieceStore& store, std::size_t brick, const Bounds& box,
                       BrickPoints& points, std::vector<std::uint32_t>* places = nullptr);
BrickPoints read_points_within(const PieceStore& store, std::size_t brick, const Bounds& box);

// Of all bricks together; {0,0,0} twice for none.
Bounds bounds_of_bricks(const PieceStore& store, const BrickPlan& plan);
// Whether all points of all bricks lie on one line, within this part of the diagonal.
bool lie_on_line(const PieceStore& store, const BrickPlan& plan, double of_diagonal);

// Names and formats of the pieces.
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
