// Makes the signs of normals consistent along a graph of neighbours. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "shape/points/normals.h"

namespace rholm {

// Consistently oriented sets of points. All arrays are in the order of the tree.
struct OrientedParts {
  // Pieces are joined by edges of small weight, components by any edge. Both are numbered in the
  // order of their first points.
  std::vector<std::uint32_t> piece;      // per point
  std::vector<std::uint32_t> component;  // per point
  std::size_t n_pieces = 0;
  std::size_t n_components = 0;
};

// Returns how far the normals at both ends of an edge agree, -1 ... 1; negative if one
// should be flipped. The normal of one end is reflected in the plane that halves the edge,
// as on a circular arc through both ends (Koenig, Gumhold 2009). So the result is right
// across sharp edges and around the rim of a thin sheet, where Hoppe's scalar product (1992)
// has the wrong sign. Only the part of a height between the ends that exceeds `slack`, the
// scatter of the points, counts.
double agreement(const Vec3& p, const Vec3& np, const Vec3& q, const Vec3& nq, double slack);

// Flips `normals` to agree along the minimum spanning tree of the graph fits.neighbors with weights
// 1 - |agreement|. The first step joins pieces by edges of small weight; the second joins pieces by
// the votes of all edges between them.
OrientedParts orient_along_graph(std::span<const Vec3> points, const LocalFits& fits,
                                 std::vector<Vec3>& normals);

// The votes of two pieces for each other.
struct PieceVotes {
  std::uint32_t a = 0, b = 0;  // pieces, a < b
  double sum = 0;              // of agreements; negative if one piece should be flipped
};

// Result of the first step of orient_along_graph().
struct OrientedPieces {
  std::vector<std::uint32_t> piece = {};  // per point; numbered in the order of first points
  std::size_t n_pieces = 0;
  std::vector<PieceVotes> votes = {};  // by a, then by b
};
// Flips normals within each piece only. Pieces of fewer than `least` points join another, if an
// edge leads to one. Edges vote unless they begin at a `foreign` point.
OrientedPieces orient_pieces(std::span<const Vec3> points, const LocalFits& fits, std::size_t least,
                             std::span<const std::uint8_t> foreign, std::vector<Vec3>& normals);

// Parts of mean_agreement(), kept separately while the signs between pieces are not known.
struct PieceAgreement {
  struct Across {
    std::uint32_t point = 0, other = 0;  // other: piece of the other end
    float agreement = 0;
  };
  std::vector<float> within = {};        // per point: sum over edges within its piece
  std::vector<std::uint8_t> edges = {};  // per point: number of all edges
  std::vector<Across> across = {};       // by points; without foreign ones
};
PieceAgreement agreement_of_pieces(std::span<const Vec3> points, const LocalFits& fits,
                                   const OrientedPieces& pieces,
                                   std::span<const std::uint8_t> foreign,
                                   std::span<const Vec3> normals);

// Returns the mean agreement of each point with its neighbours, 0 (none or negative) ... 1.
std::vector<float> mean_agreement(std::span<const Vec3> points, const LocalFits& fits,
                                  std::span<const Vec3> normals);

}  // namespace rholm
