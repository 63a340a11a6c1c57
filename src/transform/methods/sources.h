// The sources of an adjoint sum, collected piece by piece and summed in blocks of fixed size.
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

  // The source w conj(Y)(x/|x|); `part` of the work is done (for the progress).
  void add(const Vec3& x, double w);
  void set_progress(double part) { part_ = part; }
  // Sums what is left and returns sum_j w_j conj(Y)(u_j).
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

// Calls visit(x, w) for the nodes of a rule on the segment a-b whose weights sum to 1 and that
// keeps the allowance; halves the segment where it comes near the singular set. `distance` gives
// the distance of a piece from that set. Throws InvalidInput if the segment touches it.
using SegmentDistance = std::function<double(const Vec3& a, const Vec3& b)>;
void visit_segment(const Vec3& a, const Vec3& b, const Allowance& allowance,
                   const SegmentDistance& distance,
                   const std::function<void(const Vec3& x, double w)>& visit);

// The same on a triangle, whose singular point is the centre.
void visit_triangle(const std::array<Vec3, 3>& corners, const Allowance& allowance,
                    const std::function<void(const Vec3& x, double w)>& visit);

}  // namespace rholm
