// Normals for points in tiles, as orient() finds them. Layer: reconstruct, private.
//
// The results of a tile alone are in "directions/TILE" and "signs/TILE". Their agreement with other
// tiles is in "votes/TILE". Normals that point out of the solid, and the confidence of their signs,
// are in "normals/TILE". Points that were measured from known places need only the first and the
// last. The piece "oriented" says that all is there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "parts/stages.h"
#include "parts/store.h"
#include "reconstruct/normals/tile_directions.h"
#include "reconstruct/normals/tile_doubt.h"
#include "reconstruct/normals/tile_field.h"
#include "reconstruct/normals/tile_sides.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

struct TileNormalsOptions {
  // Place from which all points were measured. Without it the attributes sensor_x, sensor_y,
  // sensor_z are used, if there are all three, with finite values.
  std::optional<Vec3> sensor = {};
  // Number of samples of all tiles for normal orientation (chosen: the memory of a small tile).
  std::uint64_t samples = 200000;
};

// As in OrientReport.
struct TileNormalsReport {
  std::uint64_t points = 0;
  std::uint64_t neighbors = 0;
  std::uint64_t components = 0;    // 0 with sensors
  std::uint64_t undetermined = 0;  // normals that are zero
  std::uint64_t unsure = 0;        // points with a confidence below 0.5
};

// Normal of one point of a tile; all are in the order of the points.
struct TileNormal {
  float x = 0, y = 0, z = 0;
  float confidence = 0;
  Vec3 normal() const { return {x, y, z}; }
};
std::vector<TileNormal> read_normals(const PieceStore& store, std::size_t tile);
// Removes the normals whose flag is set; there is one flag per normal.
void remove_normals(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags);
// Returns true if the store has the normals of all tiles.
bool have_normals(const PieceStore& store);
// Returns how many points each of these normals was fitted to; 0 without them.
std::size_t normal_neighbors(const PieceStore& store);

// Each step is done for all tiles, in any order, before the next step. Steps that an earlier run
// has done cost nothing.
class TileNormals {
 public:
  // `spacings` has the spacing of the points in each tile.
  TileNormals(PieceStore& store, const TilePlan& plan, std::vector<double> spacings,
              const TileNormalsOptions& options);

  // Throws InvalidInput for points on one line, before any work: fits of millions of them would
  // take minutes to find no plane.
  void refuse_points_on_line() const;
  // Chooses the number of neighbours of a fit, from some tiles.
  void choose_neighbors(const Context& context);
  void find_directions(std::size_t tile, const Context& context);
  // Returns true if lines of sight decide: then the next three do nothing. After the directions.
  bool by_sight();
  void find_signs(std::size_t tile, const Context& context);
  void match(std::size_t tile);
  void join(const Context& context);
  // Returns true if the winding number contradicts the signs of some samples, or points are in
  // rows. Then a field that all points share is solved, and taken if it is better.
  bool wants_field() const;
  TileField field() const;
  DoubtScene doubt_scene() const;
  void take(TileField field, const Context& context);
  void turn(std::size_t tile, const Context& context);
  // Returns the result. Throws InvalidInput if no point has a normal.
  TileNormalsReport report() const;
  // Says that all is there, and removes what is no longer needed.
  void finish(const TileNormalsReport& report);

 private:
  BareTile load(std::size_t tile, double reach, const Context& context) const;
  std::uint64_t points_per_sample() const;
  void turn_by_sight(std::size_t tile, const Context& context);
  void turn_by_sides(std::size_t tile);
  void turn_by_field(std::size_t tile);

  PieceStore& store_;
  const TilePlan& plan_;
  std::vector<double> spacings_;
  TileNormalsOptions options_;
  std::uint64_t n_points_ = 0;
  int n_neighbors_ = 0;
  std::optional<bool> by_sight_ = {};
  JoinedSides sides_ = {};
  std::optional<TileField> field_ = {};
  std::unique_ptr<PointTree> samples_ = {};
};

// Returns the costs of orient_tiles() where no field is solved.
std::vector<StageCost> costs_of_normals();

// Does all steps; a step whose result the store has is skipped.
TileNormalsReport orient_tiles(PieceStore& store, const TilePlan& plan,
                               const std::vector<double>& spacings,
                               const TileNormalsOptions& options, Stages& stages);

}  // namespace rholm
