// Coefficients of a patch by integrals over its triangles, the paper's way; kept for
// comparison with least squares (cap_fit.h). Layer: atlas.
//
// On the patch, the function is r(u), its distance from the centre of the sphere; elsewhere
// it is zero or the sphere's radius. It jumps at the border of the patch. Its series
// therefore converges slowly, and at the border to the mean of both sides, r/2 (method
// 7.1).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "paper/patches/sphere_fit.h"
#include "rholm/atlas.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Returns the frame of a patch on its own sphere: z is the axis, and the support reaches from the
// seed to the farthest point. The dilation is 1 or, with an angle `opened` in radians below pi,
// takes the direction farthest from the axis to this angle.
CapFrame patch_frame(const PatchSphere& seen, std::span<const Vec3> points, double opened = 0);

// Triangles in space, counter-clockwise as seen from outside; the centre is on their inner side.
struct PatchMesh {
  std::span<const Vec3> points;
  std::span<const Triangle> faces;
};

struct CapIntegralOptions {
  int degree = 64;  // 0 ... kMaxIntegralDegree
  CapExtension extension = CapExtension::kZero;
  double precision = 1e-10;  // l2 error of all coefficients over the integral of r
};
inline constexpr int kMaxIntegralDegree = 512;  // above, caps have more numbers than shapes

struct CapIntegral {
  Coefficients coefficients;  // expansion of r in the points' unit, on the dilated sphere
  double solid_angle = 0;     // solid angle of the patch from the centre, undilated
  std::size_t nodes = 0;
};

// Throws InvalidInput for options out of range, a triangle with an index out of range, and a frame
// whose centre is on a triangle. Throws NotStarShaped for a triangle that turns its outer side to
// the centre. Triangles seen edge on have no solid angle and are skipped.
CapIntegral cap_integral(const CapFrame& frame, const PatchMesh& patch,
                         const CapIntegralOptions& options = {}, const Context& context = {});

// Distances of points from r_L(u), along rays from the centre.
struct CapErrors {
  std::vector<double> along_rays;  // |p - c| - r_L(u), per point
  double sum = 0;                  // root of the sum of squares, (P42)
  double rms = 0;
  double max = 0;
};
CapErrors cap_errors(const CapFrame& frame, const Coefficients& coefficients,
                     std::span<const Vec3> points, const Context& context = {});

}  // namespace rholm
