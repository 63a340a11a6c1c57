#include "reconstruct/file/atlas_pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "harmonic/legendre/low_harmonics.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr double kLargest = 32767;    // of an int16
constexpr double kSameWeight = 1e-5;  // supports are kept with 24 bits
constexpr double kProbes = 400;  // on a cap's surface, for its deviation: 0.1 of its radius apart

// Returns the vector along the axis of the rotation that takes the coordinate axes to x, y, z; its
// length is the angle. Uses the unit quaternion, whose largest part is taken from a root: exact at
// all angles.
Vec3 rotation_vector(const CapFrame& f) {
  const double trace = f.x.x + f.y.y + f.z.z;
  const std::array<double, 4> squares = {1 + trace, 1 + 2 * f.x.x - trace, 1 + 2 * f.y.y - trace,
                                         1 + 2 * f.z.z - trace};
  const auto largest = std::max_element(squares.begin(), squares.end()) - squares.begin();
  std::array<double, 4> q = {};  // w, x, y, z
  const double wx = f.y.z - f.z.y, wy = f.z.x - f.x.z, wz = f.x.y - f.y.x;
  const double xy = f.x.y + f.y.x, xz = f.z.x + f.x.z, yz = f.y.z + f.z.y;
  switch (largest) {
    case 0:
      q = {squares[0], wx, wy, wz};
      break;
    case 1:
      q = {wx, squares[1], xy, xz};
      break;
    case 2:
      q = {wy, xy, squares[2], yz};
      break;
    default:
      q = {wz, xz, yz, squares[3]};
      break;
  }
  if (q[0] < 0) q = {-q[0], -q[1], -q[2], -q[3]};
  const Vec3 axis{q[1], q[2], q[3]};
  const double sine = norm(axis);
  return sine > 0 ? (2 * std::atan2(sine, q[0]) / sine) * axis : Vec3{};
}

Vec3 rotate(const Vec3& v, const Vec3& rotation) {
  const double angle = norm(rotation);
  if (!(angle > 0)) return v;
  const Vec3 axis = rotation / angle;
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

bool is_circle(const Cap& cap) {
  const CapSupport& w = cap.where;
  const double square = 1 / (cap.frame.support * cap.frame.support);
  return w.px == 0 && w.py == 0 && w.xy == 0 && std::abs(w.xx - square) < 1e-9 * square &&
         std::abs(w.yy - square) < 1e-9 * square;
}

Vec3 middle_of(const Atlas& atlas) {
  if (atlas.caps.empty()) return {};
  Vec3 low = atlas.caps.front().frame.seed(), high = low;
  for (const Cap& cap : atlas.caps) {
    const Vec3 s = cap.frame.seed();
    low = {std::min(low.x, s.x), std::min(low.y, s.y), std::min(low.z, s.z)};
    high = {std::max(high.x, s.x), std::max(high.y, s.y), std::max(high.z, s.z)};
  }
  return 0.5 * (low + high);
}

void pack_cap(const Cap& cap, std::span<const double> coefficients, PackedAtlas& packed) {
  const CapFrame& f = cap.frame;
  const Vec3 seed = f.seed() - packed.origin, turn = rotation_vector(f);
  double largest = 0;
  for (const double c : coefficients) largest = std::max(largest, std::abs(c));
  for (const double number : {seed.x, seed.y, seed.z, turn.x, turn.y, turn.z, f.radius, f.dilation,
                              f.support, largest / kLargest, cap.error}) {
    packed.caps.push_back(static_cast<float>(number));
  }
}

// Finds the power that all weights follow. If there is none, the weights are kept one by one.
void pack_weights(const Atlas& atlas, PackedAtlas& packed) {
  double largest = 0, smallest = INFINITY, weight = 1;
  for (const Cap& cap : atlas.caps) {
    largest = std::max(largest, cap.frame.support);
    if (cap.frame.support >= smallest) continue;
    smallest = cap.frame.support;
    weight = cap.weight;
  }
  if (largest > smallest) packed.weight_power = std::log(weight) / std::log(largest / smallest);
  const bool follow = std::all_of(atlas.caps.begin(), atlas.caps.end(), [&](const Cap& cap) {
    const double rule = std::pow(largest / cap.frame.support, packed.weight_power);
    return std::abs(cap.weight - rule) < kSameWeight * rule;
  });
  if (follow) return;
  for (const Cap& cap : atlas.caps) packed.weights.push_back(static_cast<float>(cap.weight));
}

void pack_coefficients(std::span<const double> coefficients, std::size_t first,
                       PackedAtlas& packed) {
  const float step = packed.caps[packed.caps.size() - 2];
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double ratio = step > 0 ? std::round(coefficients[i] / step) : 0;
    const auto value = static_cast<std::int16_t>(std::clamp(ratio, -kLargest, kLargest));
    if (value == 0) continue;
    packed.kept[(first + i) / 8] |= static_cast<std::uint8_t>(1U << ((first + i) % 8));
    packed.values.push_back(value);
  }
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, name + ": " + what + ": the file is damaged");
}

void check_sizes(const PackedAtlas& p, const std::string& name) {
  const std::size_t n = p.degrees.size();
  const auto check = [&](std::size_t size, std::size_t wanted, const char* what) {
    if (size == wanted) return;
    refuse(name, fmt::format("it has {} {} for {} caps instead of {}", size, what, n, wanted));
  };
  check(p.caps.size(), kPackedCap * n, "numbers");
  if (!p.ellipses.empty()) check(p.ellipses.size(), 5 * n, "numbers of ellipses");
  if (!p.weights.empty()) check(p.weights.size(), n, "weights");
  std::size_t coefficients = 0;
  for (const std::uint8_t degree : p.degrees) {
    if (degree > kMaxLowDegree) {
      refuse(name, fmt::format("a cap has degree {}, more than {}", degree, kMaxLowDegree));
    }
    coefficients += n_coefficients(p.basis, degree);
  }
  check(p.kept.size(), (coefficients + 7) / 8, "bytes of kept bits");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < coefficients; ++i) kept += (p.kept[i / 8] >> (i % 8)) & 1U;
  check(p.values.size(), kept, "coefficients");
}

void check_numbers(const PackedAtlas& p, const std::string& name) {
  const auto finite = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  };
  if (!finite(p.caps) || !finite(p.ellipses) || !finite(p.weights) || !is_finite(p.origin) ||
      !std::isfinite(p.weight_power)) {
    refuse(name, "a number of a cap is not finite");
  }
  for (std::size_t c = 0; c < p.degrees.size(); ++c) {
    const float* const f = &p.caps[kPackedCap * c];
    if (!(f[6] > 0 && f[7] >= 1 && f[8] > 0)) {
      refuse(name,
             fmt::format("cap {} has radius {}, dilation {}, support {}", c, f[6], f[7], f[8]));
    }
    if (!p.weights.empty() && !(p.weights[c] > 0)) {
      refuse(name, fmt::format("cap {} has weight {}", c, p.weights[c]));
    }
    if (p.ellipses.empty()) continue;
    const float* const e = &p.ellipses[5 * c];
    if (!(e[2] > 0 && double{e[2]} * e[4] - double{e[3]} * e[3] > 0)) {
      refuse(name, fmt::format("the support of cap {} is not an ellipse", c));
    }
  }
}

Cap unpack_cap(const PackedAtlas& p, std::size_t c) {
  Cap cap;
  const float* const f = &p.caps[kPackedCap * c];
  const Vec3 turn{f[3], f[4], f[5]};
  cap.frame.x = rotate({1, 0, 0}, turn);
  cap.frame.y = rotate({0, 1, 0}, turn);
  cap.frame.z = rotate({0, 0, 1}, turn);
  cap.frame.radius = f[6], cap.frame.dilation = f[7];
  cap.frame.center = p.origin + Vec3{f[0], f[1], f[2]} - cap.frame.radius * cap.frame.z;
  set_support(cap, f[8]);
  if (!p.ellipses.empty()) {
    const float* const e = &p.ellipses[5 * c];
    cap.where = {e[0], e[1], e[2], e[3], e[4]};
  }
  cap.basis = p.basis;
  cap.degree = p.degrees[c];
  cap.error = f[10];
  return cap;
}

}  // namespace

PackedAtlas pack(const Atlas& atlas) {
  PackedAtlas packed;
  packed.origin = middle_of(atlas);
  packed.spacing = atlas.spacing, packed.noise = atlas.noise;
  packed.diagonal = atlas.diagonal, packed.band = atlas.band;
  packed.blend = atlas.blend;
  if (!atlas.caps.empty()) packed.basis = atlas.caps.front().basis;
  std::size_t coefficients = 0;
  for (const Cap& cap : atlas.caps) coefficients += n_coefficients(cap.basis, cap.degree);
  packed.kept.assign((coefficients + 7) / 8, 0);
  const bool circles = std::all_of(atlas.caps.begin(), atlas.caps.end(), is_circle);
  pack_weights(atlas, packed);
  std::size_t first = 0;
  for (const Cap& cap : atlas.caps) {
    if (cap.basis != packed.basis) {
      throw Error(ErrorCode::kInvalidInput,
                  "the caps of an atlas have different bases: a model file holds one");
    }
    pack_cap(cap, atlas.coefficients_of(cap), packed);
    if (!circles) {
      for (const double e : {cap.where.px, cap.where.py, cap.where.xx, cap.where.xy, cap.where.yy})
        packed.ellipses.push_back(static_cast<float>(e));
    }
    packed.degrees.push_back(static_cast<std::uint8_t>(cap.degree));
    pack_coefficients(atlas.coefficients_of(cap), first, packed);
    first += n_coefficients(cap.basis, cap.degree);
  }
  return packed;
}

Atlas unpack(const PackedAtlas& packed, const std::string& name, bool deviations) {
  check_sizes(packed, name);
  check_numbers(packed, name);
  Atlas atlas;
  atlas.spacing = packed.spacing, atlas.noise = packed.noise;
  atlas.diagonal = packed.diagonal, atlas.band = packed.band;
  atlas.blend = packed.blend;
  std::size_t value = 0, bit = 0;
  for (std::size_t c = 0; c < packed.degrees.size(); ++c) {
    Cap cap = unpack_cap(packed, c);
    cap.first = atlas.coefficients.size();
    const std::size_t n = n_coefficients(cap.basis, cap.degree);
    for (std::size_t i = 0; i < n; ++i, ++bit) {
      const bool kept = ((packed.kept[bit / 8] >> (bit % 8)) & 1U) != 0;
      atlas.coefficients.push_back(
          kept ? double{packed.caps[kPackedCap * c + 9]} * packed.values[value++] : 0);
    }
    if (deviations) cap.deviation = deviation_of(cap, atlas.coefficients_of(cap));
    atlas.caps.push_back(cap);
  }
  set_weights(atlas.caps, packed.weight_power);
  for (std::size_t c = 0; c < packed.weights.size(); ++c) atlas.caps[c].weight = packed.weights[c];
  return atlas;
}

double deviation_of(const Cap& cap, std::span<const double> coefficients) {
  const CapFrame& f = cap.frame;
  CapPoints plane;
  for (double k = 0; k < kProbes; ++k) {
    const double r = f.support * std::sqrt((k + 0.5) / kProbes);
    const double angle = k * std::numbers::pi * (3 - std::sqrt(5.0));
    plane.add(r * std::cos(angle) * f.x + r * std::sin(angle) * f.y, f.z, 1);
  }
  plane.pad();
  std::vector<double> at(3 * plane.padded()), across(at.size());
  cap_surface(cap, coefficients, plane, at, across);
  double deviation = 0;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    const Vec3 offset{at[k], at[plane.padded() + k], at[2 * plane.padded() + k]};
    const double height = std::abs(dot(offset, f.z));
    if (height <= f.support) deviation = std::max(deviation, height);  // also not for NaN
  }
  // Between the probes it rises by a tenth of the radius times its slope, at most about 1.
  return std::min(f.support, deviation + 0.05 * f.support);
}

}  // namespace rholm
