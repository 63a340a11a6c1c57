#include "io/shapes/single_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace rholm {
namespace {

double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

Vec3 rounded(const Vec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

// A face may turn by so much: a shape in the middle of its coordinates turns none of its faces by
// more unless they are as narrow as the rounding. Chosen: cosine of 10 degrees.
constexpr double kLeastCosine = 0.984808;

// A shape in the middle of its coordinates has steps of 6e-8 of its diagonal; chosen: a hundred
// times that is worth a word.
constexpr double kMostStep = 1e-5;

}  // namespace

void SinglePrecisionLoss::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (faces_++ == 0) min_ = max_ = a;
  for (const Vec3* p : {&a, &b, &c}) {
    min_ = {std::min(min_.x, p->x), std::min(min_.y, p->y), std::min(min_.z, p->z)};
    max_ = {std::max(max_.x, p->x), std::max(max_.y, p->y), std::max(max_.z, p->z)};
  }
  const Vec3 u = normalized(b - a), v = normalized(c - a);
  const Vec3 before = normalized(cross(u, v));
  if (before == Vec3{}) return;  // nothing to lose
  const Vec3 ra = rounded(a);
  const Vec3 after = normalized(cross(normalized(rounded(b) - ra), normalized(rounded(c) - ra)));
  lost_ += !(dot(before, after) >= kLeastCosine);
}

double SinglePrecisionLoss::step() const {
  double largest = 0;
  for (const double c : {min_.x, min_.y, min_.z, max_.x, max_.y, max_.z}) {
    largest = std::max(largest, std::abs(c));
  }
  const auto value = static_cast<float>(largest);
  return static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity())) -
         static_cast<double>(value);
}

std::optional<std::string> SinglePrecisionLoss::warning(const std::string& format,
                                                        const std::string& instead) const {
  if (faces_ == 0) return std::nullopt;
  const double spacing = step();
  const bool coarse = spacing > kMostStep * norm(max_ - min_);
  if (lost_ == 0 && !coarse) return std::nullopt;
  std::string text = fmt::format("{} has single precision, in steps of {:.3g} at these coordinates",
                                 format, spacing);
  if (lost_ > 0) {
    text += fmt::format(": {} of {} faces lose their area or turn by more than 10 degrees", lost_,
                        faces_);
  }
  return text + fmt::format("; {}", instead) + (coarse ? ", or move the shape to the origin" : "");
}

}  // namespace rholm
