// Computes rigid motions of several scans from pairs of places that should coincide. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/vec3.h"
#include "shape/points/symmetric.h"
#include "shape/rigid_motion.h"

namespace rholm {

// A place of one scan, and the place of another scan whose tangent plane should contain it.
struct ScanPair {
  std::uint32_t from = 0, to = 0;  // scans
  Vec3 a, b;                       // the places
  Vec3 normal;                     // normal of the plane, unit
  double weight = 1;

  double distance() const { return dot(a - b, normal); }
};

// Describes how points of one scan lie about the common middle, which its motions turn around.
struct ScanBody {
  Matrix6 inertia{};  // mean of J^T J; a point's displacement is J (turn radius, shift)
  double points = 0;  // weight of the scan in the mean motion, which stays zero
};

// Computes a body about `middle`; `radius` is the length that makes turns comparable to shifts.
ScanBody body_of(std::span<const Vec3> points, const Vec3& middle, double radius);

// Returns the motions with the least sum of weight * distance^2, to first order. Motions that no
// pair determines stay zero. The mean motion of all points, in shift and turn, is zero.
std::vector<RigidMotion> solve_motions(std::span<const ScanPair> pairs,
                                       std::span<const ScanBody> bodies, const Vec3& middle,
                                       double radius);

}  // namespace rholm
