// Points distributed over a surface in proportion to its area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/compensated_sum.h"
#include "rholm/mesh.h"

namespace rholm {

// Sums twice the area of a mesh's triangles, which may come in parts.
// Triangles without a normal count as 0, so that every sample has a normal.
class AreaSum {
 public:
  explicit AreaSum(double scale) : scale_(scale) {}  // factor of coordinates; keeps areas in range
  // Adds the next part's triangles. Returns the ascending sums up to and including each one.
  std::vector<double> add(const Mesh& part);
  double value() const { return largest_; }

 private:
  double scale_;
  CompensatedSum sum_;
  double largest_ = 0;
};

// Throws InvalidInput if `area` is not positive.
void check_area(double area, std::size_t n_faces);

struct AreaSamples {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> faces;  // triangle of each point
};

// Draws one sample in each of `n` equal shares of the area, in the order of the
// triangles. Sample k uses the random numbers 3k, 3k + 1, 3k + 2 of `seed`.
struct AreaSampling {
  double twice_area = 0;
  std::size_t n = 0;
  std::uint64_t seed = 0;

  // Draws at most `count` samples first, first + 1 ... that lie on a part with
  // these sums of AreaSum. Sample `first` must not lie on an earlier part.
  AreaSamples draw(const Mesh& part, std::span<const double> sums, std::size_t first,
                   std::size_t count) const;
};

// Draws all samples of a mesh. Coordinates must be below about
// 1e70 in modulus. Throws InvalidInput for a mesh without area.
AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed);

}  // namespace rholm
