// Collects the sources of an adjoint sum, and sums them in blocks of fixed size.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "harmonic/nonuniform/adjoint_blocks.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"
#include "transform/rules/bernstein_rules.h"

namespace rholm {

class Sources {
 public:
  Sources(const AdjointNeeds& needs, const Context& context);

  // Adds the source w conj(Y)(x/|x|). set_progress() tells which part of the work is done.
  void add(const Vec3& x, double w);
  void set_progress(double part) { part_ = part; }
  // Sums the remaining sources and returns sum_j w_j conj(Y)(u_j).
  Coefficients finish();

  std::size_t count() const { return count_; }

 private:
  void flush();

  std::vector<Vec3> directions_;
  std::vector<double> weights_;
  AdjointBlocks sum_;
  Context context_;
  double part_ = 0;
  double reported_ = 0;
  std::size_t count_ = 0;
};

// Calls visit(x, w) for the nodes of a rule on the segment a-b that keeps the allowance; the
// weights sum to 1. Halves the segment near the singular set. `distance` returns the distance of a
// piece from the singular set. Throws InvalidInput if the segment touches the set.
using SegmentDistance = std::function<double(const Vec3& a, const Vec3& b)>;
void visit_segment(const Vec3& a, const Vec3& b, const Allowance& allowance,
                   const SegmentDistance& distance,
                   const std::function<void(const Vec3& x, double w)>& visit);

// Does the same on a triangle, whose singular point is the centre.
void visit_triangle(const std::array<Vec3, 3>& corners, const Allowance& allowance,
                    const std::function<void(const Vec3& x, double w)>& visit);

}  // namespace rholm
