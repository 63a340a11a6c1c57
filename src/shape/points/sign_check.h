// Whether given normals agree with those around them, and which of them to turn. Layer: shape.
//
// Pieces (sign_pieces.h) that contradict each other are turned to agree, the smaller one with the
// larger one. So what is turned depends on the signs that most points have.
//
// Two walls nearer to each other than their points contradict each other as well. They are told by
// heights: over all edges between two pieces the mean height of one above the other is zero for one
// sheet, and the distance of the walls for two.
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

// A point of some that stand for all.
struct SignSample {
  Vec3 at, normal;
  double area = 0;  // that it stands for
  double disc = 0;  // likewise, as balance_of() has it
  std::uint32_t piece = 0;
};

// The pieces of all parts: those of the first part come first.
struct AllPieces {
  std::vector<std::uint64_t> own = {};  // per piece, as in SignPieces
  std::vector<PiecePair> pairs = {};
  // Pairs of pieces that are one, because two parts have a point in common.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> same = {};
  double scatter = 0;  // median of the parts
};

// Of a part that has all points.
AllPieces all_of(const SignPieces& part);

// Which pieces to turn.
struct SignCheck {
  std::vector<std::uint32_t> whole = {};      // per piece: the first piece that is one with it
  std::vector<std::uint32_t> component = {};  // per piece: the first piece that its sign depends on
  std::vector<std::uint8_t> turned = {};      // per piece: 1 if it should be turned
  std::uint64_t n_turned = 0;                 // points of these
  std::uint64_t undecided = 0;  // points at creases of which no side is known to be right
  // Wholes that are two walls, a <= b; in order.
  struct Walls {
    std::uint32_t a = 0, b = 0;
    friend auto operator<=>(const Walls&, const Walls&) = default;
  };
  std::vector<Walls> walls = {};

  // Whether the quarrels of two pieces mean that one should be turned, before or after those that
  // should be are.
  bool counts(std::uint32_t a, std::uint32_t b, bool after) const;
};
SignCheck check_signs(const AllPieces& all, std::span<const SignSample> samples,
                      const Context& context);

// The points of a part that contradict many of their neighbours, before or after pieces are turned,
// in order. The first piece of the part is `first` among those of all parts.
std::vector<std::uint32_t> contradicting_points(const SignPieces& part, std::uint32_t first,
                                                const SignCheck& check, bool after);

// Of the contradicting points, those that are named.
inline constexpr std::size_t kNamedPoints = 3;

// Given normals as they should be.
struct MendedSigns {
  SignCheck check;
  std::vector<std::uint8_t> turned = {};  // per piece: in all
  std::uint64_t n_turned = 0;             // points of these
  bool all_inward = false;                // no point contradicts the others; all are turned
  // Share of the points at which the winding number contradicts the normal then.
  double inward = 0;
};
// The signs that check_signs() finds, then all of them turned if they point into what the points
// surround, then components that bound something by themselves turned where the winding number of
// all says so, if the points are of something `closed`.
MendedSigns mend_signs(const AllPieces& all, std::vector<SignSample> samples, bool closed,
                       const Context& context);

// Whether signs that say nothing about each other point the right way.
struct SideCheck {
  std::vector<std::uint32_t> turned = {};  // components
  double inward = 0;  // share of the points at which the winding number contradicts the normal
};
// `component` per sample. Closed components are turned where the mean of the winding numbers behind
// and before their points says that they should be: it is 1/2 of what is right, -1/2 of a body that
// faces inwards, 3/2 of a wall inside a body that faces as the outer one.
SideCheck check_sides(std::vector<SignSample> samples, std::span<const std::uint32_t> component,
                      double scatter, const Context& context);

}  // namespace rholm
