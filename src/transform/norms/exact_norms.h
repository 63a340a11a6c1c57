// Exact integrals by one pass over the faces: int r^2 dOmega, the solid angle, the volume.
//
// Source: method 5, (M7). For each face, <> is the mean over its flat area. d2 is twice the area
// times d_T, which is six times the volume of the face's cone. Then
//   int_T r^2 dOmega = d_T Phi_T = d2/2 <1/|x|>,        Omega_T = d2/2 <1/|x|^3>.
// The logarithms of (M7) cancel on small faces, where cubature of the means has nothing to cancel.
// Vectors of faces that look small from the centre take a rule of degree 5 or 8 on series of the
// two powers. Other faces take closed forms or cubature of pieces. The relative error of a face's
// means is below 1e-14 (bounds: exact_norms_rules.h). exact_norms_test finds 2e-16 for whole
// surfaces, also with needles and rods. Needles longer than their distance may lose more: 1e-16
// times distance / height.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "parts/executor.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"

namespace rholm {

struct ExactNorms {
  double radius_squared = 0;  // int r^2 dOmega of a star-shaped surface
  double solid_angle = 0;     // 4 pi times the winding number of a closed surface at the centre
  double volume = 0;          // enclosed volume
};
// Sizes of the faces, and their largest angles seen from the centre, computed on request.
struct FaceSizes {
  static constexpr std::size_t kRun = 128;  // number of consecutive faces t in a run
  static constexpr std::size_t kGroup = 2;  // number of faces in a group; runs have whole groups

  double scale = 1;  // a power of two that brings the largest coordinate to 1 ... 2
  // For each group: twice the area of its faces together, for lengths times `scale`, to a
  // millionth. Areas may be far below the least float; so this is the upper half of a double.
  std::vector<std::uint32_t> area_bits;
  double twice_area(std::size_t group) const {
    return std::bit_cast<double>(std::uint64_t{area_bits[group]} << 32);
  }
  // For each run: the square of (longest edge / smallest distance of a corner from the centre). It
  // bounds the square of each edge over the distances of its own ends.
  std::vector<double> angles2;
  // For each run: 1 if a face has no area but by rounding, for example if it names a corner twice.
  std::vector<std::uint8_t> flat;
};

// Results have the signs of d_T, and the same bits for any number of threads. Throws InvalidInput
// for an index out of range, a coordinate that is not finite, and a size from the centre outside
// 1e-150 ... 1e150. The executor, by default threads of this process, sums ranges. Other processes,
// which have the mesh, sum ranges by norms_work().
ExactNorms exact_norms(const MeshView& mesh, const Vec3& center, const Context& context = {},
                       FaceSizes* sizes = nullptr, Executor* executor = nullptr);
// kNormsJob names this task. norms_work() returns the function of another process for the parts'
// input; the mesh must outlive it. Throws Io for bytes that are no input.
inline constexpr const char* kNormsJob = "norms";
Executor::Work norms_work(const MeshView& mesh, std::string_view input);

// Returns true if a closed surface with d_T > 0 on all faces meets every direction once.
bool covers_once(const ExactNorms& norms);

// Sums over faces in the lengths given, without the constant factors of the faces' cones.
struct NormSums {
  double first = 0;    // sum of d2 <1/|x|>
  double third = 0;    // sum of d2 <1/|x|^3>
  double volume6 = 0;  // sum of d2
};
// Returns the sums of one face of any size, by (M7) or, where (M7) cancels, by cubature of pieces.
// Corners are relative to the centre and below about 1e70. A face without area has sums of 0.
NormSums norms_of_triangle(const std::array<Vec3, 3>& corners);

}  // namespace rholm
