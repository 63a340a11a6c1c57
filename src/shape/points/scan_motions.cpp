#include "shape/points/scan_motions.h"

#include <cmath>

namespace rholm {
namespace {

// Share of the weight of a scan's pairs that resists any motion. So motions that pairs resist less,
// such as a slide of a plane or a turn of a ball, are suppressed; others are slowed by this share.
constexpr double kRest = 1e-3;
// Tolerance relative to the right-hand side; pairs are searched anew in any case.
constexpr double kSolved = 1e-8;

Vector6 jacobian(const Vec3& at, const Vec3& normal, const Vec3& middle, double radius) {
  const Vec3 turn = cross(at - middle, normal) / radius;
  return {turn.x, turn.y, turn.z, normal.x, normal.y, normal.z};
}

void add(Matrix6& sum, double weight, const Vector6& a, const Vector6& b) {
  for (int i = 0; i < kSix; ++i) {
    for (int j = 0; j < kSix; ++j) sum[i][j] += weight * a[i] * b[j];
  }
}

void add_product(const Matrix6& m, const Vector6& x, Vector6& sum) {
  for (int i = 0; i < kSix; ++i) {
    for (int j = 0; j < kSix; ++j) sum[i] += m[i][j] * x[j];
  }
}

void add_transposed(const Matrix6& m, const Vector6& x, Vector6& sum) {
  for (int i = 0; i < kSix; ++i) {
    for (int j = 0; j < kSix; ++j) sum[j] += m[i][j] * x[i];
  }
}

using Unknowns = std::vector<Vector6>;

double dot(const Unknowns& a, const Unknowns& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (int i = 0; i < kSix; ++i) sum += a[k][i] * b[k][i];
  }
  return sum;
}

void add(Unknowns& sum, double factor, const Unknowns& x) {
  for (std::size_t k = 0; k < sum.size(); ++k) {
    for (int i = 0; i < kSix; ++i) sum[k][i] += factor * x[k][i];
  }
}

// The normal equations in blocks of six.
struct Blocks {
  struct OfTwo {
    std::uint32_t a = 0, b = 0;
    Matrix6 block{};
  };
  std::vector<Matrix6> diagonal, factors;
  std::vector<OfTwo> others;  // pairs of one scan with another are in succession
  Unknowns right;

  Unknowns times(const Unknowns& x) const {
    Unknowns y(x.size());
    for (std::size_t k = 0; k < x.size(); ++k) add_product(diagonal[k], x[k], y[k]);
    for (const OfTwo& two : others) {
      add_product(two.block, x[two.b], y[two.a]);
      add_transposed(two.block, x[two.a], y[two.b]);
    }
    return y;
  }

  Unknowns preconditioned(Unknowns x) const {
    for (std::size_t k = 0; k < x.size(); ++k) rholm::solve(factors[k], x[k]);
    return x;
  }
};

Blocks blocks_of(std::span<const ScanPair> pairs, std::span<const ScanBody> bodies,
                 const Vec3& middle, double radius) {
  Blocks blocks;
  blocks.diagonal.resize(bodies.size());
  blocks.right.resize(bodies.size());
  std::vector<double> weights(bodies.size(), 0.0);
  for (const ScanPair& pair : pairs) {
    const Vector6 a = jacobian(pair.a, pair.normal, middle, radius);
    const Vector6 b = jacobian(pair.b, pair.normal, middle, radius);
    add(blocks.diagonal[pair.from], pair.weight, a, a);
    add(blocks.diagonal[pair.to], pair.weight, b, b);
    if (blocks.others.empty() || blocks.others.back().a != pair.from ||
        blocks.others.back().b != pair.to) {
      blocks.others.push_back({.a = pair.from, .b = pair.to});
    }
    add(blocks.others.back().block, -pair.weight, a, b);
    const double pull = pair.weight * pair.distance();
    for (int i = 0; i < kSix; ++i) {
      blocks.right[pair.from][i] -= pull * a[i];
      blocks.right[pair.to][i] += pull * b[i];
    }
    weights[pair.from] += pair.weight;
    weights[pair.to] += pair.weight;
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const double rest = weights[k] > 0 ? kRest * weights[k] : 1;
    for (int i = 0; i < kSix; ++i) {
      for (int j = 0; j < kSix; ++j) blocks.diagonal[k][i][j] += rest * bodies[k].inertia[i][j];
    }
  }
  blocks.factors = blocks.diagonal;
  for (Matrix6& factor : blocks.factors) {
    if (factorize(factor)) continue;
    // Points on a line do not determine turns about it; then this scan has no preconditioner.
    factor = {};
    for (int i = 0; i < kSix; ++i) factor[i][i] = 1;
  }
  return blocks;
}

// Solves by conjugate gradients, preconditioned by the block of each scan.
Unknowns solve(const Blocks& blocks) {
  Unknowns x(blocks.right.size()), rest = blocks.right;
  const double enough = kSolved * kSolved * dot(rest, rest);
  Unknowns better = blocks.preconditioned(rest), way = better;
  double slope = dot(rest, better);
  // The method is exact after as many steps as there are unknowns.
  for (std::size_t step = 0; step < kSix * x.size() && dot(rest, rest) > enough; ++step) {
    const Unknowns image = blocks.times(way);
    const double length = slope / dot(way, image);
    if (!std::isfinite(length)) break;
    add(x, length, way);
    add(rest, -length, image);
    better = blocks.preconditioned(rest);
    const double next = dot(rest, better);
    for (std::size_t k = 0; k < way.size(); ++k) {
      for (int i = 0; i < kSix; ++i) way[k][i] = better[k][i] + next / slope * way[k][i];
    }
    slope = next;
  }
  return x;
}

void take_mean_away(std::span<const ScanBody> bodies, Unknowns& x) {
  Matrix6 all{};
  Vector6 mean{};
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    Vector6 moved{};
    add_product(bodies[k].inertia, x[k], moved);
    for (int i = 0; i < kSix; ++i) {
      mean[i] += bodies[k].points * moved[i];
      for (int j = 0; j < kSix; ++j) all[i][j] += bodies[k].points * bodies[k].inertia[i][j];
    }
  }
  if (!factorize(all)) return;
  rholm::solve(all, mean);
  for (Vector6& own : x) {
    for (int i = 0; i < kSix; ++i) own[i] -= mean[i];
  }
}

}  // namespace

ScanBody body_of(std::span<const Vec3> points, const Vec3& middle, double radius) {
  ScanBody body{.points = static_cast<double>(points.size())};
  for (const Vec3& point : points) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Vector6 row = jacobian(point, axis, middle, radius);
      add(body.inertia, 1 / body.points, row, row);
    }
  }
  return body;
}

std::vector<RigidMotion> solve_motions(std::span<const ScanPair> pairs,
                                       std::span<const ScanBody> bodies, const Vec3& middle,
                                       double radius) {
  Unknowns x = solve(blocks_of(pairs, bodies, middle, radius));
  take_mean_away(bodies, x);
  std::vector<RigidMotion> motions(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    motions[k] = {.middle = middle,
                  .shift = {x[k][3], x[k][4], x[k][5]},
                  .turn = Vec3{x[k][0], x[k][1], x[k][2]} / radius};
  }
  return motions;
}

}  // namespace rholm
