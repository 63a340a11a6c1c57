// Maximises t subject to n_T . c + t <= n_T . v_T by cutting planes: a linear program over few
// triangles gives a candidate, one pass over all of them finds the worst of every chunk, these join
// the few. The program's t is an upper bound, the smallest d_T at its candidate a lower one: the
// loop ends when they meet.
//
// The optimum need not be one point: between two parallel faces it is a whole plane. Then the
// faces that hold it are fixed, the smallest d_T of the others is maximised within, and so on until
// a point is left (the nucleolus, Schmeidler 1969): the centre of a box is its middle.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "chart/kernel.h"
#include "chart/linear_program.h"

namespace rholm {
namespace {

// In the unit frame the bounding box is [-1, 1]^3 at most; a little more, so that a kernel that
// touches the box is not cut.
constexpr double kReach = 1.0625;
// d_T of the unit frame cannot exceed the distance across.
constexpr double kMostDistance = 4;
// Bounds closer than this have met: d_T is known to about 1e-15, and 1e-12 of the size is far below
// what any later step can tell.
constexpr double kGap = 1e-12;
// Usually 3 to 8 passes; the limit only guards against rounding.
constexpr int kMaxScans = 200;
// A face holds the optimum if its weight in the program is above this, and is parallel to a flat if
// its normal's part in there is below: normals are known to 1e-15, and moving along such a flat
// changes no d_T by more than 1e-9 of the size.
constexpr double kParallel = 1e-9;

// The points origin + z.x axes[0] + z.y axes[1] + z.z axes[2]; axes are orthonormal or zero.
struct Flat {
  Vec3 origin;
  std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  Vec3 direction(const Vec3& z) const { return z.x * axes[0] + z.y * axes[1] + z.z * axes[2]; }
  Vec3 project(const Vec3& v) const { return {dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])}; }
  bool is_point() const { return axes[0] == Vec3{}; }
};

struct Nearest {
  double d = std::numeric_limits<double>::infinity();
  std::size_t triangle = 0;
};

// The smallest d_T of every chunk, among the planes that are not parallel to the flat.
std::vector<Nearest> nearest_planes(const std::vector<FacePlane>& planes, const Flat& flat,
                                    const Vec3& center, const Context& context) {
  const std::size_t n = planes.size(), grain = triangle_grain(n);
  std::vector<Nearest> chunks((n + grain - 1) / grain);
  parallel_for(n, grain, context, {}, [&](std::size_t begin, std::size_t end) {
    Nearest best;
    for (std::size_t t = begin; t < end; ++t) {
      const double d = planes[t].offset - dot(planes[t].normal, center);
      if (d < best.d && norm(flat.project(planes[t].normal)) > kParallel) best = {d, t};
    }
    chunks[begin / grain] = best;
  });
  return chunks;
}

// Normals of the planes that hold the program's optimum.
std::vector<Vec3> holding_normals(const LinearProgram& program, const Flat& flat) {
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < 4; ++i) {
    if (program.weights()[i] <= kParallel) continue;
    normals.push_back(flat.direction(program.rows()[program.basis()[i]].a));
  }
  return normals;
}

// The best point of the flat and the normals of the faces that hold it.
struct Stage {
  KernelCenter best;
  std::vector<Vec3> normals;
};

Stage best_in_flat(const FacePlanes& faces, const Flat& flat, const Context& context) {
  LinearProgram program(kReach, kMostDistance);
  Stage stage;
  KernelCenter& best = stage.best;
  best = {.point = flat.origin, .value = -std::numeric_limits<double>::infinity(), .scans = 0};
  Vec3 candidate = flat.origin;
  double top = kMostDistance;
  while (best.scans < kMaxScans) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Nearest& nearest : nearest_planes(faces.planes, flat, candidate, context)) {
      lowest = std::min(lowest, nearest.d);
      if (!(nearest.d < top - kGap)) continue;
      const FacePlane& plane = faces.planes[nearest.triangle];
      program.add({.a = flat.project(plane.normal),
                   .lift = 1,
                   .bound = plane.offset - dot(plane.normal, flat.origin)});
    }
    ++best.scans;
    if (lowest > best.value) {
      best.value = lowest;
      best.point = candidate;
    }
    if (top - best.value <= kGap || !program.solve()) break;
    candidate = flat.origin + flat.direction(program.center());
    top = program.top();
  }
  // The weights belong to every optimum, also to one found before the program knew it.
  stage.normals = holding_normals(program, flat);
  return stage;
}

// The part of the flat that is parallel to all faces with these normals, through another origin.
Flat parallel_part(const Flat& flat, const Vec3& origin, const std::vector<Vec3>& normals) {
  std::vector<Vec3> taken;  // orthonormal
  const auto remainder = [&](Vec3 v) {
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Parlett, after Kahan)
      for (const Vec3& t : taken) v -= dot(v, t) * t;
    }
    return v;
  };
  for (const Vec3& normal : normals) {
    const Vec3 rest = remainder(normal);
    if (norm(rest) > kParallel) taken.push_back(normalized(rest));
  }
  Flat part{.origin = origin, .axes = {}};
  for (Vec3& axis : part.axes) {
    // The squares of the remainders add up to the number of dimensions left: while there is one,
    // the longest of three is at least sqrt(1/3).
    Vec3 longest;
    for (const Vec3& candidate : flat.axes) {
      const Vec3 rest = remainder(candidate);
      if (norm(rest) > norm(longest)) longest = rest;
    }
    if (norm(longest) < 0.5) break;
    axis = normalized(longest);
    taken.push_back(axis);
  }
  return part;
}

}  // namespace

KernelCenter chebyshev_center(const FacePlanes& faces, const Context& context) {
  Flat flat;
  Stage stage = best_in_flat(faces, flat, context);
  KernelCenter best = stage.best;
  // Each round takes at least one of three dimensions.
  for (int round = 0; round < 3 && best.value > 0 && !stage.normals.empty(); ++round) {
    flat = parallel_part(flat, stage.best.point, stage.normals);
    if (flat.is_point()) break;
    stage = best_in_flat(faces, flat, context);
    best.point = stage.best.point;
    best.scans += stage.best.scans;
  }
  return best;
}

}  // namespace rholm
