// Caps over a region of a mesh. Layer: edit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edit/region/local_mesh.h"
#include "rholm/cap_frame.h"

namespace rholm {

// Points that a cap sees, and its weight in the blend at each.
struct PatchCap {
  CapFrame frame;
  int degree = 0;
  double size = 1;                    // of its radius, against one that did not have to shrink
  std::vector<std::uint32_t> points;  // within the support, facing outwards along the axis
  std::vector<double> blend_weights;  // of each point
};

// Points of a surface: some of them, with normals and areas.
struct PatchPoints {
  std::span<const Vec3> points, normals;
  std::span<const double> areas;
  std::span<const std::uint32_t> which;
};
// The frame of a cap over them: its centre is that of the sphere that the normals belong to, within
// limits. `seed` lies on the axis.
CapFrame patch_frame(const PatchPoints& patch, const Vec3& seed, const Vec3& axis, double radius);

// A cap's size and degree for a wavelength: its radius in wavelengths, and the degree whose waves
// are that long half way to its rim.
inline constexpr double kPatchRadius = 2;
inline constexpr int kPatchDegree = 8;

// Every point with weight > 0 lies well inside some cap, unless none sees it. Where the surface
// folds within a cap, smaller ones of lower degree take its place.
std::vector<PatchCap> cover_patch(const LocalMesh& local, std::span<const double> weights,
                                  double wavelength);

}  // namespace rholm
