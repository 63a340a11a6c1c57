// Signs of normals within a tile, and the votes of other tiles. Layer: reconstruct, private.
//
// A piece is a set of points of a tile and its halo that certain edges
// hold together (see orient_graph.h). The signs of pieces relative to each
// other are open. A point that is one tile's own and in the halo of
// another is a vote for the two pieces: they agree, or one must be turned.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/normals/tile_directions.h"
#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/orient_graph.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// A point's piece, and whether its normal there is against its direction.
class PieceCode {
 public:
  PieceCode() = default;
  PieceCode(std::uint32_t piece, bool opposite) : code_(2 * piece + (opposite ? 1 : 0)) {}
  std::uint32_t piece() const { return code_ / 2; }
  bool opposite() const { return code_ % 2 != 0; }

 private:
  std::uint32_t code_ = 0;
};

// A point of one piece that stands for points around it.
struct SideSample {
  Vec3 point;
  Vec3 normal;  // with the sign of the piece
  double area = 0, spacing = 0;
  std::uint64_t piece = 0;
  std::uint64_t place = 0;  // among the own points of its tile
};

struct TileSigns {
  struct Across {
    std::uint32_t point = 0, other = 0;
    float agreement = 0;
  };
  // Points of the halo that another tile has.
  struct Shared {
    std::uint64_t tile = 0, n = 0;
  };
  std::uint64_t n_pieces = 0;
  bool in_rows = false;
  std::vector<PieceCode> codes = {};       // of own points
  std::vector<float> within = {};          // see PieceAgreement
  std::vector<std::uint8_t> edges = {};    // see PieceAgreement
  std::vector<Across> across = {};         // see PieceAgreement; between own points
  std::vector<Shared> shared = {};         // by tiles
  std::vector<std::uint32_t> places = {};  // of shared points, in their own tiles
  std::vector<PieceCode> halo = {};        // of shared points, in this tile
  std::vector<PieceVotes> votes = {};
  std::vector<SideSample> samples = {};  // by pieces
};

// Needs fits of all points. Takes a sample per `points_per_sample` points, more of small pieces.
TileSigns find_tile_signs(const BareTile& graph, std::size_t points_per_sample);

std::string signs_name(std::size_t tile);
void write_signs(PieceStore& store, std::size_t tile, const TileSigns& signs);
// These read all of it, only what join_sides() needs, and only the codes.
TileSigns read_signs(const PieceStore& store, std::size_t tile);
TileSigns read_pieces(const PieceStore& store, std::size_t tile);
std::vector<PieceCode> read_codes(const PieceStore& store, std::size_t tile);

// Votes of the points that a tile shares with another one, for a piece of each.
struct SharedVotes {
  std::uint64_t tile = 0;  // the other
  std::uint32_t own = 0, other = 0;
  std::int64_t sum = 0, n = 0;  // points that agree less points that do not; all points
};
std::vector<SharedVotes> match_signs(const PieceStore& store, std::size_t tile);
std::string votes_name(std::size_t tile);

}  // namespace rholm
