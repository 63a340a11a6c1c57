// Reconstruction of surfaces from points. Layer: reconstruct.
//
// Space is cut into tiles by a tree that depends on the points alone. Up to
// ReconstructOptions::tile_points points are one tile. Each tile uses the points around it too, and
// the parts join to one surface without seams.
//
// The surface depends on points and options only: its bytes are the same for any number of threads,
// memory and folder. The order of points does not matter either, except at points with the same
// place: the attributes of the first one are used.
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

// Default maximum of points in a tile: about 1.8 GB of memory on two threads.
inline constexpr std::uint64_t kTilePoints = std::uint64_t{1} << 20;

// Resources for a reconstruction in tiles; sizes in bytes.
struct TileForecast {
  std::uint64_t points = 0;   // finite points that are not isolated far away
  std::uint64_t tiles = 0;    // number of tiles
  std::uint64_t memory = 0;   // besides `stored`: of a tile, or if more, of all handles of a rough
                              // body
  std::uint64_t stored = 0;   // between the steps, in a folder or in memory
  std::uint64_t written = 0;  // size of the surface's file
};

// Lists the fields of TileForecast (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<TileForecast>, const Visitor& field) {
  using F = TileForecast;
  field(&F::points,
        {.name = "points", .help = "number of finite points, without points isolated far away"});
  field(&F::tiles, {.name = "tiles", .help = "number of tiles that space is cut into"});
  field(&F::memory, {.name = "memory", .help = "memory in bytes, without the stored bytes"});
  field(
      &F::stored,
      {.name = "stored",
       .help =
           "number of bytes stored between the steps, in a folder, or in memory if there is room"});
  field(&F::written, {.name = "written", .help = "size of the surface's file, in bytes"});
}

// Estimates the resources, without attributes of the points. Throws InvalidInput for tile_points
// out of the range in ReconstructOptions.
TileForecast foresee_tiles(std::uint64_t points, std::uint64_t tile_points = kTilePoints);

// Properties of the surface, and limits. Defaults are chosen from the data.
struct ReconstructOptions {
  // Edge of the grid's cubes, in the unit of the points; 0: from spacing and noise of the points.
  double step = 0;
  // Caps grow as long as their points fit within this rms distance, in the unit of the points. 0:
  // as exact as the points.
  double tolerance = 0;
  std::optional<double> noise = {};      // standard deviation of the points; empty: estimated
  HolePolicy holes = HolePolicy::kFill;  // places without points: close or cut open
  CapBlend blend = CapBlend::kSmooth;    // kSpline: the paper's weights, for comparison
  // Parts of the surface with an area below this share of the largest part's area are dropped.
  double min_component = 0.01;
  // False: isolated points far from all others, at any distance, are removed. If such points exist,
  // points near the surface with deviating normals or heights are removed too. True: all points are
  // kept.
  bool keep_outliers = false;
  // Point from which all points were measured. If empty, attributes
  // sensor_x, sensor_y, sensor_z of the cloud are used if all three exist
  // with finite values. Computed normals point to the sensors, and holes
  // are not closed across space that lines of sight show to be empty.
  std::optional<Vec3> sensor = {};
  // True: points with an attribute `scan` stay in place. False: align_scans() aligns scans first;
  // it finds the motions from a sample of at most tile_points points.
  bool keep_scans = false;
  // Adds a vertex attribute `confidence`, 0 ... 1, in place of an existing one: the confidence of
  // the signs of computed normals. It is reduced far from points (0 from four spacings on) and
  // where an opposite sheet is nearer than three spacings.
  bool confidence = false;
  std::optional<SimplifyOptions> simplify = {};  // reduces the number of triangles
  // Largest number of points in a tile, 1000 ... 2^28. More points are cut into tiles; smaller
  // tiles take less memory and more time, and give another surface of equal accuracy.
  std::uint64_t tile_points = kTilePoints;
  // Bytes. A larger need throws an error that names a sufficient tile_points or step. The limit
  // never changes the surface.
  std::size_t max_memory = std::size_t{8} << 30;
  // Binary PLY file for the surface, which appears when complete. Surface and caps then need not
  // fit into memory, and Reconstruction contains only its report.
  std::filesystem::path output = {};
  // Model file for all caps, written as by
  // write_atlas(). The caps must fit into memory.
  std::filesystem::path model = {};
  // Folder for intermediate tiles that do not fit into memory; by default the system's folder for
  // temporary files.
  std::filesystem::path work_dir = {};
  // Keeps finished work on several tiles in the folder OUTPUT.tiles of work_dir until the surface
  // is complete. After an interruption the same call continues from there. Needs `output`.
  bool resume = false;
  // Called when several tiles are needed, after the points are counted and before the work.
  std::function<void(const TileForecast& forecast)> foreseen = {};
};

// Lists the fields of ReconstructOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ReconstructOptions>, const Visitor& field) {
  using O = ReconstructOptions;
  field(&O::step, {.name = "step",
                   .help = "edge length of the grid's cubes; 0: chosen from the spacing and the "
                           "noise of the points",
                   .value = "H",
                   .least = 0,
                   .unit = FieldUnit::kLength,
                   .in_program = false});
  field(&O::tolerance, {.name = "tolerance",
                        .help = "largest root mean square distance from the points, for larger "
                                "caps and a coarser surface; 0: the accuracy of the points",
                        .value = "E",
                        .least = 0,
                        .unit = FieldUnit::kLength});
  field(&O::noise,
        {.name = "noise",
         .help = "standard deviation of the points; by default estimated from the points",
         .value = "SIGMA",
         .least = 0,
         .unit = FieldUnit::kLength});
  field(&O::holes,
        {.name = "holes",
         .help = "places without points; fill: close them smoothly; keep: cut them open"});
  field(&O::blend, {.name = "blend",
                    .help = "weights of overlapping caps; smooth: a smooth polynomial; spline: the "
                            "paper's quadratic B-spline"});
  field(&O::min_component,
        {.name = "min_component",
         .help =
             "drop parts of the surface whose area is below this share of the largest part's area",
         .value = "SHARE",
         .least = 0,
         .most = 1});
  field(&O::keep_outliers, {.name = "keep_outliers",
                            .help = "keep all points; by default isolated points and outliers near "
                                    "the surface are removed"});
  field(&O::sensor,
        {.name = "sensor",
         .help =
             "point from which all points were measured, by default attributes sensor_x, sensor_y, "
             "sensor_z; computed normals point to it, and no hole is closed across a line of sight",
         .value = "X,Y,Z"});
  field(
      &O::keep_scans,
      {.name = "keep_scans",
       .help =
           "leave points with the attribute 'scan' in place; by default scans are aligned first"});
  field(&O::confidence,
        {.name = "confidence",
         .help = "add the vertex attribute `confidence`, 0 ... 1; it is low where normals are "
                 "unsure, far from points, and where the surface is thin"});
  field(&O::simplify, {.name = "simplify",
                       .help = "reduce the faces: to as few as hardly change the surface (auto), a "
                               "number, or a share of them; by default all faces stay",
                       .value = "auto|N|P%|none"});
  field(&O::tile_points, {.name = "tile_points",
                          .help = "largest number of points in a tile; more points are cut into "
                                  "tiles; smaller tiles take less memory and more time",
                          .value = "N",
                          .least = 1000,
                          .most = 1 << 28});
  field(&O::max_memory, {.name = "max_memory",
                         .help = "largest memory, which never changes the surface; if it is too "
                                 "small, the error names a sufficient tile_points or step",
                         .value = "BYTES",
                         .unit = FieldUnit::kBytes,
                         .changes_result = false,
                         .in_program = false});
  field(&O::output, {.name = "output",
                     .help = "binary PLY file for the surface, which then need not fit into memory",
                     .value = "FILE",
                     .changes_result = false,
                     .in_program = false});
  field(&O::model, {.name = "model",
                    .help = "model file to write all caps to",
                    .value = "FILE",
                    .changes_result = false,
                    .in_program = false});
  field(&O::work_dir, {.name = "work_dir",
                       .help = "folder for tiles that do not fit into memory; by default the "
                               "system's folder for temporary files",
                       .value = "DIR",
                       .changes_result = false,
                       .in_program = false});
  field(&O::resume, {.name = "resume",
                     .help = "keep finished work on tiles in a folder named after the output, and "
                             "continue from work found there",
                     .changes_result = false});
}

// Findings of reconstruct(), and changes to the points. Lengths are in the unit of the points.
struct ReconstructReport {
  std::size_t points = 0;          // number of points given, with add_dropped()
  std::size_t dropped_points = 0;  // not finite, duplicate, or without a normal
  std::size_t outliers = 0;        // number of removed outliers
  ScanAlignment scans;             // alignment of the scans, if there are any
  double unsure = 0;               // share of points whose computed normal has an unsure sign
  bool computed_normals = false;   // the points had no normals, or they were replaced
  bool turned_normals = false;     // all given normals were consistent but inward
  // Given normals that contradicted their neighbours, or the winding number of all points, and were
  // turned.
  std::size_t mended_normals = 0;
  // Share of given normals at more than 45 degrees to the normal of the plane of their neighbours.
  // Above kMostCrooked all normals are computed instead.
  double crooked_normals = 0;
  // Points whose normals contradict their neighbours, where turning normals does not help.
  std::size_t contradicting_normals = 0;
  std::vector<Vec3> contradictions = {};  // the first three of these points
  // Estimated length of the lines along which sheets of the points cross. Its unit is the diagonal
  // of the points. It is 0, and not searched for, where points are noisier than 1.4 % of the
  // diagonal.
  double crossing_length = 0;
  std::vector<Vec3> crossings = {};  // up to three points near these lines
  // Share of points off the surface: the 32 points around have a large rms distance from the
  // surface. It exceeds 1/5.5 of the distance to the opposite wall: points fill the body, or noise
  // hides its thickness. Another case is an rms distance above half a spacing, with all points
  // spread evenly across the surface, unlike noise. Tested at about 200 points, or 67 if only some
  // are off, before simplification.
  double points_off_surface = 0;
  std::vector<Vec3> places_off_surface = {};  // up to three of these points
  // Share of points at which the winding number of all points says that the given normal, which is
  // kept, points into the solid.
  double inward_normals = 0;
  double spacing = 0;  // median distance of neighbours, as on a square grid
  double noise = 0;    // standard deviation along the normal; 0 if within the shape's own variation
  double normal_noise_degrees = 0;     // angle of normals against the surface
  std::size_t neighbours = 0;          // number of points of a typical cap
  std::size_t caps = 0;                // number of caps of the atlas
  double step = 0;                     // edge of the grid's cubes
  std::size_t holes = 0;               // closed or cut out places without points
  std::size_t smooth_holes = 0;        // holes closed by a surface that continues the rim
  std::size_t cut_handles = 0;         // bridges and tunnels too small for the points
  std::size_t dropped_components = 0;  // number of parts of the surface that were too small
  std::size_t full_faces = 0;          // number, before simplification
  double simplify_error = 0;           // Simplification::error of simplify()
  // Area of the surface, area of its parts that close holes, and area represented by the points, by
  // the circles of their neighbours. The first minus the second is about the third, unless the
  // points contradict each other: misaligned scans, double walls.
  double area = 0, closed_area = 0, points_area = 0;
  double volume = 0;  // signed: negative if the surface's normals point inwards
  // Shares of the surface's area, with the option `confidence`: without data within three spacings,
  // thinner than one and a half spacings, and with a confidence below 1/2.
  double unseen_area = 0, thin_area = 0, unsure_area = 0;
  std::size_t memory = 0;                  // estimate for points, grid and surface, bytes
  StageTimes times;                        // "survey", ..., "caps", ..., "surface", "attributes"
  Bounds bounds = {};                      // box of finite points without far isolated points
  std::uint64_t tiles = 1;                 // number of tiles
  std::uint64_t stored = 0;                // largest amount of bytes stored between steps of tiles
  std::uint64_t vertices = 0, faces = 0;   // numbers, of the surface
  std::uint64_t coefficients = 0;          // number, in all caps
  std::vector<std::string> warnings = {};  // warnings of the reader of the points' file
};

// Lists the fields of ReconstructReport (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<ReconstructReport>, const Visitor& field) {
  using R = ReconstructReport;
  field(&R::points, {.name = "points", .help = "number of given points"});
  field(&R::dropped_points, {.name = "dropped_points",
                             .help = "number of points dropped: not finite, at the position of "
                                     "another point, or without a normal"});
  field(&R::outliers, {.name = "outliers", .help = "number of removed outliers"});
  field(
      &R::computed_normals,
      {.name = "computed_normals",
       .help = "true if all normals were computed, because there were none or they were replaced"});
  field(&R::scans,
        {.name = "scans", .help = "report on the alignment of the scans, if there are any"});
  field(&R::unsure,
        {.name = "unsure", .help = "share of the points whose computed normal has an unsure sign"});
  field(&R::turned_normals,
        {.name = "turned_normals",
         .help = "true if all given normals pointed into the solid and were turned"});
  field(
      &R::mended_normals,
      {.name = "mended_normals",
       .help = "number of given normals that contradicted the points around them and were turned"});
  field(&R::crooked_normals, {.name = "crooked_normals",
                              .help = "share of given normals more than 45 degrees off the "
                                      "surface; above 0.25 all normals are computed instead"});
  field(&R::contradicting_normals,
        {.name = "contradicting_normals",
         .help = "number of points whose normals contradict their neighbours even if turned; above "
                 "half the square root of the number of points the surface is unreliable"});
  field(&R::contradictions,
        {.name = "contradictions",
         .help = "up to three points whose normals contradict their neighbours, n x 3"});
  field(&R::crossing_length,
        {.name = "crossing_length",
         .help = "length of the lines where sheets of the points cross, in diagonals of the "
                 "points; above 0.12 the surface is unreliable"});
  field(&R::crossings,
        {.name = "crossings",
         .help = "up to three points near the lines where sheets of the points cross, n x 3"});
  field(&R::points_off_surface,
        {.name = "points_off_surface",
         .help = "share of the points that lie off the surface, between its walls or around it; "
                 "above 0.5 the surface is unreliable"});
  field(&R::places_off_surface, {.name = "places_off_surface",
                                 .help = "up to three points that lie off the surface, n x 3"});
  field(&R::inward_normals, {.name = "inward_normals",
                             .help = "share of the points whose given normal contradicts the "
                                     "winding number; above 0.1 the surface is unreliable"});
  field(&R::spacing,
        {.name = "spacing", .help = "median distance of neighbouring points, as on a square grid"});
  field(&R::noise, {.name = "noise",
                    .help = "standard deviation of the points along the normal; 0 if it is within "
                            "the shape's own variation"});
  field(&R::normal_noise_degrees,
        {.name = "normal_noise_degrees",
         .help = "noise of the normals relative to the surface, in degrees"});
  field(&R::neighbours, {.name = "neighbours", .help = "number of points of a typical cap"});
  field(&R::caps, {.name = "caps", .help = "number of caps of the atlas"});
  field(&R::step, {.name = "step", .help = "edge length of the grid's cubes"});
  field(&R::holes,
        {.name = "holes", .help = "number of places without points that were closed or cut out"});
  field(&R::smooth_holes, {.name = "smooth_holes",
                           .help = "number of holes closed by a surface that continues the rim"});
  field(
      &R::cut_handles,
      {.name = "cut_handles",
       .help = "number of removed bridges and tunnels that are too small for the points to show"});
  field(&R::dropped_components,
        {.name = "dropped_components",
         .help = "number of parts of the surface dropped because they are too small"});
  field(&R::full_faces,
        {.name = "full_faces", .help = "number of faces of the surface before simplification"});
  field(&R::simplify_error,
        {.name = "simplify_error",
         .help = "error of the simplification, measured as max_error of simplify"});
  field(&R::area, {.name = "area", .help = "area of the surface"});
  field(&R::closed_area,
        {.name = "closed_area", .help = "area of the parts of the surface that close holes"});
  field(&R::points_area,
        {.name = "points_area",
         .help = "area that the points represent, from the circles of their neighbours"});
  field(&R::volume,
        {.name = "volume",
         .help = "signed volume inside the surface; negative if its normals point inwards"});
  field(&R::unseen_area, {.name = "unseen_area",
                          .help = "share of the surface's area without points within three "
                                  "spacings, if confidence is wanted"});
  field(&R::thin_area, {.name = "thin_area",
                        .help = "share of the surface's area thinner than one and a half spacings, "
                                "if confidence is wanted"});
  field(
      &R::unsure_area,
      {.name = "unsure_area",
       .help = "share of the surface's area with a confidence below 1/2, if confidence is wanted"});
  field(&R::memory, {.name = "memory", .help = "estimated memory, in bytes"});
  field(&R::times,
        {.name = "times", .help = "wall and CPU time of each stage, in seconds: (wall, cpu)"});
  field(&R::bounds, {.name = "bounds",
                     .help = "bounding box of the finite points, without points isolated far "
                             "away"});
  field(&R::tiles, {.name = "tiles", .help = "number of tiles that space was cut into"});
  field(&R::stored,
        {.name = "stored",
         .help = "largest number of bytes stored at a time between the steps of several tiles"});
  field(&R::vertices, {.name = "vertices", .help = "number of vertices of the surface"});
  field(&R::faces, {.name = "faces", .help = "number of faces of the surface"});
  field(&R::coefficients, {.name = "coefficients", .help = "number of coefficients of all caps"});
  field(&R::warnings,
        {.name = "warnings", .help = "warnings from reading the file of points, list of str"});
}

// Adds n points to a report that the reader of the file dropped (ShapeFile::dropped).
void add_dropped(std::size_t n, ReconstructReport& report);

// Largest share of given normals that may deviate more than 45 degrees from the surface's normal.
// Above it all normals are replaced; a smaller share is due to outliers.
inline constexpr double kMostCrooked = 0.25;
// Above these limits a surface of n points is unreliable: contradicting_normals / sqrt(n), and
// inward_normals (kMostInward). Measured by tests/cli/clouds_test.py.
inline constexpr double kMostContradicting = 0.5;
inline constexpr double kMostInward = 0.1;  // limit of inward_normals
// Limit of crossing_length (chosen). Bodies have at most 0.03, crossing sheets 0.2 and more, except
// for 3 of 24 clouds, which are noisy (tests/cli/clouds_test.py --crossings).
inline constexpr double kMostCrossing = 0.12;
// Limit of points_off_surface. Real shapes with noise of 1 % of the diagonal have up to 0.46,
// points that fill slabs and rods 0.52 and more (tests/cli/clouds_test.py --walls).
inline constexpr double kMostOffSurface = 0.5;

// Limits of (area - closed_area) / points_area outside of which a surface is unreliable. The ratio
// is 0.6 ... 1.4 for clean bodies of a thousand points and 0.9 ... 1.2 for more points. It is 0.8
// and more for noisy bodies, 0 ... 0.3 for two walls a few spacings apart (scripts/scan-limits
// --walls).
inline constexpr double kLeastArea = 0.5;
// The upper limit of this ratio.
inline constexpr double kMostArea = 1.6;

// A surface, its caps, and the report.
struct Reconstruction {
  // With ReconstructOptions::output the mesh and the model are left empty.
  Mesh mesh;  // closed (open with HolePolicy::kKeep), outward normals nx, ny, nz
  // The caps that the mesh was extracted from. synthesize() makes the same mesh from them, without
  // the attributes of the points (SurfaceRules::left_out).
  AtlasModel model;
  ReconstructReport report;  // findings, counts and times
};

// Reconstructs a surface from points. Normals should point outwards and may have any
// length; orient() computes missing ones. If all point into a solid that the points
// surround, all are turned; single contradicting normals are turned too (see the report).
// Attributes are averaged over the nearest points with finite values and rounded to their
// type; NaN without such points. Throws InvalidInput for fewer than 16 different points,
// options out of range, or points without a fitting closed surface. It is also thrown if
// the folder to resume from has other files, or work of other input or options.
// OutOfMemory: need above the limit (names sufficient tile_points or step). Io: unwritable
// output, too little disk space, or another process in the folder. Unsupported: output
// named as another format.
Reconstruction reconstruct(const PointCloud& cloud, const ReconstructOptions& options = {},
                           const Context& context = {});
// Reconstructs a surface without a copy of the points.
Reconstruction reconstruct(PointCloud&& cloud, const ReconstructOptions& options = {},
                           const Context& context = {});
// Reconstructs a surface from the points of a file. Formats of PointStream (PLY, lines of numbers)
// with more points than a tile are read in portions, other formats and meshes as a whole. A mesh
// contributes vertices with the mean normals of their faces. `columns` is as in ShapeReadOptions.
// Throws also as read_shape() and PointStream.
Reconstruction reconstruct(const std::filesystem::path& points,
                           const ReconstructOptions& options = {}, const Context& context = {},
                           const std::string& columns = {});

}  // namespace rholm
