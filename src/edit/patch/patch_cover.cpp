#include "edit/patch/patch_cover.h"

#include <algorithm>
#include <cmath>

#include "chart/cap/cap_frame.h"
#include "edit/patch/patch_kernels.h"

namespace rholm {
namespace {

// The centre is the centre of the sphere that fits the normals, at most 3.7 supports below the
// seed. Seen from that distance, the support has a half angle of 15 degrees (method 7.2), and rays
// are nearly parallel. The centre is at least 0.6 supports below: slightly more than a hemisphere.
constexpr double kFarthest = 3.7, kNearest = 0.6;
// Angle of the support's rim on the opened sphere. Even harmonics live on a hemisphere
// (method 7.8), and need some room beyond the last points. They need more room than in
// large caps, which have even harmonics only (cap_candidate.cpp: 88 degrees). This basis
// has odd ones up to degree 3 (patch_kernels.h), which continue beyond the equator.
constexpr double kOpened = 1.4835;  // 85 degrees
// Blend weights fall to 0 at this part of the support, because fits are worst at the rim.
constexpr double kBlendReach = 0.75;
// Points within this part of the support need no other cap. Chosen: each
// point has four caps. 0.5 takes twice the time, and 0.6 averages less.
constexpr double kCovered = 0.55;
// A point belongs to the cap's side of a fold if its normal is within 101 degrees
// of the axis. This includes the walls of a scratch, but not the back of a fin.
constexpr double kSameSide = -0.2;
// Largest distance from the cap's sphere, in supports. It excludes ears and limbs that
// lean over a patch. Cylinders are a quarter off if the support equals their radius.
constexpr double kOffSphere = 0.35;
constexpr double kGoodShare = 0.85;  // see method 7.4
constexpr double kShrink = 0.75;
constexpr double kSmallest = 0.3;      // share of the first radius: degree 2
constexpr double kFewestPoints = 1.5;  // points per coefficient

class Gatherer {
 public:
  explicit Gatherer(const LocalMesh& local)
      : local_(local), begin_(1, 0), seen_(local.points.size(), 0) {
    next_to_.reserve(3 * local.faces.size());
    for (std::uint32_t i = 0; i < local.points.size(); ++i) {
      seen_[i] = ++mark_;
      for (const std::uint32_t t : local.triangles_at(i)) {
        for (const std::uint32_t v : local.faces[t]) {
          if (seen_[v] == mark_) continue;
          seen_[v] = mark_;
          next_to_.push_back(v);
        }
      }
      begin_.push_back(static_cast<std::uint32_t>(next_to_.size()));
    }
  }

  // Returns points connected to the seed within the radius, nearest first along edges.
  const std::vector<std::uint32_t>& gather(std::uint32_t seed, double radius) {
    ++mark_;
    found_.assign(1, seed);
    seen_[seed] = mark_;
    const Vec3 at = local_.points[seed];
    for (std::size_t next = 0; next < found_.size(); ++next) {
      for (std::uint32_t k = begin_[found_[next]]; k < begin_[found_[next] + 1]; ++k) {
        const std::uint32_t v = next_to_[k];
        if (seen_[v] == mark_) continue;
        seen_[v] = mark_;
        const Vec3 offset = local_.points[v] - at;
        if (dot(offset, offset) < radius * radius) found_.push_back(v);
      }
    }
    return found_;
  }

 private:
  const LocalMesh& local_;
  std::vector<std::uint32_t> next_to_, begin_;  // neighbours of point i: begin_[i] ... [i + 1]
  std::vector<std::uint32_t> seen_, found_;
  std::uint32_t mark_ = 0;
};

// Returns the mean normal; points near the seed have larger weights.
Vec3 axis_of(const LocalMesh& local, std::uint32_t seed, double radius,
             std::span<const std::uint32_t> found) {
  Vec3 sum;
  for (const std::uint32_t v : found) {
    const Vec3 offset = local.points[v] - local.points[seed];
    const double d2 = dot(offset, offset) / (radius * radius);
    sum += local.areas[v] * (1 - d2) * local.normals[v];
  }
  // A whole sphere has no mean normal; the seed's normal is used instead.
  return norm(sum) > 0 ? normalized(sum) : local.normals[seed];
}

// Makes a cap of this radius; returns the share of the area that is on the cap's side.
double make_cap(const LocalMesh& local, std::uint32_t seed, double radius,
                std::span<const std::uint32_t> found, PatchCap& cap) {
  const Vec3 axis = axis_of(local, seed, radius, found);
  cap.frame = patch_frame({local.points, local.normals, local.areas, found}, local.points[seed],
                          axis, radius);
  cap.points.clear();
  cap.blend_weights.clear();
  cap.points.reserve(found.size());
  cap.blend_weights.reserve(found.size());
  double area = 0, good = 0;
  for (const std::uint32_t v : found) {
    area += local.areas[v];
    const double facing = dot(local.normals[v], axis) - kSameSide;
    const Vec3 offset = local.points[v] - local.points[seed];
    if (!(facing > 0) || dot(offset, axis) < -0.9 * cap.frame.radius) continue;
    const double off = norm(local.points[v] - cap.frame.center) - cap.frame.radius;
    if (std::abs(off) > kOffSphere * radius) continue;
    good += local.areas[v];
    cap.points.push_back(v);
    const double d2 = dot(offset, offset) / (kBlendReach * kBlendReach * radius * radius);
    const double fall = std::max(0.0, 1 - d2);
    cap.blend_weights.push_back(fall * fall * fall * facing * facing);
  }
  return area > 0 ? good / area : 0;
}

}  // namespace

namespace {

// Returns the mean curvature k of the sphere that fits the normals,
// by least squares: n = axis + k o for offsets o across the axis.
double curvature_of(const PatchPoints& patch, const Vec3& seed, const Vec3& axis) {
  double above = 0, below = 0;
  for (const std::uint32_t v : patch.which) {
    const Vec3 offset = patch.points[v] - seed;
    const Vec3 across = offset - dot(offset, axis) * axis;
    above += patch.areas[v] * dot(patch.normals[v], across);
    below += patch.areas[v] * dot(across, across);
  }
  return below > 0 ? above / below : 0;
}

}  // namespace

CapFrame patch_frame(const PatchPoints& patch, const Vec3& seed, const Vec3& axis, double radius) {
  const double bend = radius * curvature_of(patch, seed, axis);
  const double depth = std::clamp(bend > 0 ? 1 / bend : kFarthest, kNearest, kFarthest);
  // Angle of the support, a chord, seen from this centre.
  const double half_angle = 2 * std::asin(std::min(1.0, 0.5 / depth));
  CapFrame frame = cap_frame(seed, axis, radius, half_angle, kOpened);
  frame.radius = depth * radius;
  frame.center = seed - frame.radius * frame.z;
  return frame;
}

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
      const Vec3 offset = local.points[v] - local.points[seed];
      if (dot(offset, offset) < kCovered * kCovered * radius * radius) covered[v] = 1;
    }
    caps.push_back(std::move(cap));
  }
  return caps;
}

}  // namespace rholm
