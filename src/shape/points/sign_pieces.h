// Points whose signs hold together, and what such pieces say of each other. Layer: shape.
//
// Edges that agree (sign_graph.h) hold pieces together; a piece is turned as a whole. Points may
// come in parts, as the tiles of a large cloud: each part looks at the edges that begin at its own
// points, and what is found for all parts together is what one part of all points would find.
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
  // Standard errors that the mean is from zero, of values that edges have.
  double significance() const;
};

// What the edges between two pieces, or within one, say together.
struct PiecePair {
  std::uint32_t a = 0, b = 0;  // a <= b
  double edges = 0;            // all edges between two pieces; within one, those that contradict
  Moments heights;             // of edges that contradict
  Moments bends;               // agreements of edges across a crease between two pieces
};
// Makes one pair of those of the same pieces, in the order of pieces.
void merge(std::vector<PiecePair>& pairs);

// Pieces of one part.
struct SignPieces {
  struct Quarrel {
    std::uint32_t point = 0;  // of the part's own
    std::uint32_t other = 0;  // piece of the neighbour that it contradicts
  };
  // Per point; kNoPiece for foreign points that no edge of an own point reaches. Pieces are
  // numbered by their first points.
  std::vector<std::uint32_t> piece = {};
  std::vector<std::uint64_t> own = {};  // per piece: points that are not foreign
  std::vector<PiecePair> pairs = {};    // that have anything to say, by pieces
  std::vector<Quarrel> quarrels = {};   // by points
  double scatter = 0;                   // as of the graph
};
inline constexpr std::uint32_t kNoPiece = ~std::uint32_t{0};

// Points and unit normals (zero: of no say) in the order of the tree; points that are `foreign`, if
// there are any, are own points of another part. `neighbors` are graph_neighbors(), or empty.
SignPieces find_sign_pieces(const PointTree& tree, std::span<const Vec3> points,
                            std::span<const Vec3> normals, const SamplingGaps& gaps,
                            std::span<const std::uint8_t> foreign, const Context& context,
                            std::vector<std::uint32_t> neighbors = {});

}  // namespace rholm
