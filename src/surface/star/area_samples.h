// Points spread over a surface in proportion to its area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/compensated_sum.h"
#include "rholm/mesh.h"

namespace rholm {

// Twice the area of the triangles of a mesh, which may come in parts. Triangles without a normal
// count as 0, so that every sample has one.
class AreaSum {
 public:
  explicit AreaSum(double scale) : scale_(scale) {}  // of coordinates: areas of any unit in range
  // Adds the triangles of the next part: the sums up to and with each, which never fall.
  std::vector<double> add(const Mesh& part);
  double value() const { return largest_; }

 private:
  double scale_;
  CompensatedSum sum_;
  double largest_ = 0;
};

// Throws InvalidInput for a surface of that area.
void check_area(double area, std::size_t n_triangles);

struct AreaSamples {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangles;  // on which each lies
};

// One sample in each of `n` equal shares of the area, laid out in the order of the triangles;
// sample k uses the random numbers 3k, 3k + 1, 3k + 2 of `seed`.
struct AreaSampling {
  double twice_area = 0;
  std::size_t n = 0;
  std::uint64_t seed = 0;

  // Samples first, first + 1 ... of a part with these sums of AreaSum: at most `count`, and no
  // longer than they lie on its triangles. The first must not lie on a part before.
  AreaSamples draw(const Mesh& part, std::span<const double> sums, std::size_t first,
                   std::size_t count) const;
};

// All samples of a mesh. Coordinates below about 1e70 in modulus. Throws InvalidInput for a mesh
// without area.
AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed);

}  // namespace rholm
