#include "atlas/cap/cap_support.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Returns the eigenvalue R^2 / 4 of a disc's covariance; both eigenvalues are equal.
double eigenvalue_of_disc(const CapFrame& frame) { return frame.support * frame.support / 4; }

}  // namespace

Vec3 support_gradient(const Cap& cap, const Vec3& offset) {
  const CapFrame& f = cap.frame;
  const CapSupport& where = cap.where;
  const double p = dot(offset, f.x) - where.px, q = dot(offset, f.y) - where.py;
  const double h = dot(offset, f.z) / (f.support * f.support);
  return 2 * ((where.xx * p + where.xy * q) * f.x + (where.xy * p + where.yy * q) * f.y + h * f.z);
}

// The result is 1 / sqrt of the form's smaller eigenvalue.
double longer_half_axis(const CapSupport& where) {
  const double middle = (where.xx + where.yy) / 2;
  return 1 / std::sqrt(middle - std::hypot((where.xx - where.yy) / 2, where.xy));
}

Vec3 support_middle(const Cap& cap) {
  const CapFrame& f = cap.frame;
  return f.seed() + cap.where.px * f.x + cap.where.py * f.y;
}

void set_support(Cap& cap, double support) {
  cap.frame.support = support;
  const double square = 1 / (support * support);
  cap.where = {0, 0, square, 0, square};
}

PlaneMoments moments_of(const CapFrame& frame, const CapPoints& points) {
  PlaneMoments m;
  const auto n = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 offset = points.offset(i);
    const double x = dot(offset, frame.x), y = dot(offset, frame.y);
    m.p += x, m.q += y, m.xx += x * x, m.xy += x * y, m.yy += y * y;
  }
  m.p /= n, m.q /= n;
  m.xx = m.xx / n - m.p * m.p, m.xy = m.xy / n - m.p * m.q, m.yy = m.yy / n - m.q * m.q;
  m.middle = (m.xx + m.yy) / 2, m.radius = std::hypot((m.xx - m.yy) / 2, m.xy);
  return m;
}

CapSupport ellipse_of(const CapFrame& frame, const PlaneMoments& m) {
  // The half axes are bounded to sqrt(kThinnest) ... 1 of the support.
  const double most = eigenvalue_of_disc(frame), least = kThinnest * most;
  const double large = std::clamp(m.middle + m.radius, least, most);
  const double small = std::clamp(m.middle - m.radius, least, most);
  // Computes the directions of the axes.
  const double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy);
  const double c = std::cos(angle), s = std::sin(angle);
  const double a = 1 / (4 * large), b = 1 / (4 * small);
  return {m.p, m.q, a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c};
}

bool fills_ellipse(const CapFrame& frame, const PlaneMoments& m) {
  return m.middle - m.radius > kThinnest * eigenvalue_of_disc(frame);
}

}  // namespace rholm
