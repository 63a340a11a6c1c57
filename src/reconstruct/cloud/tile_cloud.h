// The points of a reconstruction in tiles: sorted, cleaned, with normals. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "atlas/cover/cap_size.h"
#include "parts/stages.h"
#include "parts/store.h"
#include "reconstruct/normals/tile_fit.h"
#include "reconstruct/points/point_source.h"
#include "reconstruct/points/point_survey.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/reconstruct.h"

namespace rholm {

class TileCloud {
 public:
  // Surveys the points and plans the tiles.
  TileCloud(PointSource& source, PieceStore& store, const ReconstructOptions& options,
            std::uint64_t points_per_tile, Stages& stages, ReconstructReport& report);

  // Sorts points into tiles, removes isolated points, and computes normals or mends given normals.
  // Then measures what sample() and size() return. The report says what was done.
  void prepare();
  // Measures again, after points have been removed.
  void measure_again();

  const Survey& survey() const { return survey_; }
  const TilePlan& plan() const { return plan_; }
  std::size_t n_tiles() const { return n_; }
  // Number of different points, before outliers near the surface are removed.
  std::uint64_t n_points() const { return points_; }
  // Returns true if the normals come from the source, and false if they are computed.
  bool normals_given() const { return given_; }
  const WholeSample& sample() const { return sample_; }
  const CapSize& size() const { return size_; }
  // Number of neighbours in a flat neighbourhood; it may be lower than the neighbourhood's size.
  std::size_t around() const { return around_; }
  bool has_column(const char* name) const;
  // Diagonal of the points, before outliers near the surface are removed.
  double diagonal() const { return diagonal_; }
  // Returns a tile with a halo for `neighbours` neighbours of each point, at least `least` wide.
  // For results that do not depend on a wider halo.
  std::shared_ptr<const TileScene> load(std::size_t tile, std::size_t neighbours = 0,
                                        double least = 0) const;
  // Returns it with exactly this halo, for results that depend on the order of the points' tree.
  std::shared_ptr<const TileScene> load_for(std::size_t tile, std::size_t neighbours) const;
  // Must be called after the points of tiles have changed.
  void forget_scenes();
  // Discards the scenes in memory, and keeps no scene that is loaded later.
  void keep_no_scenes();
  // Returns the scene of the only tile, which the caller may change, and keeps no scenes from here
  // on. Removes its points from the store, unless the store is kept.
  TileScene take_only();

 private:
  std::shared_ptr<TileScene> scene(std::size_t tile, double halo, bool keep) const;
  void add_costs_of_normals();
  void find_survey(std::uint64_t points_per_tile);
  void sort();
  void remove_isolated_points();
  void look_at_shape();
  void orient();
  void mend();
  void count_points();
  void take_sample(const std::string& round);
  void choose_size(const std::string& round);

  PointSource& source_;
  PieceStore& store_;
  const ReconstructOptions& options_;
  Stages& stages_;
  ReconstructReport& report_;
  Survey survey_;
  TilePlan plan_;
  std::size_t n_ = 0;  // tiles
  std::uint64_t points_ = 0;
  double diagonal_ = 0;
  bool given_ = false;
  std::size_t around_ = 0;        // neighbours that tell the area of a point
  std::vector<double> spacings_;  // in each tile
  // The scene of each tile, once loaded, and its graph_neighbors(), once found. They are kept if
  // tiles are in memory or if there is only one.
  bool keeps_scenes_ = false;
  mutable std::mutex mutex_;  // of scenes_
  mutable std::vector<std::shared_ptr<TileScene>> scenes_;
  std::vector<std::vector<std::uint32_t>> neighbors_;
  WholeSample sample_;
  CapSize size_;
};

}  // namespace rholm
