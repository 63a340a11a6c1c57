#include "reconstruct/file/atlas_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/crc32.h"
#include "reconstruct/file/atlas_crc32.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Largest number allowed: squares of larger ones may not be finite.
constexpr double kLargest = std::numeric_limits<float>::max();
constexpr double kFrameError = 1e-9;  // of axes: far above rounding
// Numbers of cubes along an axis, as SeenSpace makes them.
constexpr std::size_t kFewestCubes = 3, kMostCubes = 256;

std::array<double, kExactCap> numbers_of(const Cap& cap) {
  const CapFrame& f = cap.frame;
  const CapSupport& w = cap.where;
  return {f.center.x, f.center.y, f.center.z, f.x.x,    f.x.y,      f.x.z,
          f.y.x,      f.y.y,      f.y.z,      f.z.x,    f.z.y,      f.z.z,
          f.radius,   f.dilation, f.support,  w.px,     w.py,       w.xx,
          w.xy,       w.yy,       cap.error,  cap.area, cap.weight, cap.deviation};
}

void set_numbers(std::span<const double> n, Cap& cap) {
  CapFrame& f = cap.frame;
  f.center = {n[0], n[1], n[2]};
  f.x = {n[3], n[4], n[5]}, f.y = {n[6], n[7], n[8]}, f.z = {n[9], n[10], n[11]};
  f.radius = n[12], f.dilation = n[13], f.support = n[14];
  cap.where = {n[15], n[16], n[17], n[18], n[19]};
  cap.error = n[20], cap.area = n[21], cap.weight = n[22], cap.deviation = n[23];
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, name + ": " + what + ": the file is damaged");
}

void check_size(std::size_t size, std::size_t wanted, const char* what, const std::string& name) {
  if (size == wanted) return;
  refuse(name, fmt::format("its reconstruction has {} {} instead of {}", size, what, wanted));
}

void check_finite(const std::vector<double>& values, const char* what, const std::string& name) {
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double v) { return std::abs(v) <= kLargest; });
  if (!finite) refuse(name, fmt::format("a number of the reconstruction's {} is not finite", what));
}

bool is_frame(const CapFrame& f) {
  const auto is = [](double value, double wanted) {
    return std::abs(value - wanted) < kFrameError;
  };
  return is(dot(f.x, f.x), 1) && is(dot(f.z, f.z), 1) && is(dot(f.x, f.z), 0) &&
         norm(cross(f.z, f.x) - f.y) < kFrameError;
}

void check_cap(const Cap& cap, std::size_t c, const std::string& name) {
  const CapFrame& f = cap.frame;
  const CapSupport& w = cap.where;
  if (!is_frame(f)) refuse(name, fmt::format("the axes of cap {} are no frame", c));
  if (!(f.radius > 0 && f.dilation >= 1 && f.support > 0)) {
    refuse(name, fmt::format("cap {} has radius {}, dilation {}, support {}", c, f.radius,
                             f.dilation, f.support));
  }
  if (!(w.xx > 0 && w.xx * w.yy - w.xy * w.xy > 0)) {
    refuse(name, fmt::format("the support of cap {} is not an ellipse", c));
  }
  if (!(cap.weight > 0 && cap.area >= 0 && cap.deviation >= 0 && cap.error >= 0)) {
    refuse(name, fmt::format("cap {} has weight {}, area {}, deviation {}, error {}", c, cap.weight,
                             cap.area, cap.deviation, cap.error));
  }
}

}  // namespace

PackedRules pack_rules(const Atlas& atlas, const SurfaceRules& rules) {
  PackedRules packed;
  packed.caps.reserve(kExactCap * atlas.caps.size());
  packed.coefficients.reserve(atlas.coefficients.size());
  for (const Cap& cap : atlas.caps) {
    const std::array<double, kExactCap> numbers = numbers_of(cap);
    packed.caps.insert(packed.caps.end(), numbers.begin(), numbers.end());
    const std::span<const double> own = atlas.coefficients_of(cap);
    packed.coefficients.insert(packed.coefficients.end(), own.begin(), own.end());
  }
  packed.spacings.reserve(kSpacingNumbers * rules.spacing_places.size());
  for (std::size_t i = 0; i < rules.spacing_places.size(); ++i) {
    const Vec3& place = rules.spacing_places[i];
    packed.spacings.insert(packed.spacings.end(), {place.x, place.y, place.z, rules.spacings[i]});
  }
  if (rules.seen) packed.seen = rules.seen->bits;
  return packed;
}

void unpack_caps(const PackedRules& packed, const std::string& name, Atlas& atlas) {
  check_size(packed.caps.size(), kExactCap * atlas.caps.size(), "numbers of caps", name);
  check_size(packed.coefficients.size(), atlas.coefficients.size(), "coefficients", name);
  check_finite(packed.caps, "caps", name);
  check_finite(packed.coefficients, "coefficients", name);
  for (std::size_t c = 0; c < atlas.caps.size(); ++c) {
    set_numbers(std::span(packed.caps).subspan(kExactCap * c, kExactCap), atlas.caps[c]);
    check_cap(atlas.caps[c], c, name);
  }
  atlas.coefficients = packed.coefficients;
}

void unpack_rules(PackedRules packed, const std::string& name, SurfaceRules& rules) {
  check_finite(packed.spacings, "spacings", name);
  const std::size_t n = packed.spacings.size() / kSpacingNumbers;
  rules.spacing_places.reserve(n), rules.spacings.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* const of = &packed.spacings[kSpacingNumbers * i];
    if (!(of[3] > 0)) refuse(name, fmt::format("the spacing of place {} is {}", i, of[3]));
    rules.spacing_places.push_back({of[0], of[1], of[2]});
    rules.spacings.push_back(of[3]);
  }
  if (!rules.seen) return;
  SeenCubes& seen = *rules.seen;
  std::size_t cubes = 1;
  for (const std::size_t size : seen.size) {
    if (size < kFewestCubes || size > kMostCubes) {
      refuse(name, fmt::format("its seen space is {} cubes wide", size));
    }
    cubes *= size;
  }
  if (!(seen.edge > 0)) refuse(name, fmt::format("cubes of its seen space are {} wide", seen.edge));
  check_size(packed.seen.size(), (cubes + 7) / 8, "bytes of seen space", name);
  seen.bits = std::move(packed.seen);
}

std::uint32_t rules_crc32(const PackedRules& packed, const std::vector<std::string>& left_out) {
  std::uint32_t sum = crc32_of(packed.caps, packed.coefficients, packed.spacings, packed.seen);
  for (const std::string& name : left_out) sum = crc32(name, sum);
  return sum;
}

}  // namespace rholm
