// Fading of edits. Layer: edit.
#pragma once

namespace rholm {

// Returns 1 for t <= 0, 0 for t >= 1; first and second derivatives vanish at both ends.
inline double fading(double t) {
  if (!(t > 0)) return 1;
  if (t >= 1) return 0;
  const double s = 1 - t;
  return s * s * s * (10 + s * (6 * s - 15));
}

}  // namespace rholm
