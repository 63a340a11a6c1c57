// Surfaces from more points than fit into memory: brick by brick. Layer: model.
//
// Space is cut into bricks by a tree that depends on the points alone, each brick is reconstructed
// by itself with the points around it, and the parts are one closed surface, without seams: the
// same bytes for any number of threads, any memory and any order of the points, but for attributes
// of points at one place, of which the first in the file counts. What is known between the steps is
// kept in a folder, where a run that was interrupted is taken up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"

namespace rholm {

// Points of a brick at most, by default: some 1.8 GB of memory on two threads. More points than
// that are better reconstructed in bricks.
inline constexpr std::uint64_t kBrickPoints = std::uint64_t{1} << 20;

// What it will take, bytes.
struct BrickForecast {
  std::uint64_t points = 0;   // that are finite, and no far strays
  std::uint64_t bricks = 0;   // that space is cut into
  std::uint64_t memory = 0;   // beside what is stored: of a brick, or, if more, of a rough body's
                              // handles in all
  std::uint64_t stored = 0;   // in the folder, or in memory if there is none
  std::uint64_t written = 0;  // the surface
};
// About; attributes of the points are not counted. Throws InvalidInput for points_per_brick that
// BrickOptions cannot have.
BrickForecast foresee_bricks(std::uint64_t points, std::uint64_t points_per_brick = kBrickPoints);

// Bytes of ReconstructOptions::max_memory that are enough, beside what is stored in memory: with
// what runs have taken beyond their forecast. A refusal names them. Throws as foresee_bricks()
// does.
std::uint64_t enough_for_bricks(std::uint64_t points, std::uint64_t points_per_brick);

// How the points are cut, and where what is not in memory goes.
struct BrickOptions {
  // At most, 1000 ... 2^28; fewer take less memory, more less time.
  std::uint64_t points_per_brick = kBrickPoints;
  // For what is known between the steps: a folder that is not there, or is empty, or is that of an
  // earlier run. It is gone at the end. None: in memory.
  std::filesystem::path work_dir = {};
  // Leave the folder where it is if the run ends early, and take up what is there.
  bool resume = false;
  // A model file of all caps, as write_atlas() makes it; none if empty. They must fit into memory.
  std::filesystem::path model = {};
  // Of a file that is a text table, as in ShapeReadOptions.
  std::string columns = {};
  // Called before the work, once the points have been counted.
  std::function<void(const BrickForecast& forecast)> foreseen = {};
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<BrickOptions>, const Visitor& field) {
  using O = BrickOptions;
  field(&O::points_per_brick, {.name = "points_per_brick",
                               .help = "points of a brick at most; fewer take less memory, more "
                                       "less time",
                               .value = "N",
                               .least = 1000,
                               .most = 1 << 28,
                               .in_program = false});
  field(&O::work_dir, {.name = "work_dir",
                       .help = "folder for what is known between the steps; none: in memory",
                       .value = "DIR",
                       .changes_result = false,
                       .in_program = false});
  field(&O::resume, {.name = "resume",
                     .help = "leave the folder where it is if the run ends early, and take up what "
                             "is there",
                     .changes_result = false,
                     .in_program = false});
  field(&O::model, {.name = "model",
                    .help = "model file of all caps to write",
                    .value = "FILE",
                    .changes_result = false,
                    .in_program = false});
  field(&O::columns, {.name = "columns",
                      .help = "what the columns of a text table are",
                      .value = "NAMES",
                      .in_program = false});
}

// What was found, and how much was made.
struct BrickReconstruction {
  ReconstructReport report;                   // its times are those of the stages in bricks
  Bounds bounds;                              // of the points, without far strays
  std::uint64_t bricks = 0;                   // that space was cut into
  std::uint64_t vertices = 0, triangles = 0;  // of the surface
  std::uint64_t coefficients = 0;             // of all caps
  std::uint64_t stored = 0;                   // bytes, at most at a time
  std::vector<std::string> warnings = {};     // of the file
};

// As reconstruct(), of the points of a file that PointStream reads (with no normals of faces: those
// of a mesh's vertices are computed as for any points), to a binary PLY, which appears when it is
// complete. Throws as reconstruct() and PointStream do; OutOfMemory if options.max_memory is too
// little for a brick; Io if the folder's disk has not the room that is foreseen, or another process
// works there; InvalidInput if the folder has other files, or pieces of a run with another input or
// other options; Unsupported if there are several scans, but for options.keep_scans.
BrickReconstruction reconstruct_bricks(const std::filesystem::path& points,
                                       const std::filesystem::path& mesh,
                                       const ReconstructOptions& options = {},
                                       const BrickOptions& bricks = {},
                                       const Context& context = {});
// The same of points in memory; `points` must not change meanwhile.
BrickReconstruction reconstruct_bricks(const PointCloud& points, const std::filesystem::path& mesh,
                                       const ReconstructOptions& options = {},
                                       const BrickOptions& bricks = {},
                                       const Context& context = {});

}  // namespace rholm
