// The rotation of one degree by 90 degrees about the y axis, from z to x: the only one that is not
// diagonal, since R = Rz(a - 90) J^-1 Rz(b) J Rz(c + 90) for any R = Rz(a) Ry(b) Rz(c).
//
// Delta^l_{m1 m2} = d^l_{m1 m2}(pi/2) by Trapani and Navaza's recurrence (2006),
//   Delta_{m1 m2} = [2 m2 Delta_{m1+1,m2} - sqrt((l-m1-1)(l+m1+2)) Delta_{m1+2,m2}]
//                   / sqrt((l-m1)(l+m1+1)),       Delta_{l m2} = (-1)^{l-m2} 2^-l sqrt(C(2l,
//                   l+m2)),
// downwards from m1 = l for 0 <= m2 <= m1, where values grow until they oscillate: no error grows
// faster than they do. The rest by symmetry:
//   Delta_{m2 m1} = (-1)^{m1-m2} Delta_{m1 m2},   Delta_{-m1,m2} = (-1)^{l+m2} Delta_{m1 m2},
//   Delta_{m1,-m2} = (-1)^{l+m1} Delta_{m1 m2}.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace rholm {

class QuarterTurn {
 public:
  // Computes degree l; memory of earlier degrees is used again.
  void set_degree(int l);

  int degree() const { return degree_; }
  // Delta_{m1 m2}, |m1|, |m2| <= l.
  double delta(int m1, int m2) const;

  // c[m], s[m], m = 0 ... l, of the function turned by J, or by its inverse. s[0] is 0 and stays.
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
  std::vector<int> pending_;            // how many factors kTiny a column lacks
  std::vector<double> in_[2], out_[2];  // see apply()
};

}  // namespace rholm
