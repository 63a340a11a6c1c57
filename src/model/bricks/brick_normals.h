// Normals for points in bricks, as orient() finds them. Layer: model, private.
//
// Of each brick "directions/BRICK" and "signs/BRICK" hold what it knows by itself, "votes/BRICK"
// how far that agrees with others, and "normals/BRICK" what comes of it: normals that point out of
// the solid, and how sure their signs are. Points that were measured from known places need the
// first and the last only. The piece "oriented" says that all is there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_directions.h"
#include "model/bricks/brick_doubt.h"
#include "model/bricks/brick_field.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_sides.h"
#include "model/bricks/brick_stages.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

struct BrickNormalsOptions {
  // All points were measured from here; with none, from the attributes sensor_x, sensor_y,
  // sensor_z, if there are all three, of finite values.
  std::optional<Vec3> sensor = {};
  // Of all bricks together: sides are found from so many (chosen: the memory of a small brick).
  std::uint64_t samples = 200000;
};

// As in OrientReport.
struct BrickNormalsReport {
  std::uint64_t points = 0;
  std::uint64_t neighbors = 0;
  std::uint64_t components = 0;    // 0 with sensors
  std::uint64_t undetermined = 0;  // normals that are zero
  std::uint64_t unsure = 0;        // points with a confidence below 0.5
};

// What there is of the points of one brick, in their order.
struct BrickNormal {
  float x = 0, y = 0, z = 0;
  float confidence = 0;
  Vec3 normal() const { return {x, y, z}; }
};
std::vector<BrickNormal> read_normals(const PieceStore& store, std::size_t brick);
// Writes them anew without those whose flag is set; one flag each.
void remove_normals(PieceStore& store, std::size_t brick, const std::vector<std::uint8_t>& flags);
// Whether bricks have normals of this kind.
bool have_normals(const PieceStore& store);

// Each step for all bricks, in any order, before the next one; steps that have been done by a run
// before cost nothing.
class BrickNormals {
 public:
  // `spacings` of the points in each brick.
  BrickNormals(PieceStore& store, const BrickPlan& plan, std::vector<double> spacings,
               const BrickNormalsOptions& options);

  // Throws InvalidInput for points on one line, before any work: fits of millions of them would
  // take minutes to find no plane.
  void refuse_points_on_line() const;
  // Neighbours of a fit, from some bricks.
  void choose_neighbors(const Context& context);
  void find_directions(std::size_t brick, const Context& context);
  // Whether lines of sight decide: then the next three have nothing to do. After the directions.
  bool by_sight();
  void find_signs(std::size_t brick, const Context& context);
  void match(std::size_t brick);
  void join(const Context& context);
  // Whether the winding number contradicts the signs of some samples, or points are in rows: then a
  // field that all points share may know better, and is taken if it does.
  bool wants_field() const;
  BrickField field() const;
  DoubtScene doubt_scene() const;
  void take(BrickField field, const Context& context);
  void turn(std::size_t brick, const Context& context);
  // What came of it. Throws InvalidInput if no point has a normal.
  BrickNormalsReport report() const;
  // Says that all is there, and removes what is no longer needed.
  void finish(const BrickNormalsReport& report);

 private:
  BareBrick load(std::size_t brick, double reach, const Context& context) const;
  std::uint64_t points_per_sample() const;
  void turn_by_sight(std::size_t brick, const Context& context);
  void turn_by_sides(std::size_t brick);
  void turn_by_field(std::size_t brick);

  PieceStore& store_;
  const BrickPlan& plan_;
  std::vector<double> spacings_;
  BrickNormalsOptions options_;
  std::uint64_t n_points_ = 0;
  int n_neighbors_ = 0;
  std::optional<bool> by_sight_ = {};
  JoinedSides sides_ = {};
  std::optional<BrickField> field_ = {};
  std::unique_ptr<PointTree> samples_ = {};
};

// What orient_bricks() costs, where no field is asked.
std::vector<StageCost> costs_of_normals();

// All steps. Done already where the store has it from a run before.
BrickNormalsReport orient_bricks(PieceStore& store, const BrickPlan& plan,
                                 const std::vector<double>& spacings,
                                 const BrickNormalsOptions& options, BrickStages& stages);

}  // namespace rholm
