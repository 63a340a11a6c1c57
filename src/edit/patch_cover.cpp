#include "edit/patch_cover.h"

#include <algorithm>
#include <cmath>

#include "edit/patch_kernels.h"
#include "transform/cap_fit.h"

namespace rholm {
namespace {

// The centre sees the support under this half angle, 3.7 supports below (method 7.2): close to
// rays that are parallel, and the surface's own curvature is left to the harmonics.
constexpr double kHalfAngle = 0.2618;  // 15 degrees
// The support's rim on the opened sphere: the even harmonics are those of a hemisphere (method
// 7.8), and need some room beyond the last points.
constexpr double kOpened = 1.4835;  // 85 degrees
// Points that a cap speaks for are within this part of its support: fits are worst at the rim.
constexpr double kVoice = 0.75;
// Points that need no other cap are within this part. Chosen: five caps at each point.
constexpr double kCovered = 0.5;
// A point belongs to the cap's side of a fold if its normal is within 101 degrees of the axis: the
// walls of a scratch do, the back of a fin does not.
constexpr double kSameSide = -0.2;
constexpr double kGoodShare = 0.85;  // method 7.4
constexpr double kShrink = 0.75;
constexpr double kSmallest = 0.3;      // of the first radius: degree 2
constexpr double kFewestPoints = 1.5;  // of a coefficient

class Gatherer {
 public:
  explicit Gatherer(const LocalMesh& local) : local_(local), seen_(local.points.size(), 0) {}

  // Points connected to the seed within the radius, near ones first.
  const std::vector<std::uint32_t>& gather(std::uint32_t seed, double radius) {
    ++mark_;
    found_.assign(1, seed);
    seen_[seed] = mark_;
    for (std::size_t next = 0; next < found_.size(); ++next) {
      for (const std::uint32_t t : local_.triangles_at(found_[next])) {
        for (const std::uint32_t v : local_.triangles[t]) {
          if (seen_[v] == mark_) continue;
          seen_[v] = mark_;
          if (norm(local_.points[v] - local_.points[seed]) < radius) found_.push_back(v);
        }
      }
    }
    return found_;
  }

 private:
  const LocalMesh& local_;
  std::vector<std::uint32_t> seen_, found_;
  std::uint32_t mark_ = 0;
};

// The mean normal, near points first.
Vec3 axis_of(const LocalMesh& local, std::uint32_t seed, double radius,
             std::span<const std::uint32_t> found) {
  Vec3 sum;
  for (const std::uint32_t v : found) {
    const double d = norm(local.points[v] - local.points[seed]) / radius;
    sum += local.areas[v] * (1 - d * d) * local.normals[v];
  }
  // A sphere seen as a whole has no mean: its seed's normal is as good as any.
  return norm(sum) > 0 ? normalized(sum) : local.normals[seed];
}

// The cap of that radius; returns the share of the area that is on its side.
double make_cap(const LocalMesh& local, std::uint32_t seed, double radius,
                std::span<const std::uint32_t> found, PatchCap& cap) {
  const Vec3 axis = axis_of(local, seed, radius, found);
  cap.frame = cap_frame(local.points[seed], axis, radius, kHalfAngle, kOpened);
  cap.points.clear();
  cap.voices.clear();
  double area = 0, good = 0;
  for (const std::uint32_t v : found) {
    area += local.areas[v];
    const double facing = dot(local.normals[v], axis) - kSameSide;
    const Vec3 offset = local.points[v] - local.points[seed];
    if (!(facing > 0) || dot(offset, axis) < -0.9 * cap.frame.radius) continue;
    good += local.areas[v];
    cap.points.push_back(v);
    const double d2 = dot(offset, offset) / (kVoice * kVoice * radius * radius);
    const double fall = std::max(0.0, 1 - d2);
    cap.voices.push_back(fall * fall * fall * facing * facing);
  }
  return area > 0 ? good / area : 0;
}

}  // namespace

std::vector<PatchCap> cover_patch(const LocalMesh& local, std::span<const double> weights,
                                  double wavelength) {
  std::vector<PatchCap> caps;
  std::vector<std::uint8_t> covered(local.points.size(), 0);
  Gatherer gatherer(local);
  const double largest = kPatchRadius * wavelength;
  for (std::uint32_t seed = 0; seed < local.points.size(); ++seed) {
    if (!(weights[seed] > 0) || covered[seed] != 0) continue;
    covered[seed] = 1;
    if (local.normals[seed] == Vec3{}) continue;
    PatchCap cap;
    double radius = largest, share = 0;
    for (;; radius *= kShrink) {
      share = make_cap(local, seed, radius, gatherer.gather(seed, radius), cap);
      if (share >= kGoodShare || radius * kShrink < kSmallest * largest) break;
    }
    cap.size = radius / largest;
    cap.degree = std::max(2, static_cast<int>(std::lround(kPatchDegree * cap.size)));
    const double affordable = static_cast<double>(cap.points.size()) / kFewestPoints;
    while (cap.degree > 0 && static_cast<double>(patch_basis(cap.degree)) > affordable) {
      --cap.degree;
    }
    for (const std::uint32_t v : cap.points) {
      if (norm(local.points[v] - local.points[seed]) < kCovered * radius) covered[v] = 1;
    }
    caps.push_back(std::move(cap));
  }
  return caps;
}

}  // namespace rholm
