// Heights over the plane of a chart. Layer: edit.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace rholm {

struct Place2 {
  double p = 0, q = 0;
};
inline Place2 operator+(const Place2& a, const Place2& b) { return {a.p + b.p, a.q + b.q}; }
inline Place2 operator-(const Place2& a, const Place2& b) { return {a.p - b.p, a.q - b.q}; }
inline Place2 operator*(double s, const Place2& a) { return {s * a.p, s * a.q}; }
inline double length(const Place2& v) { return std::hypot(v.p, v.q); }

// Square of n x n samples around the origin, 0 where nothing is known.
struct DetailMap {
  int n = 0;
  double step = 0;
  std::vector<double> values;
  std::vector<double> weights;  // 1 in the region, falling to 0 where nothing is known

  // Interpolate samples by cubic convolution (Catmull-Rom); 0 beyond the square.
  double operator()(const Place2& at) const;
  double weight(const Place2& at) const;
};

// Corner of a triangle over the plane, with the slope of the heights there.
struct DetailCorner {
  Place2 at;
  double height = 0, weight = 0;
  Place2 slope = {};
};
DetailMap empty_map(double half_width, double step);
// Draws a triangle. Heights between the corners are exact for quadratic functions:
// half way between the corners' mean and the mean of their tangent planes.
void draw(const std::array<DetailCorner, 3>& triangle, DetailMap& map);

// Returns the counter-clockwise angle in radians that turns `a` to be most
// similar to `b`, and their correlation then, -1 ... 1. Both are 0 if either map
// is flat. The disc of radius `scale` of `a` is laid on the unit disc of `b`.
struct Alignment {
  double angle = 0;
  double correlation = 0;
};
Alignment align_maps(const DetailMap& a, double scale, const DetailMap& b);

}  // namespace rholm
