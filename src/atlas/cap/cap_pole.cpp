#include "atlas/cap/cap_pole.h"

#include "harmonic/legendre/low_harmonics.h"

namespace rholm {

CapPole cap_pole(const CapFrame& frame, CapBasis basis, int degree, std::span<const double> c) {
  const LowHarmonics& h = low_harmonics();
  const bool even = basis == CapBasis::kEven;
  CapPole pole;
  double d1 = 0, d2 = 0;
  double below0 = 0, p0 = h.start[0], below1 = 0, p1 = h.start[1];
  for (int l = 0; l <= degree; ++l) {
    if (l > 0) {
      const double next = h.a[0][l] * (p0 - h.b[0][l] * below0);
      below0 = p0, p0 = next;
    }
    if (l > 1) {
      const double next = h.a[1][l] * (p1 - h.b[1][l] * below1);
      below1 = p1, p1 = next;
    }
    if (!even || l % 2 == 0) pole.level += c[even ? even_index(l, 0) : low_index(l, 0)] * p0;
    if (l == 0 || (even && l % 2 == 0)) continue;
    const std::size_t first = even ? even_index(l, 1) : low_index(l, 1);
    d1 += c[first] * p1;
    d2 += c[first + 1] * p1;
  }
  pole.slope1 = frame.dilation * d1 / pole.level;
  pole.slope2 = frame.dilation * d2 / pole.level;
  return pole;
}

CapFoot cap_foot(const Atlas& atlas, const Cap& cap) {
  const CapFrame& f = cap.frame;
  const CapPole pole = cap_pole(f, cap.basis, cap.degree, atlas.coefficients_of(cap));
  return {f.center + f.radius * pole.level * f.z,
          normalized(f.z - pole.slope1 * f.x - pole.slope2 * f.y)};
}

}  // namespace rholm
