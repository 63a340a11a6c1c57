// Surfaces from points: the whole way. Layer: model.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rholm/atlas.h"
#include "rholm/compress.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/points.h"
#include "rholm/simplify.h"
#include "rholm/surface_rules.h"

namespace rholm {

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
  // by align_scans().
  bool keep_scans = false;
  // The vertices get an attribute `confidence`, 0 ... 1, instead of any of that name: how sure the
  // signs of the normals are that were computed, less where no points are near (0 from four
  // spacings on) and where an opposite sheet is nearer than three spacings.
  bool confidence = false;
  std::optional<SimplifyOptions> simplify = {};   // fewer triangles for the same surface
  std::size_t max_memory = std::size_t{8} << 30;  // bytes: refused if more is foreseen
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
  field(&O::max_memory, {.name = "max_memory",
                         .help = "refused if more memory is foreseen",
                         .value = "BYTES",
                         .unit = FieldUnit::kBytes,
                         .changes_result = false,
                         .in_program = false});
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
  std::size_t memory = 0;  // foreseen for points, grid and surface, bytes
  StageTimes times;        // "points", "caps", "surface", "attributes"
};

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
// 16 different points, options out of range and points that no closed surface goes with,
// OutOfMemory if more than allowed would be needed (with the step that would do). Same input, same
// bits for any number of threads.
Reconstruction reconstruct(PointCloud cloud, const ReconstructOptions& options = {},
                           const Context& context = {});

}  // namespace rholm
