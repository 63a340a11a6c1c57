// Finds the scans that points belong to, and the poses from align_scans(). Layer: shape.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/points.h"
#include "rholm/vec3.h"
#include "shape/rigid_motion.h"

namespace rholm {

// Adds values of the attribute `scan` to the ascending list `different`. Returns false if they are
// no scan numbers: not whole numbers, or more than kMaxScans different ones.
inline bool add_scans(std::span<const double> values, std::vector<double>& different) {
  for (const double value : values) {
    if (!(std::isfinite(value) && value == std::round(value))) return false;
    const auto at = std::lower_bound(different.begin(), different.end(), value);
    if (at != different.end() && *at == value) continue;
    if (different.size() == kMaxScans) return false;
    different.insert(at, value);
  }
  return true;
}

// Pose of a scan after a motion of many steps.
struct ScanPose {
  Vec3 origin, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // images of the middle and of the axes

  void move(const RigidMotion& motion) {
    origin = motion.point(origin);
    x = motion.direction(x), y = motion.direction(y), z = motion.direction(z);
  }
  Vec3 direction(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

struct ScanPoses {
  ScanAlignment alignment;           // without `moved`
  Vec3 middle;                       // middle of all points before the motion
  std::vector<double> labels = {};   // values of the attribute `scan`, ascending
  std::vector<ScanPose> poses = {};  // of each scan; empty if nothing moves

  // Moves points with an attribute `scan`, their normals and sensors. Points of unknown scans stay.
  // Returns the sum of squared displacements.
  double move(PointCloud& cloud) const;
};
// Computes the poses with which align_scans() moves all points.
ScanPoses find_scan_poses(const PointCloud& cloud, const Context& context);

}  // namespace rholm
