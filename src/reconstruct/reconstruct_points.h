// The points of a reconstruction, cleaned, with normals, in the order of a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"
#include "shape/points/crossings.h"
#include "shape/points/local_shape.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"
#include "shape/points/sign_check.h"
#include "shape/points/wall_check.h"
#include "surface/holes/seen_space.h"

namespace rholm {

// Between neighbours, as if points of the same density lay on a square grid; between rows where
// they lie in rows.
struct Spacing {
  double median = 0;
  double fine = 0;  // only a tenth of the points lie clearly closer
  double area = 0;  // that all points stand for, by the circles of their neighbours
};

class WorkingPoints {
 public:
  // Cleans, removes what is far from all others if wanted, and orients where there are no normals;
  // notes it in the report.
  WorkingPoints(PointCloud cloud, const ReconstructOptions& options, ReconstructReport& report,
                const Context& context);

  std::size_t size() const { return tree_->size(); }
  OrderedPoints ordered() const { return {*tree_, points_, normals_, &gaps_, computed_}; }
  double diagonal() const { return diagonal_; }
  Spacing spacing(const Context& context) const;
  // Around a place: between its nearest points, or between their rows.
  double spacing_at(const Vec3& place) const;

  // The share of the points whose given normals contradict those around; 0 for computed ones.
  double wrong_normals(const Context& context) const;

  // Where sheets of the points cross.
  Crossings crossings(double noise, const Context& context) const;
  // Of some of the points, for check_walls().
  WallPatches patches(const Context& context) const;

  // Of points near the surface, by their normals; returns how many were removed. Where more than
  // `most` look like outliers they are features that the points hardly show: then only those that
  // no cap fits, the suspects, can be.
  std::size_t remove_outliers(double noise, std::size_t most,
                              std::span<const std::uint32_t> suspects, const Context& context);

  // Where all points have sensors; see SeenSpace.
  std::optional<SeenSpace> seen_space(double edge, double margin, const Context& context) const;
  // Frees points and normals: spacing_at() and carry_attributes() do without.
  void keep_tree();
  // Gives each vertex the mean of the attributes of the points around it.
  void carry_attributes(Mesh& mesh, const Context& context) const;

 private:
  // Those that are far from all others; returns how many.
  std::size_t remove_strays(const Context& context);
  // Refuses points that no surface goes with.
  void check_points();
  void compute_normals(const ReconstructOptions& options, ReconstructReport& report,
                       const Context& context);
  // Turns given normals that contradict others, or the winding number of all.
  void mend_normals(const ReconstructOptions& options, ReconstructReport& report,
                    const Context& context);
  // Before or after normals are turned.
  void note_contradictions(const SignPieces& pieces, const SignCheck& check, bool after,
                           ReconstructReport& report) const;
  std::vector<SignSample> sign_samples(const SignPieces& pieces, const Context& context) const;
  // Refuses points that look like a curve or a volume.
  LocalShape look_at_shape(const Context& context);
  // The area that point i stands for.
  double area_at(std::size_t i, std::vector<Neighbor>& near) const;
  void put_sensor(const Vec3& sensor);
  void order_points(const Context& context);
  void order_normals(const Context& context);
  // Drops the points whose flag is set, unless too few would be left.
  bool remove(const std::vector<std::uint8_t>& gone, const Context& context);

  PointCloud cloud_;
  std::unique_ptr<PointTree> tree_;
  SamplingGaps gaps_;
  std::vector<std::uint32_t> neighbors_;  // graph_neighbors() of these, if they are known
  std::size_t around_ = kCircle;          // neighbours that say the area of a point
  bool computed_ = false;                 // normals
  bool has_one_sensor_ = false;           // by an option: no attribute of the surface
  std::vector<Vec3> points_, normals_;    // in the order of the tree
  double diagonal_ = 0;
};

}  // namespace rholm
