// Maximises t subject to n_T . c + t <= n_T . v_T over a growing pool of faces. The pool is at
// first a sample spread over all faces; then faces that turn out to matter join it.
//
// A pass over all faces works at the pool's optimum. For each chunk of faces it keeps the faces
// with the smallest d_T, and a lower bound of d_T of all others. Moving the centre by delta
// changes no d_T by more than |delta|. If the optimum of the grown pool is near enough, the
// bounds prove without another pass that it is the optimum of all faces. Only chunks whose bound
// is too weak are passed again.
//
// The optimum need not be one point: between two parallel faces it is a whole plane. Then the faces
// that hold it are fixed, and the smallest d_T of the others is maximised within the plane. This
// repeats until a point is left (the nucleolus, Schmeidler 1969); the centre of a box is its
// middle.
//
// A plane that rounding of its corners may turn counts as far out as it may lie. A face thinner
// than the rounding does not count.
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
// Half the side of the box in which the centre is sought. In the unit frame the bounding box is at
// most [-1, 1]^3; the margin avoids cutting a kernel that touches the box.
constexpr double kReach = 1.0625;
// d_T cannot exceed the diagonal of the unit frame.
constexpr double kMostDistance = 4;
// Upper and lower bounds closer than this have met. d_T is known to about 1e-15, and 1e-12 of the
// size is far below what any later step resolves.
constexpr double kGap = 1e-12;
// Limit of passes, only a guard against rounding; 1 to 3 passes are usual.
constexpr int kMaxScans = 200;
// A face holds the optimum if its weight in the program is above this. It is parallel to a flat if
// the part of its normal within the flat is below this. Normals of exact corners are known to
// 1e-15, and moving along such a flat changes no d_T by more than 1e-9 of the size. Where rounding
// may turn the planes by more, the angle of that turn is used instead. For example, the sides of a
// cylinder in single precision are parallel to its axis.
constexpr double kParallel = 1e-9;

// Size of the first pool: one face in kSampled, within these limits. Measured (scripts/constants)
// on smooth and rough shapes of 30 000 to 5 million faces; a pass costs 5 to 8 ns per face. Fewer
// faces give a worse first optimum, more faces cost as much as a pass.
constexpr std::size_t kSampled = 64;
constexpr std::size_t kFewestSampled = 1000;
constexpr std::size_t kMostSampled = 4000;
// Number of faces, each less than kSlack above the optimum, that a chunk adds in a pass. More and
// higher faces prove more about the next optimum, but are handled one by one.
constexpr std::size_t kKept = 8;
constexpr double kSlack = 0.03;

// The points origin + z.x axes[0] + z.y axes[1] + z.z axes[2]; axes are orthonormal or zero.
struct Flat {
  Vec3 origin;
  std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  double turn = kParallel;  // angle by which rounding may turn the flat

  Vec3 direction(const Vec3& z) const { return z.x * axes[0] + z.y * axes[1] + z.z * axes[2]; }
  Vec3 project(const Vec3& v) const { return {dot(v, axes[0]), dot(v, axes[1]), dot(v, axes[2])}; }
  bool is_point() const { return axes[0] == Vec3{}; }
  bool is_parallel(const FacePlane& face) const {
    return norm(project(face.normal)) <= std::max(turn, face.turn);
  }
};

// Lower bound: faces of a chunk outside the pool have d_T >= least, seen from `from`.
struct ChunkBound {
  Vec3 from;
  double least = -kInfinity;
  double at(const Vec3& point) const { return least - norm(point - from); }
};

struct Faces {
  std::vector<FacePlane> pool;
  std::vector<ChunkBound> chunks;  // each of triangle_grain(n) triangles
};

Faces sample(const LocalView& view) {
  const std::size_t n = view.mesh.n_faces;
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

// Returns how far out rounding may move the plane, anywhere in the unit frame.
double rounding_of(const FacePlane& face) { return FacePlane::kFrameDiagonal * face.turn; }

// Best known optimum of the pool within a flat.
struct PoolOptimum {
  LinearProgram program{kReach, kMostDistance};
  Vec3 point;
  double top = kMostDistance;  // upper bound of the smallest d_T in the pool, and so in all
  // Planes turned against each other by rounding, for example on a flat wall in single
  // precision, meet anywhere and may keep the program from its end. If true, each plane counts
  // as far out as it may lie.
  bool roughly = false;
  bool ended = true;  // false: rounding keeps the program from its end even with `roughly`

  double distance(const FacePlane& face) const {
    return face.most_distance(point) + (roughly ? rounding_of(face) : 0);
  }
};

// Adds to the program the lowest face below `top` of every 64 faces of the pool (chosen: some
// hundred rows). Returns the smallest d_T.
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

// Moves to the optimum of a pool that has grown.
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

// Returns the faces of a chunk with the smallest d_T below top + kSlack; bounds the other faces.
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

// Passes over the chunks that may have faces below the pool's optimum, and adds their nearest faces
// to the pool. Returns the passed fraction of all chunks; 0 proves the optimum for all faces.
double grow_pool(const LocalView& view, const Flat& flat, const PoolOptimum& optimum, Faces& faces,
                 const Context& context) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < faces.chunks.size(); ++i) {
    if (faces.chunks[i].at(optimum.point) < optimum.top - kGap) open.push_back(i);
  }
  const std::size_t n = view.mesh.n_faces, grain = triangle_grain(n);
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

// Normals of planes, and the largest turn of the planes by rounding.
struct Normals {
  std::vector<Vec3> normals = {};
  double turn = kParallel;
};

// Returns the normals of the planes that hold the program's optimum. Where rounding turns planes,
// other planes get weights as large as the turns.
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

// Best point of the flat, and the normals of the faces that hold it.
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

// Returns the part of the flat parallel to all faces with these normals, through a given origin.
Flat parallel_part(const Flat& flat, const Vec3& origin, const Normals& holding) {
  std::vector<Vec3> taken;  // orthonormal
  const auto remainder = [&](Vec3 v) {
    for (int pass = 0; pass < 2; ++pass) {  // two passes are enough (Parlett, after Kahan)
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
    // The squares of the remainders add up to the number of dimensions left. If this number is at
    // least one, the longest of three remainders is at least sqrt(1/3).
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
  // Each round removes at least one of three dimensions.
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
