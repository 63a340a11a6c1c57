// Covers a region of a mesh with caps. Layer: edit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edit/region/local_mesh.h"
#include "rholm/cap_frame.h"

namespace rholm {

// Cap with its points, and its weight in the blend at each point.
struct PatchCap {
  CapFrame frame;
  int degree = 0;
  double size = 1;                    // radius relative to a cap that did not shrink
  std::vector<std::uint32_t> points;  // points within the support, facing outwards along the axis
  std::vector<double> blend_weights;  // blend weight of each point
};

// Selected points of a surface, with normals and areas.
struct PatchPoints {
  std::span<const Vec3> points, normals;
  std::span<const double> areas;
  std::span<const std::uint32_t> which;
};
// Returns the frame of a cap over the points. Its centre is the centre of
// the sphere that fits the normals, within limits. `seed` lies on the axis.
CapFrame patch_frame(const PatchPoints& patch, const Vec3& seed, const Vec3& axis, double radius);

// Size and degree of a cap for a wavelength: its radius in wavelengths,
// and the degree whose waves have this length half way to the rim.
inline constexpr double kPatchRadius = 2;
inline constexpr int kPatchDegree = 8;

// Covers every point with weight > 0, so that it lies well inside some cap, unless no cap
// reaches it. Where the surface folds within a cap, smaller caps of lower degree replace it.
std::vector<PatchCap> cover_patch(const LocalMesh& local, std::span<const double> weights,
                                  double wavelength);

}  // namespace rholm
