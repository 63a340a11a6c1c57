// Maximises s(c) = min over corners of n . (v - c) / |v - c|.
//
// With s fixed, n . (v - c) - s |v - c| is concave in c, and |v - c| >= u . (v - c) for every unit
// vector u. Take the direction of v from an earlier candidate as u. Then (n - s u) . (v - c) >= t
// is a row of a linear program, whose largest t is an upper bound of the gain over s of any c. This
// is the method of Dinkelbach (1967) with Kelley's cutting planes inside. The cuts hold for every
// s, so that both loops become one. Rows are divided by |v - c| of the candidate, so that t is a
// gain in cos gamma.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "chart/center/kernel.h"
#include "chart/center/linear_program.h"
#include "chart/center/view_scan.h"

namespace rholm {
namespace {

constexpr double kReach = 1.0625;       // see chebyshev_center.cpp
constexpr double kRelativeGain = 1e-6;  // promised by kernel.h
constexpr int kMaxScans = 200;          // usually 6 to 20

struct Corner {
  double cos_gamma = std::numeric_limits<double>::infinity();
  Vec3 normal;
  Vec3 position;     // in the unit frame
  double slack = 0;  // slack() of the face, see FacePlane
};

// A cut: the corner as an earlier candidate saw it, along `direction` from `distance`.
struct Cut {
  Vec3 normal;
  Vec3 position;
  Vec3 direction;
  double distance;
  double slack;  // amount by which rounding may raise the cosine
};

// Replaces `best` by the steepest corner of a triangle if that corner is steeper.
void take_steepest(const LocalView& view, std::size_t triangle, const Vec3& center, Corner& best) {
  const FacePlane face = view.plane(triangle);
  if (!face.exists()) return;
  for (const Vec3& corner : view.corners(triangle)) {
    const Vec3 position = corner - view.frame.center;
    const double distance = norm(position - center);
    if (!(distance > 0)) continue;
    const double cos_gamma = face.distance(center) / distance + face.slack();
    if (cos_gamma < best.cos_gamma) best = {cos_gamma, face.normal, position, face.slack()};
  }
}

// Returns the steepest corner of every chunk.
std::vector<Corner> steepest_corners(const LocalView& view, const Vec3& center,
                                     const Context& context) {
  // Chosen: some hundred cuts in each pass.
  const std::size_t n = view.mesh.n_faces, grain = std::max<std::size_t>(256, n / 256);
  std::vector<Corner> chunks((n + grain - 1) / grain);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    Corner& best = chunks[begin / grain];
    ScanLimits limits{.cosine = best.cos_gamma};
    scan_below(view, begin, end, center, limits, [&](std::size_t triangle) {
      take_steepest(view, triangle, center, best);
      limits.cosine = best.cos_gamma;
    });
  });
  return chunks;
}

LinearProgram program_for(const std::vector<Cut>& cuts, double s) {
  LinearProgram program(kReach, 1 - s);  // no cosine exceeds 1
  for (const Cut& cut : cuts) {
    const Vec3 a = (cut.normal - s * cut.direction) / cut.distance;
    program.add({.a = a, .lift = 1, .bound = dot(a, cut.position) + cut.slack});
  }
  return program;
}

}  // namespace

KernelCenter cosine_center(const LocalView& view, const Vec3& start, const Context& context) {
  KernelCenter best{.point = start, .value = -std::numeric_limits<double>::infinity(), .scans = 0};
  std::vector<Cut> cuts;
  Vec3 candidate = start;
  double bound = 1;
  for (int scan = 0; scan < kMaxScans; ++scan) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Corner& corner : steepest_corners(view, candidate, context)) {
      lowest = std::min(lowest, corner.cos_gamma);
      if (!(corner.cos_gamma < bound)) continue;
      const Vec3 ray = corner.position - candidate;
      cuts.push_back({corner.normal, corner.position, normalized(ray), norm(ray), corner.slack});
    }
    best.scans += 1;
    if (lowest > best.value) {
      best.value = lowest;
      best.point = candidate;
    }
    if (!(best.value > 0)) break;
    LinearProgram program = program_for(cuts, best.value);
    if (!program.solve() || program.top() <= kRelativeGain * best.value) break;
    candidate = program.center();
    bound = best.value + program.top();
  }
  return best;
}

}  // namespace rholm
