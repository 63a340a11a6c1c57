#include "chart/cap/dilation.h"

#include <cmath>

namespace rholm {

double dilation_between(double angle, double opened) {
  return std::tan(opened / 2) / std::tan(angle / 2);
}

double conformal_factor(double a, double cosine) {
  return 2 * a / (1 + cosine + a * a * (1 - cosine));
}

Vec3 dilated(double a, const Vec3& u) {
  if (a == 1) return u;
  const double factor = conformal_factor(a, u.z);
  const double up = 1 + u.z, down = a * a * (1 - u.z);
  return {factor * u.x, factor * u.y, (up - down) / (up + down)};
}

}  // namespace rholm
