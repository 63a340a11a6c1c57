// What one pass over the triangles knows exactly: int r^2 dOmega, the solid angle, the volume.
//
// Source: method 5, (M7). Per triangle, <> the mean over its flat area, d2 = twice the area times
// d_T = six times the volume of its cone,
//   int_T r^2 dOmega = d_T Phi_T = d2/2 <1/|x|>,        Omega_T = d2/2 <1/|x|^3>.
// (M7)'s logarithms cancel on small triangles, where cubature of the means has nothing to cancel:
// vectors of triangles that are small as seen from the centre take a rule of degree 5 or 8 on
// series of the two powers, the few others their closed forms or cubature of pieces. Relative error
// of a triangle's two means: below 1e-14 (bounds: exact_norms_rules.h); found (exact_norms_test)
// for whole surfaces, needles and rods among them: 2e-16. Needles longer than their distance may
// lose more, 1e-16 of that distance against their height.
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
  double solid_angle = 0;     // 4 pi times how often a closed surface surrounds the centre
  double volume = 0;          // enclosed
};
// How large the faces are and look, on request.
struct FaceSizes {
  static constexpr std::size_t kRun = 128;  // faces t are taken in runs of this many
  static constexpr std::size_t kGroup = 2;  // and in groups within them

  double scale = 1;  // a power of two that brings the largest coordinate to 1 ... 2
  // Of each group: twice the area of its faces together, of lengths times `scale`, to a millionth:
  // the upper half of a double, for areas may be far below the least float.
  std::vector<std::uint32_t> area_bits;
  double twice_area(std::size_t group) const {
    return std::bit_cast<double>(std::uint64_t{area_bits[group]} << 32);
  }
  // Of each run: the square of the longest edge over that of the nearest corner's distance from
  // the centre, at least the largest of that of each edge and its own ends.
  std::vector<double> angles2;
  // Of each run: 1 if a face has no area but by rounding, as where it names a corner twice.
  std::vector<std::uint8_t> flat;
};

// Signs are those of d_T. Same bits for any number of threads. Throws InvalidInput for an index out
// of range, a coordinate that is not finite, and a size from the centre outside 1e-150 ... 1e150.
// The executor, by default threads of this process, sums ranges; other processes, which have the
// mesh, do so by norms_work().
ExactNorms exact_norms(const MeshView& mesh, const Vec3& center, const Context& context = {},
                       FaceSizes* sizes = nullptr, Executor* executor = nullptr);
// The name of that work, and what another process does of it for the input of such parts. The mesh
// outlives it. Throws Io for bytes that are no input.
inline constexpr const char* kNormsJob = "norms";
Executor::Work norms_work(const MeshView& mesh, std::string_view input);

// Whether a closed surface whose triangles all have d_T > 0 meets every direction once.
bool covers_once(const ExactNorms& norms);

// Sums over triangles, lengths as they come, without the factors of the triangle's cone.
struct NormSums {
  double first = 0;    // of d2 <1/|x|>
  double third = 0;    // of d2 <1/|x|^3>
  double volume6 = 0;  // of d2
};
// One triangle of any size, by (M7) or, where that cancels, by cubature of pieces; corners relative
// to the centre and below about 1e70. Nothing for a triangle without area.
NormSums norms_of_triangle(const std::array<Vec3, 3>& corners);

}  // namespace rholm
