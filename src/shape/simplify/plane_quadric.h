// Sums squared distances to planes (Garland and Heckbert 1997), relative to a place near them. Far
// from the origin, the three terms would cancel in single precision.
#pragma once

#include "rholm/vec3.h"

namespace rholm {

// The function sum_k w_k (n_k . x + d_k)^2 = x^T A x + 2 b . x + c.
struct PlaneQuadric {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // the matrix A
  float bx = 0, by = 0, bz = 0;
  float c = 0;
  float weight = 0;  // sum of w_k

  // Adds the plane through the origin with this unit normal.
  void add(const Vec3& n, double w) {
    xx += static_cast<float>(w * n.x * n.x), xy += static_cast<float>(w * n.x * n.y);
    xz += static_cast<float>(w * n.x * n.z), yy += static_cast<float>(w * n.y * n.y);
    yz += static_cast<float>(w * n.y * n.z), zz += static_cast<float>(w * n.z * n.z);
    weight += static_cast<float>(w);
  }

  void add(const PlaneQuadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    bx += q.bx, by += q.by, bz += q.bz;
    c += q.c, weight += q.weight;
  }

  // Returns the value at x, never below zero: negative rounding errors are set to zero.
  float operator()(float x, float y, float z) const {
    const float ax = xx * x + xy * y + xz * z + 2 * bx;
    const float ay = xy * x + yy * y + yz * z + 2 * by;
    const float az = xz * x + yz * y + zz * z + 2 * bz;
    const float value = c + x * ax + y * ay + z * az;
    return value > 0 ? value : 0;
  }

  // Returns the function relative to x: its value at y is the old value at x + y.
  PlaneQuadric seen_from(float x, float y, float z) const {
    PlaneQuadric q = *this;
    q.c = (*this)(x, y, z);
    q.bx += xx * x + xy * y + xz * z;
    q.by += xy * x + yy * y + yz * z;
    q.bz += xz * x + yz * y + zz * z;
    return q;
  }
};

}  // namespace rholm
