// Derivation of the bounds: a triangle has its longest edge of length L along the unit vector
// l, its height h over this edge along m, and its normal n. If corners move by at most
// `error` along each axis, they move along m by at most a = sum_k error_k |m_k|. They move along n
// by at most b = sum_k error_k |n_k|.
// - The apex and the line of the edge approach each other by at most 2 a. For h <= 2 a some
//   triangle within the errors has no area.
// - Otherwise the plane turns about the edge by at most 2 b over the remaining height h - 2 a.
//   It turns along the edge by at most 2 b over L.
#include "shape/coordinate_error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/cancel.h"
#include "shape/vertex_range.h"

namespace rholm {
namespace {

// Error relative to the largest coordinate, for coordinates in double precision that are results of
// computations. Chosen: rotations, intersections and conversions of units lose at most ten of the
// 53 bits.
constexpr double kDoubleError = 0x1p-43;
// Error relative to the largest coordinate, between one and two spacings of floats there: storing a
// coordinate loses half a spacing, and computing it in single precision loses another half.
constexpr double kSingleError = 0x1p-23;
// Least number of digits of rounded decimals. Chosen: decimals with fewer digits are written by
// hand, or by formats for voxels, and are exact.
constexpr int kFewestDigits = 5;
// Largest number of digits of decimals; with more, the last digit is below kDoubleError.
constexpr int kMostDigits = 13;
// Number of digits from which decimals are compared with single-precision numbers.
constexpr int kDigitsOfSingle = 8;
// Decimals below this part of the largest coordinate are noise of a computation (chosen).
constexpr double kNoise = 1e-9;
// Number of faces looked at before coordinates are taken as rounded (chosen: some 10 us).
constexpr std::size_t kSampled = 1000;

// Calls visit(coordinate) until it returns false; returns true if it never did.
template <typename Visit>
bool all_coordinates(const MeshView& mesh, const Visit& visit) {
  CancelPoll poll;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    const Vec3 v = mesh.vertex(i);
    if (!visit(v.x) || !visit(v.y) || !visit(v.z)) return false;
  }
  return true;
}

bool is_single(double x) { return std::abs(x) < 1e38 && double{static_cast<float>(x)} == x; }

// Returns 10^k exactly, for 0 <= k <= 22.
double power_of_ten(int k) {
  double power = 1;
  for (; k > 0; --k) power *= 10;
  return power;
}

// Returns the multiple of 10^-decimals nearest to x, exactly as reading its decimal text does:
// 10^22 and integers below 2^53 are exact, and the division rounds once.
double to_decimals(double x, int decimals) {
  if (decimals < 0) {
    const double power = power_of_ten(-decimals);
    return std::round(x / power) * power;
  }
  const double power = power_of_ten(decimals);
  return std::round(x * power) / power;
}

int digits_before_point(double x) {
  return x > 0 ? static_cast<int>(std::floor(std::log10(x))) + 1 : 0;
}

// Decimal notation in which all coordinates are written.
struct Decimals {
  int digits = 0;      // digits of the largest coordinate if `fixed`, of every coordinate otherwise
  bool fixed = false;  // true: all have the same number of decimals; false: of digits

  int decimals(double x) const { return digits - digits_before_point(std::abs(x)); }
};

// Returns the notation with the fewest digits, at first with `digits` of the largest coordinate,
// then of each one. Returns nothing if both need more than kMostDigits digits.
std::optional<Decimals> decimals_of(const MeshView& mesh, double largest) {
  const int before = digits_before_point(largest);
  if (before > kMostDigits || before < kMostDigits - 22) return std::nullopt;
  int decimals = std::max(0, -before);
  if (all_coordinates(mesh, [&](double x) {
        while (before + decimals <= kMostDigits && to_decimals(x, decimals) != x) ++decimals;
        return before + decimals <= kMostDigits;
      })) {
    return Decimals{.digits = decimals > 0 ? before + decimals : 0, .fixed = true};
  }
  Decimals each{.digits = 1};
  if (all_coordinates(mesh, [&](double x) {
        if (std::abs(x) < kNoise * largest) return true;
        const auto fits = [&] {
          const int k = each.decimals(x);
          return k <= 22 && k >= -22 && to_decimals(x, k) == x;
        };
        while (each.digits <= kMostDigits && !fits()) ++each.digits;
        return each.digits <= kMostDigits;
      })) {
    return each;
  }
  return std::nullopt;
}

bool are_written_singles(const MeshView& mesh, const Decimals& written, double largest) {
  if (written.digits < kDigitsOfSingle) return false;
  return all_coordinates(mesh, [&](double x) {
    const double single = static_cast<float>(x);
    return std::abs(x) < kNoise * largest ||
           to_decimals(single, written.decimals(written.fixed ? largest : x)) == x;
  });
}

// Returns true if fewer than half of a sample of the faces are thinner than the error.
bool leaves_most_faces(const MeshView& mesh, double scale, const Vec3& error) {
  const std::size_t step = std::max<std::size_t>(1, mesh.n_faces / kSampled);
  std::size_t thin = 0, n = 0;
  for (std::size_t t = 0; t < mesh.n_faces; t += step, ++n) {
    const Triangle triangle = mesh.triangle(t);
    if (std::ranges::max(triangle) >= mesh.n_vertices) validate(mesh);  // throws with the index
    thin += is_thin(scaled_corners(mesh, triangle, scale), scale * error);
  }
  return 2 * thin < n;
}

Vec3 last_digits(const Decimals& written, const Vec3& largest, double most) {
  const auto step = [&](double x) {
    return x > 0 || written.fixed ? std::pow(10.0, -written.decimals(written.fixed ? most : x)) : 0;
  };
  return {step(largest.x), step(largest.y), step(largest.z)};
}

}  // namespace

bool is_in_single_precision(const MeshView& mesh) {
  return mesh.coordinate == ScalarType::kFloat32 || all_coordinates(mesh, is_single);
}

Vec3 coordinate_error(const MeshView& mesh) {
  const VertexRange range = vertex_range(mesh, {.threads = 1});
  const auto modulus = [&](int k) {
    return mesh.n_vertices == 0 ? 0 : std::max(std::abs(range.min[k]), std::abs(range.max[k]));
  };
  const Vec3 largest{modulus(0), modulus(1), modulus(2)};
  const double most = std::max({largest.x, largest.y, largest.z});
  const double scale = unit_frame({.min = -largest, .max = largest}).scale;
  const auto larger = [](const Vec3& a, const Vec3& b) {
    return Vec3{std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  };
  Vec3 error = kDoubleError * largest;
  const auto take = [&](const Vec3& rounding) {
    if (leaves_most_faces(mesh, scale, rounding)) error = larger(error, rounding);
  };
  bool single = is_in_single_precision(mesh);
  if (!single) {
    if (const std::optional<Decimals> written = decimals_of(mesh, most)) {
      single = are_written_singles(mesh, *written, most);
      if (written->digits >= kFewestDigits) take(last_digits(*written, largest, most));
    }
  }
  if (single) take(kSingleError * largest);
  return error;
}

PlaneUncertainty plane_uncertainty(const std::array<Vec3, 3>& corners, const FaceNormal& normal,
                                   const Vec3& error) {
  const double twice_area = norm(normal.twice_area);
  if (normal.degenerate || !(twice_area > 0)) return {.thin = true};
  Vec3 edge;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 e = corners[k == 2 ? 0 : k + 1] - corners[k];
    if (dot(e, e) > dot(edge, edge)) edge = e;
  }
  const double length = norm(edge), height = twice_area / length;
  const Vec3 n = normal.twice_area / twice_area, m = cross(n, edge / length);
  const auto along = [&](const Vec3& v) {
    return error.x * std::abs(v.x) + error.y * std::abs(v.y) + error.z * std::abs(v.z);
  };
  const double left = height - 2 * along(m);
  if (!(left > 0)) return {.thin = true};
  const double across = 2 * along(n);
  return {.turn = across / left + across / length};
}

bool is_thin(const std::array<Vec3, 3>& corners, const Vec3& error) {
  return plane_uncertainty(corners, face_normal(corners), error).thin;
}

}  // namespace rholm
