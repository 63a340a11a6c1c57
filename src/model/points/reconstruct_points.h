// The points of a reconstruction, cleaned, with normals, in the order of a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"
#include "shape/points/point_tree.h"

namespace rholm {

// Between neighbours, as if points of the same density lay on a square grid.
struct Spacing {
  double median = 0;
  double fine = 0;  // only a tenth of the points lie clearly closer
};

class WorkingPoints {
 public:
  // Cleans and, where there are no normals, orients; notes it in the report.
  WorkingPoints(PointCloud cloud, ReconstructReport& report, const Context& context);

  std::size_t size() const { return points_.size(); }
  OrderedPoints ordered() const { return {*tree_, points_, normals_}; }
  double diagonal() const { return diagonal_; }
  Spacing spacing(const Context& context) const;

  // Returns how many there were. Where many more look like outliers than the suspects that no cap
  // fits, they are features that the points hardly show: then only suspects can be. Without
  // suspects all can be.
  std::size_t remove_outliers(double noise, std::span<const std::uint32_t> suspects,
                              const Context& context);

  // Gives each vertex the mean of the attributes of the points around it.
  void carry_attributes(Mesh& mesh, const Context& context) const;

 private:
  void order(const Context& context);
  // Drops the points whose flag is set, unless too few would be left.
  bool remove(const std::vector<std::uint8_t>& gone, const Context& context);

  PointCloud cloud_;
  std::unique_ptr<PointTree> tree_;
  std::vector<Vec3> points_, normals_;  // in the order of the tree
  double diagonal_ = 0;
};

}  // namespace rholm
