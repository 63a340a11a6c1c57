// Finds pieces, which are sets of points with consistent signs, and how they agree. Layer: shape.
//
// Edges that agree (sign_graph.h) join points to pieces; a piece is flipped as a whole. Points may
// come in parts, such as the tiles of a large cloud. Each part tests the edges that begin at its
// own points. The result for all parts together equals the result for one part with all points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// Number, sum and sum of squares of some values.
struct Moments {
  double n = 0, sum = 0, squares = 0;

  void add(double value) { n += 1, sum += value, squares += value * value; }
  void add(const Moments& other) { n += other.n, sum += other.sum, squares += other.squares; }
  double mean() const { return sum / n; }
  // Returns the distance of the mean from zero, in standard errors, for values of edges.
  double significance() const;
};

// Sums over the edges between two pieces, or within one piece.
struct PiecePair {
  std::uint32_t a = 0, b = 0;  // a <= b
  double edges = 0;            // all edges between two pieces; contradicting ones within one
  Moments heights;             // heights of contradicting edges
  Moments bends;               // agreements of edges across a crease between two pieces
};
// Joins pairs of equal pieces to one pair each, and sorts them by pieces.
void merge(std::vector<PiecePair>& pairs);

// Pieces of one part.
struct SignPieces {
  struct Quarrel {
    std::uint32_t point = 0;  // point of the part itself
    std::uint32_t other = 0;  // piece of the neighbour that it contradicts
  };
  // Piece of each point; kNoPiece for foreign points that no edge from an own point reaches. Pieces
  // are numbered in the order of their first points.
  std::vector<std::uint32_t> piece = {};
  std::vector<std::uint64_t> own = {};  // per piece: number of points that are not foreign
  std::vector<PiecePair> pairs = {};    // pairs with any votes, ordered by pieces
  std::vector<Quarrel> quarrels = {};   // by points
  double scatter = 0;                   // scatter() of the graph
};
inline constexpr std::uint32_t kNoPiece = ~std::uint32_t{0};

// Takes points and unit normals (zero: no vote) in the order of the tree. `foreign` (may be empty)
// flags own points of other parts. `neighbors` are graph_neighbors(), or empty.
SignPieces find_sign_pieces(const PointTree& tree, std::span<const Vec3> points,
                            std::span<const Vec3> normals, const SamplingGaps& gaps,
                            std::span<const std::uint8_t> foreign, const Context& context,
                            std::vector<std::uint32_t> neighbors = {});

}  // namespace rholm
