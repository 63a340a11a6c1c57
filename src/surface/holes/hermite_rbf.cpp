#include "surface/holes/hermite_rbf.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// phi = r^3, grad phi = 3 r d, Hessian 3 (r 1 + d d^T / r), which is 0 at d = 0.
Vec3 gradient(const Vec3& d) { return 3 * norm(d) * d; }
Vec3 hessian_times(const Vec3& d, const Vec3& v) {
  const double r = norm(d);
  if (r == 0) return {};
  return 3 * (r * v + (dot(d, v) / r) * d);
}

Vec3 unit(int k) { return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }
double part(const Vec3& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

// Unknowns: alpha_j, beta_j (from 4 j), then a, b. Equations: s(x_i) = 0, grad s(x_i) =
// n_i, and sum alpha = 0, sum (alpha x + beta) = 0, which keep polynomials out of the sums.
Eigen::MatrixXd system_of(std::span<const Vec3> x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(4 * n + 4, 4 * n + 4);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec3 d = x[i] - x[j];
      const double r = norm(d);
      const Vec3 g = gradient(d);
      m(4 * i, 4 * j) = r * r * r;
      for (int k = 0; k < 3; ++k) {
        m(4 * i + 1 + k, 4 * j) = part(g, k);
        m(4 * i, 4 * j + 1 + k) = -part(g, k);
        const Vec3 h = hessian_times(d, unit(k));
        for (int l = 0; l < 3; ++l) m(4 * i + 1 + l, 4 * j + 1 + k) = -part(h, l);
      }
    }
    m(4 * j, 4 * n) = m(4 * n, 4 * j) = 1;
    for (int k = 0; k < 3; ++k) {
      m(4 * j, 4 * n + 1 + k) = m(4 * n + 1 + k, 4 * j) = part(x[j], k);
      m(4 * j + 1 + k, 4 * n + 1 + k) = m(4 * n + 1 + k, 4 * j + 1 + k) = 1;
    }
  }
  return m;
}

}  // namespace

HermiteRbf::HermiteRbf(std::span<const Vec3> centers, std::span<const Vec3> normals) {
  if (centers.empty() || centers.size() > kMaxCenters || normals.size() != centers.size()) return;
  for (const Vec3& c : centers) middle_ += c / static_cast<double>(centers.size());
  double extent = 0;
  for (const Vec3& c : centers) extent = std::max(extent, norm(c - middle_));
  if (!(extent > 0)) return;
  scale_ = 1 / extent;
  std::vector<Vec3> x;
  for (const Vec3& c : centers) x.push_back(scale_ * (c - middle_));
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(4 * n + 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) right(4 * i + 1 + k) = part(normals[i], k);
  }
  const Eigen::VectorXd solution = system_of(x).partialPivLu().solve(right);
  valid_ = solution.allFinite();
  const auto vector_at = [&](Eigen::Index i) {
    return Vec3{solution(i), solution(i + 1), solution(i + 2)};
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    terms_.push_back({x[j], solution(4 * j), vector_at(4 * j + 1)});
  }
  constant_ = solution(4 * n);
  linear_ = vector_at(4 * n + 1);
}

HermiteRbf::Value HermiteRbf::at(const Vec3& x) const {
  const Vec3 local = scale_ * (x - middle_);
  double sum = constant_ + dot(linear_, local);
  Vec3 gradient = linear_;
  for (const Term& term : terms_) {
    const Vec3 d = local - term.center;
    const double square = dot(d, d), length = std::sqrt(square), along = dot(term.beta, d);
    sum += length * (term.alpha * square - 3 * along);
    // Uses grad |d|^3 = 3 |d| d and grad (|d| beta . d) = |d| beta + (beta . d) d / |d|.
    const double across = length > 0 ? along / length : 0;
    gradient += 3 * ((term.alpha * length - across) * d - length * term.beta);
  }
  return {sum / scale_, gradient};
}

}  // namespace rholm
