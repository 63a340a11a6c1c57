#include "harmonic/coefficients/solid_gradient.h"

#include <cmath>

namespace rholm {
namespace {

enum Axis { kX, kY, kZ };
enum Part { kCosine, kSine };

struct Term {
  int l, m;
  Part part;
};

// Calls visit(axis, from, to, value) for every entry of the matrices D_x, D_y and D_z. They take
// the real coefficient `from` of degree l to the real coefficient `to` of degree l - 1. The values
// follow from the equations of the header with Z_lm = (-1)^m Y_lm and
// f = Re sum_m (C - i S) sqrt(2 - [m = 0]) Z_lm.
template <typename Visit>
void visit_entries(int degree, const Visit& visit) {
  for (int l = 1; l <= degree; ++l) {
    const double q = (2.0 * l + 1) / (2.0 * l - 1);
    for (int m = 0; m <= l; ++m) {
      const double ll = l, mm = m;
      if (m < l) {
        const double z = std::sqrt(q * (ll * ll - mm * mm));
        visit(kZ, Term{l, m, kCosine}, Term{l - 1, m, kCosine}, z);
        if (m > 0) visit(kZ, Term{l, m, kSine}, Term{l - 1, m, kSine}, z);
      }
      if (m + 1 <= l - 1) {
        const double up = std::sqrt(q * (ll - mm) * (ll - mm - 1));
        const double half = m == 0 ? up / std::sqrt(2.0) : up / 2;
        visit(kX, Term{l, m, kCosine}, Term{l - 1, m + 1, kCosine}, -half);
        visit(kY, Term{l, m, kCosine}, Term{l - 1, m + 1, kSine}, -half);
        if (m > 0) {
          visit(kX, Term{l, m, kSine}, Term{l - 1, m + 1, kSine}, -half);
          visit(kY, Term{l, m, kSine}, Term{l - 1, m + 1, kCosine}, half);
        }
      }
      if (m >= 1) {
        const double down = std::sqrt(q * (ll + mm) * (ll + mm - 1));
        const double half = m == 1 ? down / std::sqrt(2.0) : down / 2;
        visit(kX, Term{l, m, kCosine}, Term{l - 1, m - 1, kCosine}, half);
        visit(kY, Term{l, m, kSine}, Term{l - 1, m - 1, kCosine}, half);
        if (m > 1) {
          visit(kX, Term{l, m, kSine}, Term{l - 1, m - 1, kSine}, half);
          visit(kY, Term{l, m, kCosine}, Term{l - 1, m - 1, kSine}, -half);
        }
      }
    }
  }
}

double value(const Coefficients& f, const Term& t) {
  return t.part == kCosine ? f.c(t.l, t.m) : f.s(t.l, t.m);
}

double& value(Coefficients& f, const Term& t) {
  return t.part == kCosine ? f.c(t.l, t.m) : f.s(t.l, t.m);
}

}  // namespace

std::array<Coefficients, 3> solid_gradient(const Coefficients& f) {
  std::array<Coefficients, 3> g = {Coefficients(f.degree()), Coefficients(f.degree()),
                                   Coefficients(f.degree())};
  visit_entries(f.degree(), [&](Axis axis, const Term& from, const Term& to, double entry) {
    value(g[axis], to) += entry * value(f, from);
  });
  return g;
}

void add_solid_gradient_transpose(const std::array<Coefficients, 3>& g, Coefficients& sum) {
  visit_entries(sum.degree(), [&](Axis axis, const Term& from, const Term& to, double entry) {
    value(sum, from) += entry * value(g[axis], to);
  });
}

}  // namespace rholm
