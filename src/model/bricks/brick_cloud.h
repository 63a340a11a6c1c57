// The points of a reconstruction in bricks: sorted, cleaned, with normals. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "atlas/cover/cap_size.h"
#include "io/spill/piece_store.h"
#include "model/bricks/brick_fit.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_scene.h"
#include "model/bricks/brick_stages.h"
#include "model/bricks/point_source.h"
#include "model/bricks/point_survey.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Caps are tried with up to so many neighbours before the halo of a brick ends.
inline constexpr std::size_t kTried = 128;

class BrickCloud {
 public:
  // Surveys the points and plans the bricks.
  BrickCloud(PointSource& source, PieceStore& store, const ReconstructOptions& options,
             std::uint64_t points_per_brick, BrickStages& stages, ReconstructReport& report);

  // Sorts the points into bricks and removes those far from all others; computes their normals or
  // mends those given; measures what sample() and size() tell. The report says what was done.
  void prepare();
  // Measures again, after points have been removed.
  void measure_again();

  const Survey& survey() const { return survey_; }
  const BrickPlan& plan() const { return plan_; }
  std::size_t n_bricks() const { return n_; }
  // Points that differ, before outliers near the surface are removed.
  std::uint64_t n_points() const { return points_; }
  // Whether normals are those of the source.
  bool normals_given() const { return given_; }
  const WholeSample& sample() const { return sample_; }
  const CapSize& size() const { return size_; }
  // Neighbours of a flat neighbourhood, or fewer.
  std::size_t around() const { return around_; }
  bool has_column(const char* name) const;
  // Diagonal of the points, before outliers near the surface are removed.
  double diagonal() const { return diagonal_; }
  // A brick with the halo that caps of so many neighbours need, and no less than `least`.
  BrickScene load(std::size_t brick, std::size_t neighbours, double least = 0) const;

 private:
  void find_survey(std::uint64_t points_per_brick);
  void sort();
  void refuse_scans() const;
  void remove_strays();
  void look_at_shape();
  void orient();
  void mend();
  void count_points();
  void take_sample(const std::string& round);
  void choose_size(const std::string& round);

  PointSource& source_;
  PieceStore& store_;
  const ReconstructOptions& options_;
  BrickStages& stages_;
  ReconstructReport& report_;
  Survey survey_;
  BrickPlan plan_;
  std::size_t n_ = 0;  // bricks
  std::uint64_t points_ = 0;
  double diagonal_ = 0;
  bool given_ = false;
  std::size_t around_ = 0;        // neighbours that tell the area of a point
  std::vector<double> spacings_;  // in each brick
  WholeSample sample_;
  CapSize size_;
};

}  // namespace rholm
