// Surfaces from points: the whole way. Layer: reconstruct.
//
// Up to ReconstructOptions::tile_points points are worked on in one piece. More are cut into tiles
// of space by a tree that depends on the points alone. Each tile is reconstructed with the points
// around it, and the parts are one surface, without seams. The surface depends on the points and
// the options only: its bytes are the same for any number of threads, any memory, any folder, and,
// in several tiles, any order of the points (of points at one place the first one's attributes
// count).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/atlas_model.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/points.h"
#include "rholm/simplify.h"
#include "rholm/surface_rules.h"
#include "rholm/topology.h"

namespace rholm {

// Points of a tile at most, by default: some 1.8 GB of memory on two threads.
inline constexpr std::uint64_t kTilePoints = std::uint64_t{1} << 20;

// What a reconstruction in tiles will take, bytes.
struct TileForecast {
  std::uint64_t points = 0;   // that are finite, and no far strays
  std::uint64_t tiles = 0;    // that space is cut into
  std::uint64_t memory = 0;   // beside what is stored: of a tile, or, if more, of a rough body's
                              // handles in all
  std::uint64_t stored = 0;   // between the steps, in a folder or in memory
  std::uint64_t written = 0;  // the surface as a file
};

// Its list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<TileForecast>, const Visitor& field) {
  using F = TileForecast;
  field(&F::points, {.name = "points", .help = "that are finite, and no far strays"});
  field(&F::tiles, {.name = "tiles", .help = "that space is cut into"});
  field(&F::memory, {.name = "memory", .help = "bytes, beside what is stored"});
  field(&F::stored,
        {.name = "stored",
         .help = "bytes between the steps, in a folder, or in memory if there is room for them"});
  field(&F::written, {.name = "written", .help = "bytes of the surface as a file"});
}

// About; attributes of the points are not counted. Throws InvalidInput for tile_points that
// ReconstructOptions cannot have.
TileForecast foresee_tiles(std::uint64_t points, std::uint64_t tile_points = kTilePoints);

// What is wanted of the surface; by default the data decide.
struct ReconstructOptions {
  // Edge of the grid's cubes, in the unit of the points; 0: from their spacing and their noise.
  double step = 0;
  // Caps grow while their points fit to within this rms distance, in the unit of the points; 0: as
  // exact as the points are.
  double tolerance = 0;
  std::optional<double> noise = {};      // standard deviation of the points; estimated if not given
  HolePolicy holes = HolePolicy::kFill;  // where points are missing
  CapBlend blend = CapBlend::kSmooth;    // kSpline: the paper's weights, for comparison
  // Parts of the surface with less than this share of the largest one's area are dropped.
  double min_component = 0.01;
  // Points that belong to no surface stay; else those are removed that are far from all others, at
  // any distance, and where there are such those near the surface with normals or heights of their
  // own.
  bool keep_outliers = false;
  // All points have been measured from here; without, attributes sensor_x, sensor_y, sensor_z of
  // the cloud say where each was, if there are all three, of finite values. Computed normals then
  // point to their sensors, and holes are not closed across what has been seen to be empty: what
  // lines of sight go through.
  std::optional<Vec3> sensor = {};
  // Points with an attribute `scan` stay where they are; else the scans are brought together first,
  // by align_scans(); those of several tiles by the motions of a sample of at most tile_points.
  bool keep_scans = false;
  // The vertices get an attribute `confidence`, 0 ... 1, instead of any of that name: how sure the
  // signs of the normals are that were computed, less where no points are near (0 from four
  // spacings on) and where an opposite sheet is nearer than three spacings.
  bool confidence = false;
  std::optional<SimplifyOptions> simplify = {};  // fewer triangles for the same surface
  // More points than that are cut into tiles of at most so many, 1000 ... 2^28: fewer take less
  // memory and more time. The surface of other tiles is another one, as good.
  std::uint64_t tile_points = kTilePoints;
  // Bytes: what needs more is refused, with the tile_points or the step that would do. It never
  // changes the surface.
  std::size_t max_memory = std::size_t{8} << 30;
  // A binary PLY to write the surface to, which appears when it is complete. Then neither the
  // surface nor its caps have to fit into memory, and Reconstruction has its report only.
  std::filesystem::path output = {};
  // A model file of all caps to write as well, as write_atlas() makes it; they must fit into
  // memory.
  std::filesystem::path model = {};
  // Folder in which tiles are kept meanwhile, if memory has no room for them; by default that of
  // the system's temporary files.
  std::filesystem::path work_dir = {};
  // What is done in several tiles is kept in the folder OUTPUT.tiles of work_dir until the surface
  // is complete: the same call goes on from there after a run that ended early. Needs `output`.
  bool resume = false;
  // Called before the work on several tiles, once the points have been counted.
  std::function<void(const TileForecast& forecast)> foreseen = {};
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ReconstructOptions>, const Visitor& field) {
  using O = ReconstructOptions;
  field(&O::step, {.name = "step",
                   .help = "edge of the grid's cubes; 0: from the spacing and the noise of the "
                           "points",
                   .value = "H",
                   .least = 0,
                   .unit = FieldUnit::kLength,
                   .in_program = false});
  field(&O::tolerance, {.name = "tolerance",
                        .help = "larger caps and a coarser surface, within this rms distance of "
                                "the points; 0: as exact as the points are",
                        .value = "E",
                        .least = 0,
                        .unit = FieldUnit::kLength});
  field(&O::noise, {.name = "noise",
                    .help = "standard deviation of the points; estimated if not given",
                    .value = "SIGMA",
                    .least = 0,
                    .unit = FieldUnit::kLength});
  field(&O::holes, {.name = "holes",
                    .help = "fill: close places without points smoothly; keep: cut them open"});
  field(&O::blend,
        {.name = "blend",
         .help = "weights of caps that overlap; spline: the paper's quadratic B-spline"});
  field(&O::min_component, {.name = "min_component",
                            .help = "parts of the surface with less than this share of the "
                                    "largest one's area are dropped",
                            .value = "SHARE",
                            .least = 0,
                            .most = 1});
  field(&O::keep_outliers, {.name = "keep_outliers",
                            .help = "points that belong to no surface stay; else they are looked "
                                    "for and removed"});
  field(&O::sensor, {.name = "sensor",
                     .help = "all points have been measured from here (without, attributes "
                             "sensor_x, sensor_y, sensor_z say where each was): computed normals "
                             "point there, and holes are not closed across what lines of sight go "
                             "through",
                     .value = "X,Y,Z"});
  field(&O::keep_scans, {.name = "keep_scans",
                         .help = "points with an attribute scan stay where they are; else the "
                                 "scans are brought together first"});
  field(&O::confidence, {.name = "confidence",
                         .help = "the vertices get an attribute confidence, 0 ... 1: less where "
                                 "signs of computed normals are unsure, far from data, and where "
                                 "the surface is thin"});
  field(&O::simplify, {.name = "simplify",
                       .help = "fewer triangles for the same surface: so many, a share of them, "
                               "or as few as hardly change it (auto); all by default",
                       .value = "auto|N|P%|none"});
  field(&O::tile_points, {.name = "tile_points",
                          .help = "more points than that are cut into tiles of at most so many, "
                                  "worked on one after the other; fewer take less memory and more "
                                  "time",
                          .value = "N",
                          .least = 1000,
                          .most = 1 << 28});
  field(&O::max_memory, {.name = "max_memory",
                         .help = "what needs more memory is refused, with the tile_points or the "
                                 "step that would do; it never changes the surface",
                         .value = "BYTES",
                         .unit = FieldUnit::kBytes,
                         .changes_result = false,
                         .in_program = false});
  field(&O::output, {.name = "output",
                     .help = "binary PLY to write the surface to, which then need not fit into "
                             "memory",
                     .value = "FILE",
                     .changes_result = false,
                     .in_program = false});
  field(&O::model, {.name = "model",
                    .help = "model file of all caps to write as well",
                    .value = "FILE",
                    .changes_result = false,
                    .in_program = false});
  field(&O::work_dir,
        {.name = "work_dir",
         .help = "folder in which tiles are kept meanwhile, if memory has no room for "
                 "them; by default that of the system's temporary files",
         .value = "DIR",
         .changes_result = false,
         .in_program = false});
  field(&O::resume, {.name = "resume",
                     .help = "keep what is done of several tiles, in a folder with the name of the "
                             "output, if the work ends early, and take up what is there",
                     .changes_result = false});
}

// What was found in the points, and what became of them. Lengths are in their unit.
struct ReconstructReport {
  std::size_t points = 0;          // given, with those that add_dropped() adds
  std::size_t dropped_points = 0;  // not finite, at the place of another, without a normal
  std::size_t outliers = 0;        // removed
  ScanAlignment scans;             // what became of them, if there are any
  double unsure = 0;              // share of the points the sign of whose computed normal is unsure
  bool computed_normals = false;  // the points had none, or given ones that were replaced
  bool turned_normals = false;    // all given ones: they agreed, and pointed into the solid
  // Given normals that contradicted those around them, or the winding number of all, and were
  // turned.
  std::size_t mended_normals = 0;
  // Share of given normals more than 45 degrees off the normal of the plane of their neighbours.
  // Above kMostCrooked all of them are computed instead.
  double crooked_normals = 0;
  // Points whose normals contradict those around them, where turning some does not help.
  std::size_t contradicting_normals = 0;
  std::vector<Vec3> contradictions = {};  // the first three of these points
  // Length of the lines along which sheets of the points cross each other, in diagonals of the
  // points: an estimate. Not looked for, and 0, where points are noisier than 1.4 % of the
  // diagonal.
  double crossing_length = 0;
  std::vector<Vec3> crossings = {};  // up to three points near these lines
  // Share of the points that lie off the surface: the rms distance of the 32 points around from it
  // is more than 1/5.5 of the distance to the opposite wall, so that points fill the body, or their
  // noise hides how thick it is; or more than half a spacing, and all points are spread evenly
  // across the surface, as noise is not. About 200 points are asked, or 67 if few of
  // these are off, before it is simplified.
  double points_off_surface = 0;
  std::vector<Vec3> places_off_surface = {};  // up to three of these points
  // Share of the points at which the winding number of all points says that the given normal,
  // which is kept, points into the solid.
  double inward_normals = 0;
  double spacing = 0;  // median distance between neighbours, as if on a square grid
  double noise = 0;    // standard deviation along the normal, 0 if within the shape's own
  double normal_noise_degrees = 0;     // of the normals against the surface
  std::size_t neighbours = 0;          // points of a typical cap
  std::size_t caps = 0;                // of the atlas
  double step = 0;                     // edge of the grid's cubes
  std::size_t holes = 0;               // places without points that were closed, or cut out
  std::size_t smooth_holes = 0;        // of those closed, by a surface that continues the rim
  std::size_t cut_handles = 0;         // bridges and tunnels smaller than points can tell
  std::size_t dropped_components = 0;  // parts of the surface that were too small
  std::size_t faces = 0;               // of the surface before it was simplified
  double simplify_error = 0;           // by simplify(), as Simplification::error
  // Of the surface; of what of it closes holes; and what the points stand for, by the circles of
  // their neighbours. The first without the second is about the third, unless the points contradict
  // each other: scans that are off, double walls.
  double area = 0, closed_area = 0, points_area = 0;
  double volume = 0;  // signed, of the surface: negative if its normals point inwards
  // With the option `confidence`, shares of the surface's area: without data nearer than three
  // spacings, thinner than one and a half, and with a confidence below 1/2.
  double unseen_area = 0, thin_area = 0, unsure_area = 0;
  std::size_t memory = 0;    // foreseen for points, grid and surface, bytes
  StageTimes times;          // "points", "caps", "surface", "attributes"; of tiles "survey", ...
  Bounds bounds = {};        // of the points that are finite; of several tiles without far strays
  std::uint64_t tiles = 1;   // that space was cut into
  std::uint64_t stored = 0;  // bytes between the steps of tiles, at most at a time
  std::uint64_t vertices = 0, triangles = 0;  // of the surface
  std::uint64_t coefficients = 0;             // of all caps
  std::vector<std::string> warnings = {};     // of the file that the points were read from
};

// Its list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ReconstructReport>, const Visitor& field) {
  using R = ReconstructReport;
  field(&R::points, {.name = "points", .help = "number of points given"});
  field(&R::dropped_points, {.name = "dropped_points",
                             .help = "not finite, at the place of another, without a normal"});
  field(&R::outliers, {.name = "outliers", .help = "points removed"});
  field(&R::computed_normals, {.name = "computed_normals",
                               .help = "whether the points had none, or given ones were replaced"});
  field(&R::scans, {.name = "scans", .help = "what became of scans, if there are any"});
  field(&R::unsure, {.name = "unsure",
                     .help = "share of the points the sign of whose computed normal is unsure"});
  field(&R::turned_normals,
        {.name = "turned_normals", .help = "whether all pointed into the solid, and were turned"});
  field(&R::mended_normals,
        {.name = "mended_normals",
         .help = "given normals that contradicted those around them, and were turned"});
  field(&R::crooked_normals, {.name = "crooked_normals",
                              .help = "share of given normals more than 45 degrees off the "
                                      "surface; above 0.25 all are computed instead"});
  field(
      &R::contradicting_normals,
      {.name = "contradicting_normals",
       .help =
           "points whose normals contradict those around them, where turning does not help: above "
           "half the square root of the number of points the surface should not be trusted"});
  field(&R::contradictions,
        {.name = "contradictions", .help = "the first three of these points, n x 3"});
  field(&R::crossing_length,
        {.name = "crossing_length",
         .help = "length of the lines along which sheets of the points cross, in diagonals of the "
                 "points: above 0.12 the surface should not be trusted"});
  field(&R::crossings,
        {.name = "crossings", .help = "the first three points near these lines, n x 3"});
  field(&R::points_off_surface,
        {.name = "points_off_surface",
         .help = "share of the points that fill what lies between the walls of the surface, or "
                 "around it: above 0.5 the surface should not be trusted"});
  field(&R::places_off_surface,
        {.name = "places_off_surface", .help = "up to three of these points, n x 3"});
  field(&R::inward_normals,
        {.name = "inward_normals",
         .help = "share of the points at which the winding number contradicts the given normal: "
                 "above 0.1 the surface should not be trusted"});
  field(&R::spacing,
        {.name = "spacing", .help = "median distance between neighbours, as if on a square grid"});
  field(&R::noise, {.name = "noise", .help = "standard deviation along the normal"});
  field(&R::normal_noise_degrees,
        {.name = "normal_noise_degrees", .help = "of the normals against the surface"});
  field(&R::neighbours, {.name = "neighbours", .help = "points of a typical cap"});
  field(&R::caps, {.name = "caps", .help = "of the atlas"});
  field(&R::step, {.name = "step", .help = "edge of the grid's cubes"});
  field(&R::holes, {.name = "holes", .help = "places without points that were closed, or cut out"});
  field(&R::smooth_holes,
        {.name = "smooth_holes", .help = "of those closed, by a surface that continues the rim"});
  field(&R::cut_handles,
        {.name = "cut_handles",
         .help = "bridges and tunnels of the surface that were smaller than points can tell"});
  field(&R::dropped_components,
        {.name = "dropped_components", .help = "parts of the surface that were too small"});
  field(&R::faces, {.name = "faces", .help = "of the surface before it was simplified"});
  field(&R::simplify_error, {.name = "simplify_error", .help = "by simplify()"});
  field(&R::area, {.name = "area", .help = "of the surface"});
  field(&R::closed_area, {.name = "closed_area", .help = "of it, what closes holes"});
  field(&R::points_area, {.name = "points_area",
                          .help = "that the points stand for, by the circles of their neighbours"});
  field(&R::volume, {.name = "volume",
                     .help = "signed, of the surface: negative if its normals point inwards"});
  field(&R::unseen_area, {.name = "unseen_area",
                          .help = "of the surface, if confidence is asked for: share of the area "
                                  "without data nearer than three spacings"});
  field(&R::thin_area, {.name = "thin_area",
                        .help = "of the surface, if confidence is asked for: share of the area "
                                "thinner than one and a half spacings"});
  field(&R::unsure_area, {.name = "unsure_area",
                          .help = "of the surface, if confidence is asked for: share of the area "
                                  "with a confidence below 1/2"});
  field(&R::memory, {.name = "memory", .help = "foreseen, bytes"});
  field(&R::times, {.name = "times", .help = "stages: (wall, cpu) in seconds"});
  field(&R::bounds,
        {.name = "bounds",
         .help = "the box of the points that are finite; of several tiles without far strays"});
  field(&R::tiles, {.name = "tiles", .help = "number that space was cut into"});
  field(&R::stored,
        {.name = "stored", .help = "bytes between the steps of several tiles, at most at a time"});
  field(&R::vertices, {.name = "vertices", .help = "number of them, of the surface"});
  field(&R::triangles, {.name = "triangles", .help = "number of them, of the surface"});
  field(&R::coefficients, {.name = "coefficients", .help = "number of those of all caps"});
  field(&R::warnings,
        {.name = "warnings", .help = "of the file that the points were read from, list of str"});
}

// Adds n points to a report that the reader of their file dropped before (ShapeFile::dropped).
void add_dropped(std::size_t n, ReconstructReport& report);

// Share of given normals that are not perpendicular to the surface, above which none is believed:
// fewer are those of outliers.
inline constexpr double kMostCrooked = 0.25;
// Of n points, contradicting_normals above this times sqrt(n), and inward_normals above the second:
// a surface made of them should not be trusted. Measured by tests/cli/clouds_test.py.
inline constexpr double kMostContradicting = 0.5;
inline constexpr double kMostInward = 0.1;  // the second
// The same of crossing_length (chosen). Bodies have at most 0.03, and sheets that cross 0.2 and
// more but for 3 of 24 clouds, which are noisy (tests/cli/clouds_test.py --crossings).
inline constexpr double kMostCrossing = 0.12;
// The same of points_off_surface. Real shapes with noise of 1 % of the diagonal have up to 0.46,
// points that fill slabs and rods 0.52 and more (tests/cli/clouds_test.py --walls).
inline constexpr double kMostOffSurface = 0.5;

// Parts of points_area: a surface that has less or more of it, without what closes holes, should
// not be trusted. Of clean bodies it is 0.6 ... 1.4 with a thousand points and 0.9 ... 1.2 with
// more, of noisy ones 0.8 and more, of two walls a few spacings apart 0 ... 0.3
// (scripts/scan-limits --walls).
inline constexpr double kLeastArea = 0.5;
// The same, for more.
inline constexpr double kMostArea = 1.6;

// A surface, its caps, and how they were found.
struct Reconstruction {
  // With ReconstructOptions::output the mesh and the model are left empty.
  Mesh mesh;  // closed and oriented outwards (open with HolePolicy::kKeep), with normals nx, ny, nz
  // The caps that the mesh was extracted from. synthesize() makes the same mesh of it, without the
  // attributes of the points (SurfaceRules::left_out).
  AtlasModel model;
  ReconstructReport report;  // what happened on the way
};

// Points with normals that point outwards to a surface. Normals have any length; they are computed
// by orient() if there are none. If they point into a solid that the points lie all around, all are
// turned. If some contradict those around them, these are turned. The report says what was done.
// Attributes of the points are carried over, averaged over the nearest ones that have a finite
// value and rounded to their type; not a number where none has. Throws InvalidInput for fewer than
// 16 different points, options out of range, points that no closed surface goes with, and a folder
// to resume from that has other files, or what a run with another input or other options has left;
// OutOfMemory if more than allowed would be needed (with the tile_points or the step that would
// do); Io if the output cannot be written, a disk has not the room that is foreseen, or another
// process works in the folder; Unsupported for an output that is named as another format.
Reconstruction reconstruct(const PointCloud& cloud, const ReconstructOptions& options = {},
                           const Context& context = {});
// The same, without a copy of the points.
Reconstruction reconstruct(PointCloud&& cloud, const ReconstructOptions& options = {},
                           const Context& context = {});
// The same of the points of a file. Those that PointStream reads, binary and text PLY and lines of
// numbers, are read in portions if they are more than a tile; a mesh and any other format as a
// whole, and of a mesh the vertices, with the mean normals of their faces. `columns` is as in
// ShapeReadOptions. Throws as read_shape() and PointStream do, too.
Reconstruction reconstruct(const std::filesystem::path& points,
                           const ReconstructOptions& options = {}, const Context& context = {},
                           const std::string& columns = {});

}  // namespace rholm
