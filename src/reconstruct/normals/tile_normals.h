// Normals for points in tiles, as orient() finds them. Layer: reconstruct, private.
//
// Of each tile "directions/TILE" and "signs/TILE" hold what it knows by itself, "votes/TILE"
// how far that agrees with others, and "normals/TILE" what comes of it: normals that point out of
// the solid, and how sure their signs are. Points that were measured from known places need the
// first and the last only. The piece "oriented" says that all is there.
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
  // All points were measured from here; with none, from the attributes sensor_x, sensor_y,
  // sensor_z, if there are all three, of finite values.
  std::optional<Vec3> sensor = {};
  // Of all tiles together: sides are found from so many (chosen: the memory of a small tile).
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

// What there is of the points of one tile, in their order.
struct TileNormal {
  float x = 0, y = 0, z = 0;
  float confidence = 0;
  Vec3 normal() const { return {x, y, z}; }
};
std::vector<TileNormal> read_normals(const PieceStore& store, std::size_t tile);
// Writes them anew without those whose flag is set; one flag each.
void remove_normals(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& flags);
// Whether tiles have normals of this kind.
bool have_normals(const PieceStore& store);

// Each step for all tiles, in any order, before the next one; steps that have been done by a run
// before cost nothing.
class TileNormals {
 public:
  // `spacings` of the points in each tile.
  TileNormals(PieceStore& store, const TilePlan& plan, std::vector<double> spacings,
              const TileNormalsOptions& options);

  // Throws InvalidInput for points on one line, before any work: fits of millions of them would
  // take minutes to find no plane.
  void refuse_points_on_line() const;
  // Neighbours of a fit, from some tiles.
  void choose_neighbors(const Context& context);
  void find_directions(std::size_t tile, const Context& context);
  // Whether lines of sight decide: then the next three have nothing to do. After the directions.
  bool by_sight();
  void find_signs(std::size_t tile, const Context& context);
  void match(std::size_t tile);
  void join(const Context& context);
  // Whether the winding number contradicts the signs of some samples, or points are in rows: then a
  // field that all points share may know better, and is taken if it does.
  bool wants_field() const;
  TileField field() const;
  DoubtScene doubt_scene() const;
  void take(TileField field, const Context& context);
  void turn(std::size_t tile, const Context& context);
  // What came of it. Throws InvalidInput if no point has a normal.
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

// What orient_tiles() costs, where no field is asked.
std::vector<StageCost> costs_of_normals();

// All steps. Done already where the store has it from a run before.
TileNormalsReport orient_tiles(PieceStore& store, const TilePlan& plan,
                               const std::vector<double>& spacings,
                               const TileNormalsOptions& options, Stages& stages);

}  // namespace rholm
