// Checks whether given normals agree with the normals around them, and which to flip. Layer: shape.
//
// Pieces (sign_pieces.h) that contradict each other are flipped to agree: the smaller piece takes
// the sign of the larger. So the signs of the majority of points decide.
//
// Two walls nearer to each other than their points contradict each other as well. Heights
// distinguish them: the mean height of one end over the other, over all edges between two pieces.
// It is zero for one sheet, and the distance of the walls for two.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/sign_pieces.h"

namespace rholm {

// A sample point that stands for others.
struct SignSample {
  Vec3 at, normal;
  double area = 0;  // area that it stands for
  double disc = 0;  // area of its disc, for balance_of()
  std::uint32_t piece = 0;
};

// The pieces of all tiles, in the order of the tiles.
struct AllPieces {
  std::vector<std::uint64_t> own = {};  // per piece, as in SignPieces
  std::vector<PiecePair> pairs = {};
  // Pairs of pieces that are one piece, because two tiles have a point in common.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> same = {};
  double scatter = 0;  // median over the tiles
};

// Returns the pieces of a single part that has all points.
AllPieces all_of(const SignPieces& part);

// Tells which pieces to flip.
struct SignCheck {
  std::vector<std::uint32_t> whole = {};      // per piece: the first piece of the same whole
  std::vector<std::uint32_t> component = {};  // per piece: the first piece that its sign depends on
  std::vector<std::uint8_t> turned = {};      // per piece: 1 if it should be turned
  std::uint64_t n_turned = 0;                 // number of points of these pieces
  std::uint64_t undecided = 0;                // points at creases with no side known to be right
  // Pairs of wholes that are two walls, a <= b; in ascending order.
  struct Walls {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const Walls&, const Walls&) = default;
  };
  std::vector<Walls> walls = {};

  // Returns true if contradictions between two pieces mean that one is wrong. `after`:
  // after the flips of `turned`.
  bool counts(std::uint32_t a, std::uint32_t b, bool after) const;
};
SignCheck check_signs(const AllPieces& all, std::span<const SignSample> samples,
                      const Context& context);

// Returns, in order, the points of a part that contradict many neighbours, before or after pieces
// are flipped. `first` is the number of the part's first piece among the pieces of all parts.
std::vector<std::uint32_t> contradicting_points(const SignPieces& part, std::uint32_t first,
                                                const SignCheck& check, bool after);

// Largest number of contradicting points reported by coordinates.
inline constexpr std::size_t kNamedPoints = 3;

// Signs after all corrections.
struct MendedSigns {
  SignCheck check;
  std::vector<std::uint8_t> turned = {};  // per piece: 1 if flipped in total
  std::uint64_t n_turned = 0;             // number of points of these pieces
  bool all_inward = false;                // no point contradicts others, but all are flipped
  // Share of points where the winding number contradicts the corrected normal.
  double inward = 0;
};
// Applies check_signs(). Then flips all signs if normals point into the enclosed body. If
// `closed`, it finally flips components that bound a body by themselves and whose winding numbers
// show that they are wrong.
MendedSigns mend_signs(const AllPieces& all, std::vector<SignSample> samples, bool closed,
                       const Context& context);

// Tells whether components whose signs do not depend on each other point the right way.
struct SideCheck {
  std::vector<std::uint32_t> turned = {};  // flipped components
  double inward = 0;  // share of points where the winding number contradicts the normal
};
// Flips a closed component if the mean of the winding numbers behind and before its points is
// wrong. The mean is 1/2 if the sign is right, -1/2 for a body that faces inwards, and 3/2 for an
// inner wall that faces as the outer one. `component` is per sample.
SideCheck check_sides(std::vector<SignSample> samples, std::span<const std::uint32_t> component,
                      double scatter, const Context& context);

}  // namespace rholm
