// Normals of tiles by a field that all points share (orient_field.h). Layer: reconstruct, private.
//
// A tile's part of the sample that the field is solved for is in "thinned/TILE". The normals that
// the field gives for the tile's points are in "sheetsWAY/TILE".
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/normals/tile_doubt.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/face.h"
#include "shape/points/orient_field.h"

namespace rholm {

// Normal of one point.
struct SheetNormal {
  float x = 0, y = 0, z = 0;
  float agreement = 0;  // mean agreement with the neighbours
};

// Each step must be done for all tiles before the next step.
class TileField {
 public:
  // The directions of all tiles must be in the store. `spacings` has a value for each tile,
  // `n_points` is the number of all points, `n_neighbors` belongs to the fits of the directions.
  TileField(PieceStore& store, const TilePlan& plan, const std::vector<double>& spacings,
            std::uint64_t n_points, int n_neighbors);

  void thin(std::size_t tile, const Context& context);
  // Takes the next way to use the field, for the next three functions; false if none is left.
  bool next();
  void solve(const Context& context);
  void find_sheets(std::size_t tile, const Context& context);
  // Returns true if the normals come from sheets; otherwise the next way may be better. Then
  // is_better() is true if the winding number contradicts the new normals of the samples clearly
  // less than the normals that they have.
  bool are_sheets(const DoubtScene& scene, const Context& context);
  bool is_better() const { return better_; }

  std::vector<SheetNormal> read_sheets(std::size_t tile) const;
  // Returns for each sample how nearly the winding number is 1 behind and 0 before it.
  const std::vector<double>& trust() const { return trust_; }
  int n_neighbors() const { return ways_[way_].n_neighbors; }
  // Removes pieces that are no longer needed.
  void remove();

 private:
  struct Way {
    int n_neighbors = 0;
    double spread = 1;  // of patches
    double width = 1;   // of patches where the field is asked
    bool must_be_clean = false;
  };
  std::string sheets_name(std::size_t tile, std::size_t way) const;
  double residual() const;

  PieceStore& store_;
  const TilePlan& plan_;
  const std::vector<double>& spacings_;
  std::uint64_t n_points_;
  int n_fit_;  // neighbours of the directions
  std::vector<Way> ways_ = {};
  std::size_t way_ = 0;
  bool begun_ = false, better_ = false;
  UnitFrame frame_ = {};
  std::optional<SolvedField> field_ = {};
  std::vector<double> trust_ = {};
};

}  // namespace rholm
