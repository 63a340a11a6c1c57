// Signs of normals along a graph of neighbours. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "shape/points/normals.h"

namespace rholm {

// Everything is in the order of the tree.
struct OrientedParts {
  // Pieces are what edges without doubt hold together, components what any edge does. Numbered by
  // their first points.
  std::vector<std::uint32_t> piece;      // per point
  std::vector<std::uint32_t> component;  // per point
  std::size_t n_pieces = 0;
  std::size_t n_components = 0;
};

// How far the normals at the two ends of an edge agree, -1 ... 1: negative if one should be turned.
// The normal of one end is reflected in the plane that halves the edge, which is what a
// circular arc through both does to it (Koenig, Gumhold 2009): so it holds across sharp edges and
// from one side of a thin sheet to the other, where Hoppe's scalar product of the normals (1992)
// says the opposite. Of the height between the ends only what exceeds `slack`, the scatter of the
// points about their surface, counts.
double agreement(const Vec3& p, const Vec3& np, const Vec3& q, const Vec3& nq, double slack);

// Turns `normals` to agree along the minimum spanning tree of the graph of fits.neighbors with
// weights 1 - |agreement|, in two steps: pieces by edges of small weight, and then pieces to
// each other by the votes of all edges between them.
OrientedParts orient_along_graph(std::span<const Vec3> points, const LocalFits& fits,
                                 std::vector<Vec3>& normals);

// The votes of all edges between two pieces.
struct PieceVotes {
  std::uint32_t a = 0, b = 0;  // pieces, a < b
  double sum = 0;              // of agreements: negative if one of the pieces should be turned
};

// The first of the two steps.
struct OrientedPieces {
  std::vector<std::uint32_t> piece = {};  // per point; numbered by their first points
  std::size_t n_pieces = 0;
  std::vector<PieceVotes> votes = {};  // by a, then by b
};
// Turns normals within each piece only. What has fewer than `least` points goes with another piece,
// if any edge leads to one. Votes are those of edges that begin at points which are not `foreign`.
OrientedPieces orient_pieces(std::span<const Vec3> points, const LocalFits& fits, std::size_t least,
                             std::span<const std::uint8_t> foreign, std::vector<Vec3>& normals);

// What mean_agreement() is made of, as long as the signs of pieces to each other are open.
struct PieceAgreement {
  struct Across {
    std::uint32_t point = 0, other = 0;  // the other end's piece
    float agreement = 0;
  };
  std::vector<float> within = {};        // per point: the sum over edges within its piece
  std::vector<std::uint8_t> edges = {};  // per point: all of them
  std::vector<Across> across = {};       // by points; of those which are not foreign
};
PieceAgreement agreement_of_pieces(std::span<const Vec3> points, const LocalFits& fits,
                                   const OrientedPieces& pieces,
                                   std::span<const std::uint8_t> foreign,
                                   std::span<const Vec3> normals);

// Mean agreement of each point with its neighbours, 0 (none, or against) ... 1.
std::vector<float> mean_agreement(std::span<const Vec3> points, const LocalFits& fits,
                                  std::span<const Vec3> normals);

}  // namespace rholm
