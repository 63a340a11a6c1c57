// The rotation J by 90 degrees about the y axis, from z to x, for one degree. J is the only factor
// that is not diagonal in R = Rz(a) Ry(b) Rz(c) = Rz(a - 90) J^-1 Rz(b) J Rz(c + 90).
//
// Delta^l_{m1 m2} = d^l_{m1 m2}(pi/2) follows from the recurrence of Trapani and Navaza (2006):
//   Delta_{m1 m2} = [2 m2 Delta_{m1+1,m2} - sqrt((l-m1-1)(l+m1+2)) Delta_{m1+2,m2}]
//                   / sqrt((l-m1)(l+m1+1)).
//   Delta_{l m2}  = (-1)^{l-m2} 2^-l sqrt(C(2l, l+m2)).
// It runs downwards from m1 = l for 0 <= m2 <= m1, where values grow until they oscillate: no error
// grows faster than the values. Symmetry gives the other values:
//   Delta_{m2 m1} = (-1)^{m1-m2} Delta_{m1 m2},   Delta_{-m1,m2} = (-1)^{l+m2} Delta_{m1 m2},
//   Delta_{m1,-m2} = (-1)^{l+m1} Delta_{m1 m2}.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace rholm {

class QuarterTurn {
 public:
  // Computes degree l and reuses the memory of earlier degrees.
  void set_degree(int l);

  int degree() const { return degree_; }
  // Returns Delta_{m1 m2}, |m1|, |m2| <= l.
  double delta(int m1, int m2) const;

  // Applies J or its inverse to c[m], s[m], m = 0 ... l. s[0] is 0 and stays 0.
  enum class Way { kForward, kInverse };
  void apply(Way way, double* c, double* s);

 private:
  void start_values();
  void descend();
  const double* row(int m1) const {
    return triangle_.data() + static_cast<std::size_t>(m1) * (static_cast<std::size_t>(m1) + 1) / 2;
  }
  double* row(int m1) { return const_cast<double*>(std::as_const(*this).row(m1)); }

  int degree_ = -1;
  std::vector<double> triangle_;  // rows m1 = 0 ... l of m2 = 0 ... m1
  std::vector<double> current_, next_, after_;
  std::vector<int> pending_;            // number of factors kTiny that a column lacks
  std::vector<double> in_[2], out_[2];  // inputs and outputs of apply()
};

}  // namespace rholm
