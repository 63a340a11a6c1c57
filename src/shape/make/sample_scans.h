// What scanners around a surface see of it. Layer: shape.
#pragma once

#include <optional>
#include <vector>

#include "rholm/context.h"
#include "rholm/points.h"
#include "shape/make/surface_places.h"
#include "shape/queries/ray_scene.h"
#include "shape/rigid_motion.h"

namespace rholm {

struct Scanner {
  Vec3 at;             // in the frame of the surface
  RigidMotion motion;  // about the middle of the surface: what the scan is off by
  double noise = 0;    // of its points, part of the diagonal
};

// Keeps references to the surface and the options.
class Scans {
 public:
  Scans(const SampledSurface& surface, const SampleOptions& options);

  const std::vector<Scanner>& scanners() const { return scanners_; }
  // Random, as dense as the scanner's rays, of what it sees; nothing if it does not find any.
  std::optional<SurfacePlace> draw(std::size_t scan, RandomStream& random) const;
  // Of rays in lines, about options.points / options.scans.
  std::vector<SurfacePlace> lines(std::size_t scan, const Context& context) const;

 private:
  bool sees(const Scanner& scanner, const SurfacePlace& place) const;

  const SampledSurface& surface_;
  const SampleOptions& options_;
  double radius_ = 0;  // of a ball about the middle that holds the surface
  Mesh local_;
  std::optional<RayScene> scene_;
  std::vector<Scanner> scanners_;
};

}  // namespace rholm
