// Rigid motions of several scans from pairs of places that shall meet. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "shape/points/symmetric.h"
#include "shape/rigid_motion.h"

namespace rholm {

// A place of one scan and the place of another that it shall lie in a plane with.
struct ScanPair {
  std::uint32_t from = 0, to = 0;  // scans
  Vec3 a, b;                       // their places
  Vec3 normal;                     // of the plane, unit
  double weight = 1;

  double distance() const { return dot(a - b, normal); }
};

// How points of one scan lie about the common middle: what its motions move.
struct ScanBody {
  Matrix6 inertia{};  // mean of J^T J, the displacement of a point being J (turn radius, shift)
  double points = 0;  // its share in the mean motion, which stays zero
};

// About `middle`, with lengths of `radius` for turns.
ScanBody body_of(std::span<const Vec3> points, const Vec3& middle, double radius);

// The motions that make the sum of weight * distance^2 least, to first order; what no pair knows of
// stays. All points together do not move, in the mean, nor turn.
std::vector<RigidMotion> solve_motions(std::span<const ScanPair> pairs,
                                       std::span<const ScanBody> bodies, const Vec3& middle,
                                       double radius);

}  // namespace rholm
