// Maximises t subject to n_T . c + t <= n_T . v_T over a pool of faces that grows: first a sample
// spread over all of them, then those that turn out to matter.
//
// A pass over all faces at the pool's optimum keeps, for each chunk of them, the faces with the
// smallest d_T, and what d_T all others have at least. Moving the centre by delta changes no d_T by
// more than |delta|: when the optimum of the grown pool is that near, the bounds prove it the
// optimum of all faces, without another pass. Only chunks whose bound does not reach are passed
// again.
//
// The optimum need not be one point: between two parallel faces it is a whole plane. Then the
// faces that hold it are fixed, the smallest d_T of the others is maximised within, and so on until
// a point is left (the nucleolus, Schmeidler 1969): the centre of a box is its middle.
//
// A plane that the rounding of its corners may turn counts as far out as it may lie; one of a face
// thinner than the rounding does not count.
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

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// In the unit frame the bounding box is [-1, 1]^3 at most; a little more, so that a kernel that
// touches the box is not cut.
constexpr double kReach = 1.0625;
// d_T of the unit frame cannot exceed the distance across.
constexpr double kMostDistance = 4;
// Bounds closer than this have met: d_T is known to about 1e-15, and 1e-12 of the size is far below
// what any later step can tell.
constexpr double kGap = 1e-12;
// Usually 1 to 3 passes; the limit only guards against rounding.
constexpr int kMaxScans = 200;
// A face holds the optimum if its weight in the program is above this, and is parallel to a flat if
// its normal's part in there is below: normals of exact corners are known to 1e-15, and moving
// along such a flat changes no d_T by more than 1e-9 of the size. Where rounding may turn the
// planes by more, this takes its place: the sides of a cylinder in single precision are parallel to
// its axis.
constexpr double kParallel = 1e-9;

// Measured (scripts/constants) on smooth and rough shapes of 30 000 to 5 million faces, of which a
// pass costs 5 to 8 ns each. The first pool: one face in kSampled, but at least and at most so
// many; fewer give a first optimum that is farther off, more cost as much as a pass.
constexpr std::size_t kSampled = 64;
constexpr std::size_t kFewestSampled = 1000;
constexpr std::size_t kMostSampled = 4000;
// Faces a chunk adds in a pass, those less than kSlack above the optimum: more, and farther above,
// prove more about the next optimum, but are handled one by one.
constexpr std::size_t kKept = 8;
constexpr double kSlack = 0.03;

// The points origin + z.x axes[0] + z.y axes[1] + z.z axes[2]; axes are orthonormal or zero.
struct Flat {
  Vec3 origin;
  std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  double turn = kParallel;  // how far rounding may turn it

  Vec3 direction(const Vec3& z) const { return z.x * axes[0] + z.y * axes[1] + z.z * axes[2]; }
  Vec3 project(const Vec3& v) const { return {dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])}; }
  bool is_point() const { return axes[0] == Vec3{}; }
  bool is_parallel(const FacePlane& face) const {
    return norm(project(face.normal)) <= std::max(turn, face.turn);
  }
};

// Faces of a chunk that are not in the pool have d_T >= least, seen from `from`.
struct ChunkBound {
  Vec3 from;
  double least = -kInfinity;
  double at(const Vec3& point) const { return least - norm(point - from); }
};

struct Faces {
  std::vector<FacePlane> pool;
  std::vector<ChunkBound> chunks;  // of triangle_grain(n) triangles each
};

Faces sample(const LocalView& view) {
  const std::size_t n = view.mesh.n_triangles;
  const std::size_t wanted = std::clamp(n / kSampled, kFewestSampled, kMostSampled);
  const std::size_t step = std::max<std::size_t>(1, n / wanted);
  Faces faces;
  faces.chunks.resize((n + triangle_grain(n) - 1) / triangle_grain(n));
  if (step == 1) {
    for (ChunkBound& chunk : faces.chunks) chunk.least = kInfinity;
  }
  faces.pool.reserve(n / step + 1);
  for (std::size_t t = 0; t < n; t += step) {
    const FacePlane face = view.plane(t);
    if (face.exists()) faces.pool.push_back(face);
  }
  return faces;
}

// How far out a plane may lie, anywhere in the unit frame.
double rounding_of(const FacePlane& face) { return FacePlane::kFrameDiagonal * face.turn; }

// The optimum of the pool within a flat, as far as it is known.
struct PoolOptimum {
  LinearProgram program{kReach, kMostDistance};
  Vec3 point;
  double top = kMostDistance;  // an upper bound of the smallest d_T, in the pool and so in all
  // Planes that rounding has turned against each other, as those of a flat side in single
  // precision, meet anywhere, and may keep the program from its end. Then each counts as far out as
  // it may lie.
  bool roughly = false;
  bool ended = true;  // false: rounding has kept the program from its end even so

  double distance(const FacePlane& face) const {
    return face.most_distance(point) + (roughly ? rounding_of(face) : 0);
  }
};

// The pool's faces below `top`, one of every 64 (chosen: some hundred rows for the program).
// Returns the smallest d_T.
double add_worst(const std::vector<FacePlane>& pool, const Flat& flat, PoolOptimum& optimum) {
  constexpr std::size_t kGroup = 64;
  double smallest = kInfinity;
  for (std::size_t first = 0; first < pool.size(); first += kGroup) {
    const FacePlane* worst = nullptr;
    double least = optimum.top - kGap;
    for (std::size_t i = first; i < std::min(pool.size(), first + kGroup); ++i) {
      const double d = optimum.distance(pool[i]);
      if (d < least && !flat.is_parallel(pool[i])) {
        least = d;
        worst = &pool[i];
      }
    }
    if (worst == nullptr) continue;
    smallest = std::min(smallest, least);
    optimum.program.add({.a = flat.project(worst->normal),
                         .lift = 1,
                         .bound = worst->most_distance(flat.origin),
                         .rounding = rounding_of(*worst)});
  }
  return smallest;
}

// To the optimum of a pool that has grown.
void improve(const std::vector<FacePlane>& pool, const Flat& flat, PoolOptimum& optimum) {
  Vec3 best = optimum.point;
  double most = -kInfinity;
  for (int round = 0; round < kMaxScans; ++round) {
    const double smallest = std::min(add_worst(pool, flat, optimum), optimum.top);
    if (smallest > most) {
      most = smallest;
      best = optimum.point;
    }
    if (optimum.top - most <= kGap) break;
    if (!optimum.roughly && !optimum.program.solve()) {
      optimum.roughly = true;
      most = -kInfinity;
    }
    if (optimum.roughly) optimum.ended = optimum.program.solve(true);
    if (!optimum.ended) break;
    optimum.point = flat.origin + flat.direction(optimum.program.center());
    optimum.top = optimum.program.top();
  }
  optimum.point = best;
}

// The faces of a chunk with the smallest d_T below top + kSlack, and the bound for the others.
std::vector<FacePlane> nearest_faces(const LocalView& view, std::size_t begin, std::size_t end,
                                     const Flat& flat, const PoolOptimum& optimum,
                                     ChunkBound& bound) {
  struct Near {
    double d;
    FacePlane face;
  };
  std::vector<Near> near;  // sorted
  ScanLimits limits{.distance = optimum.top + kSlack};
  scan_below(view, begin, end, optimum.point, limits, [&](std::size_t triangle) {
    const FacePlane face = view.plane(triangle);
    const double d = optimum.distance(face);
    if (!face.exists() || !(d < limits.distance) || flat.is_parallel(face)) return;
    const auto place = std::upper_bound(near.begin(), near.end(), d,
                                        [](double value, const Near& n) { return value < n.d; });
    near.insert(place, {d, face});
    if (near.size() > kKept) near.pop_back();
    if (near.size() == kKept) limits.distance = near.back().d;
  });
  bound = {.from = optimum.point, .least = limits.distance};
  std::vector<FacePlane> faces;
  faces.reserve(near.size());
  for (const Near& n : near) faces.push_back(n.face);
  return faces;
}

// One pass over the chunks that may have faces below the pool's optimum: their nearest faces join
// the pool. Returns the part of all chunks that it passed: 0 if the optimum is that of all faces.
double grow_pool(const LocalView& view, const Flat& flat, const PoolOptimum& optimum, Faces& faces,
                 const Context& context) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < faces.chunks.size(); ++i) {
    if (faces.chunks[i].at(optimum.point) < optimum.top - kGap) open.push_back(i);
  }
  const std::size_t n = view.mesh.n_triangles, grain = triangle_grain(n);
  std::vector<std::vector<FacePlane>> found(open.size());
  parallel_for(open.size(), 1, context, {}, [&](std::size_t i, std::size_t) {
    const std::size_t begin = open[i] * grain, end = std::min(n, begin + grain);
    found[i] = nearest_faces(view, begin, end, flat, optimum, faces.chunks[open[i]]);
  });
  for (const std::vector<FacePlane>& part : found) {
    faces.pool.insert(faces.pool.end(), part.begin(), part.end());
  }
  return static_cast<double>(open.size()) / static_cast<double>(faces.chunks.size());
}

// Normals of planes, and how far rounding may turn them.
struct Normals {
  std::vector<Vec3> normals = {};
  double turn = kParallel;
};

// Of the planes that hold the program's optimum. Where each is turned, weights of others are as
// large as the turns.
Normals holding_normals(const PoolOptimum& optimum, const Flat& flat) {
  Normals holding;
  const LinearProgram& program = optimum.program;
  for (const std::size_t row : program.basis()) {
    const double turn = program.rows()[row].rounding / FacePlane::kFrameDiagonal;
    holding.turn = std::max(holding.turn, turn);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if (program.weights()[i] <= holding.turn) continue;
    holding.normals.push_back(flat.direction(program.rows()[program.basis()[i]].a));
  }
  return holding;
}

// The best point of the flat and the normals of the faces that hold it.
struct Stage {
  KernelCenter best;
  Normals holding;
};

Stage best_in_flat(const LocalView& view, const Flat& flat, Faces& faces, const Context& context) {
  PoolOptimum optimum;
  optimum.point = flat.origin;
  double scans = 0;
  for (int round = 0; round < kMaxScans; ++round) {
    improve(faces.pool, flat, optimum);
    const double part = grow_pool(view, flat, optimum, faces, context);
    scans += part;
    if (part == 0 || !optimum.ended) break;
  }
  double value = optimum.top;
  for (const FacePlane& face : faces.pool) {
    if (!flat.is_parallel(face)) value = std::min(value, face.most_distance(optimum.point));
  }
  return {.best = {.point = optimum.point, .value = value, .scans = scans},
          .holding = holding_normals(optimum, flat)};
}

// The part of the flat that is parallel to all faces with these normals, through another origin.
Flat parallel_part(const Flat& flat, const Vec3& origin, const Normals& holding) {
  std::vector<Vec3> taken;  // orthonormal
  const auto remainder = [&](Vec3 v) {
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Parlett, after Kahan)
      for (const Vec3& t : taken) v -= dot(v, t) * t;
    }
    return v;
  };
  for (const Vec3& normal : holding.normals) {
    const Vec3 rest = remainder(normal);
    if (norm(rest) > holding.turn) taken.push_back(normalized(rest));
  }
  Flat part{.origin = origin, .axes = {}, .turn = std::max(flat.turn, holding.turn)};
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

KernelCenter chebyshev_center(const LocalView& view, const Context& context) {
  Faces faces = sample(view);
  Flat flat;
  Stage stage = best_in_flat(view, flat, faces, context);
  KernelCenter best = stage.best;
  // Each round takes at least one of three dimensions.
  for (int round = 0; round < 3 && best.value > 0 && !stage.holding.normals.empty(); ++round) {
    flat = parallel_part(flat, stage.best.point, stage.holding);
    if (flat.is_point()) break;
    stage = best_in_flat(view, flat, faces, context);
    best.point = stage.best.point;
    best.scans += stage.best.scans;
  }
  return best;
}

}  // namespace rholm
