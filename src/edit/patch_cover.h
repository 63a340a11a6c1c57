// Caps over a region of a mesh. Layer: edit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "edit/local_mesh.h"
#include "rholm/atlas.h"

namespace rholm {

// Points that a cap sees, and how much it has to say about each.
struct PatchCap {
  CapFrame frame;
  int degree = 0;
  double size = 1;                    // of its radius, against one that did not have to shrink
  std::vector<std::uint32_t> points;  // within the support, facing outwards along the axis
  std::vector<double> voices;         // of each point: weight of the cap in the blend
};

// A cap's size and degree for a wavelength: its radius in wavelengths, and the degree whose waves
// are that long half way to its rim.
inline constexpr double kPatchRadius = 2;
inline constexpr int kPatchDegree = 8;

// Every point with weight > 0 lies well inside some cap, unless none sees it. Where the surface
// folds within a cap, smaller ones of lower degree take its place.
std::vector<PatchCap> cover_patch(const LocalMesh& local, std::span<const double> weights,
                                  double wavelength);

}  // namespace rholm
