#include "edit/texture/detail_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {
namespace {

constexpr int kMostSamples = 1024;  // samples per side: 16 MB
// Numbers of rings and angles for alignment; a parabola finds the peak between angles.
constexpr int kRings = 48, kAngles = 720;

// Returns the weights of four neighbours.
std::array<double, 4> cubic(double t) {
  const double u = 1 - t;
  return {-0.5 * t * u * u, 1 + t * t * (1.5 * t - 2.5), 1 + u * u * (1.5 * u - 2.5),
          -0.5 * u * t * t};
}

double interpolate(const DetailMap& map, const std::vector<double>& values, const Place2& at) {
  const double middle = (map.n - 1) / 2.0;
  const double x = at.p / map.step + middle, y = at.q / map.step + middle;
  if (!(x >= 1) || !(y >= 1) || !(x < map.n - 2) || !(y < map.n - 2)) return 0;
  const auto i = static_cast<std::size_t>(x), j = static_cast<std::size_t>(y);
  const std::array<double, 4> a = cubic(x - static_cast<double>(i));
  const std::array<double, 4> b = cubic(y - static_cast<double>(j));
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double* const line = &values[(j + k - 1) * static_cast<std::size_t>(map.n) + i - 1];
    sum += b[k] * (a[0] * line[0] + a[1] * line[1] + a[2] * line[2] + a[3] * line[3]);
  }
  return sum;
}

// Returns the values on a ring at kAngles angles.
std::vector<double> ring(const DetailMap& map, double radius) {
  std::vector<double> values(kAngles);
  for (int k = 0; k < kAngles; ++k) {
    const double phi = 2 * std::numbers::pi * k / kAngles;
    const Place2 at{radius * std::cos(phi), radius * std::sin(phi)};
    values[static_cast<std::size_t>(k)] = map(at);
  }
  return values;
}

}  // namespace

double DetailMap::operator()(const Place2& at) const { return interpolate(*this, values, at); }

double DetailMap::weight(const Place2& at) const {
  return std::clamp(interpolate(*this, weights, at), 0.0, 1.0);
}

DetailMap empty_map(double half_width, double step) {
  DetailMap map;
  const double wanted = 2 * half_width / step + 5;
  map.n = wanted < kMostSamples ? static_cast<int>(wanted) : kMostSamples;
  map.step = 2 * half_width / (map.n - 5);
  const auto n = static_cast<std::size_t>(map.n);
  map.values.assign(n * n, 0);
  map.weights.assign(n * n, 0);
  return map;
}

void draw(const std::array<DetailCorner, 3>& triangle, DetailMap& map) {
  const auto [a, b, c] = triangle;
  const double ux = b.at.p - a.at.p, uy = b.at.q - a.at.q;
  const double vx = c.at.p - a.at.p, vy = c.at.q - a.at.q;
  const double area = ux * vy - uy * vx;
  // The triangle is seen from behind: a fold.
  if (!(area > 0)) return;
  const double middle = (map.n - 1) / 2.0;
  const auto range = [&](double x, double y, double z) {
    const double low = std::min({x, y, z}) / map.step + middle;
    const double high = std::max({x, y, z}) / map.step + middle;
    return std::array{static_cast<int>(std::ceil(std::clamp(low, 0.0, map.n - 1.0))),
                      static_cast<int>(std::floor(std::clamp(high, -1.0, map.n - 1.0)))};
  };
  const auto [left, right] = range(a.at.p, b.at.p, c.at.p);
  const auto [bottom, top] = range(a.at.q, b.at.q, c.at.q);
  for (int j = bottom; j <= top; ++j) {
    for (int i = left; i <= right; ++i) {
      const double x = (i - middle) * map.step - a.at.p, y = (j - middle) * map.step - a.at.q;
      const double s = (x * vy - y * vx) / area, t = (ux * y - uy * x) / area;
      if (s < 0 || t < 0 || s + t > 1) continue;
      const std::size_t at = static_cast<std::size_t>(j) * static_cast<std::size_t>(map.n) +
                             static_cast<std::size_t>(i);
      const auto tangent = [&](const DetailCorner& corner) {
        const double along = corner.slope.p * (x + a.at.p - corner.at.p) +
                             corner.slope.q * (y + a.at.q - corner.at.q);
        return corner.height + 0.5 * along;
      };
      map.values[at] = (1 - s - t) * tangent(a) + s * tangent(b) + t * tangent(c);
      map.weights[at] = a.weight + s * (b.weight - a.weight) + t * (c.weight - a.weight);
    }
  }
}

Alignment align_maps(const DetailMap& a, double scale, const DetailMap& b) {
  std::vector<double> product(kAngles, 0);
  double energy_a = 0, energy_b = 0;
  for (int k = 1; k <= kRings; ++k) {
    const double radius = static_cast<double>(k) / kRings;
    const std::vector<double> of_a = ring(a, radius * scale), of_b = ring(b, radius);
    for (std::size_t i = 0; i < kAngles; ++i) {
      energy_a += radius * of_a[i] * of_a[i];
      energy_b += radius * of_b[i] * of_b[i];
      // Compares b with a turned by i steps.
      double sum = 0;
      for (std::size_t j = 0; j < kAngles - i; ++j) sum += of_a[j] * of_b[j + i];
      for (std::size_t j = kAngles - i; j < kAngles; ++j) sum += of_a[j] * of_b[j + i - kAngles];
      product[i] += radius * sum;
    }
  }
  if (!(energy_a > 0) || !(energy_b > 0)) return {};
  const auto best =
      static_cast<std::size_t>(std::max_element(product.begin(), product.end()) - product.begin());
  const double before = product[(best + kAngles - 1) % kAngles], at = product[best];
  const double after = product[(best + 1) % kAngles];
  const double bend = before - 2 * at + after;
  const double part = bend < 0 ? 0.5 * (before - after) / bend : 0;
  const double angle = 2 * std::numbers::pi * (static_cast<double>(best) + part) / kAngles;
  return {std::remainder(angle, 2 * std::numbers::pi), at / std::sqrt(energy_a * energy_b)};
}

}  // namespace rholm
