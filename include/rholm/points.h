// Points without faces: sampling, cleaning, alignment of scans, normals. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

inline constexpr std::size_t kMaxPoints = 100000000;  // about 5 GB of memory: a sanity limit
inline constexpr double kMaxDensityRatio = 1000;      // limits the number of attempts per point

inline constexpr double kMaxPatternRatio = 1000;  // chosen: rows are then isolated
inline constexpr int kMaxScans = 1000;            // a sanity limit

// Arrangement of points on a surface. All but kRandom have rows: steps along a row are smaller.
enum class SamplePattern {
  kRandom,  // independent of each other
  kSlices,  // where planes across the axis cut it, as in a stack of tomograms
  kRings,   // where planes through the axis and the middle cut it, at equal angles
  kLines,   // where rays of each scanner meet it first, row by row
  kGrid,    // where lines that it faces meet it: a grid along the axis, and two across it
};
// Returns the names of patterns, as in option lists.
EnumNames names_of(SamplePattern pattern);  // "random", "slices", "rings", "lines", "grid"

// Sampling and simulated measurement errors. Lengths are fractions of the diagonal of the mesh's
// bounding box.
struct SampleOptions {
  std::size_t points = 100000;  // 1 ... kMaxPoints, before holes; approximate with a pattern
  // Standard deviation of a Gaussian displacement, equal and independent along x, y and z. The
  // distance to a flat surface has the same standard deviation.
  double noise = 0;
  // Standard deviation, in degrees, of the angle between exact and given normals: Gaussian, mean 0.
  // The axis of each normal's rotation lies in the tangent plane and has uniform direction.
  double normal_noise = 0;
  // Share of the points replaced by outliers: floor(share * points), evenly spread over the list.
  // Outliers are uniform in the bounding box grown by 10 %, with normals uniform on the sphere.
  double outliers = 0;
  // Number of holes: balls about uniform points of the surface, in which points are removed last.
  int holes = 0;
  double hole_radius = 0;  // radius of these balls, 0 ... 1
  // The density falls exponentially to 1 / density_ratio along the longest axis of the bounding
  // box, from low to high coordinates; 1 ... kMaxDensityRatio.
  double density_ratio = 1;
  SamplePattern pattern = SamplePattern::kRandom;  // arrangement of the points
  // Step between rows divided by the step along rows, 1 ... kMaxPatternRatio. For rings at their
  // mean distance from the axis, for lines in angles.
  double pattern_ratio = 1;
  Vec3 pattern_axis = {0, 0, 1};  // axis of any length but 0; rows of scanners run across it
  // Number of scanners around the surface, at three times the radius of its bounding ball. Each
  // gets its part of the points, where it sees the surface. 0: no scanners. Otherwise points get
  // the attribute `scan`, 0 ... scans - 1. Allowed for random points and lines.
  int scans = 0;
  // Each scan is moved as a random rigid body. This is the root mean square distance, over all
  // scans, that points of the surface are moved.
  double misalignment = 0;
  // Relative excess of the last scan's noise over the first scan's; other scans lie between.
  double scan_noise = 0;
  bool sensor = false;     // adds attributes sensor_x, sensor_y, sensor_z: each point's scanner
  bool normals = true;     // adds normals
  std::uint64_t seed = 1;  // seed of all random numbers
};

// Lists the fields of SampleOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<SampleOptions>, const Visitor& field) {
  using O = SampleOptions;
  field(&O::points, {.name = "points",
                     .help = "number of points before holes are made; approximate with a pattern",
                     .value = "N",
                     .least = 1,
                     .most = kMaxPoints,
                     .in_python = false});
  field(&O::noise, {.name = "noise",
                    .help = "standard deviation of the noise along x, y and z, as a fraction of "
                            "the bounding box's diagonal",
                    .value = "F",
                    .least = 0,
                    .most = 1});
  field(&O::normal_noise,
        {.name = "normal_noise",
         .help = "standard deviation of the angle between exact and given normals, in degrees",
         .value = "DEG",
         .least = 0,
         .most = 180});
  field(&O::outliers,
        {.name = "outliers",
         .help =
             "share of the points replaced by random points in the bounding box, enlarged by 10 %",
         .value = "F",
         .least = 0,
         .most = 1});
  field(&O::holes,
        {.name = "holes",
         .help = "number of balls about random points of the surface in which points are removed",
         .value = "K",
         .least = 0,
         .in_program = false});
  field(&O::hole_radius, {.name = "hole_radius",
                          .help = "radius of the balls in which points are removed, as a fraction "
                                  "of the bounding box's diagonal",
                          .value = "R",
                          .least = 0,
                          .most = 1,
                          .in_program = false});
  field(&O::density_ratio, {.name = "density_ratio",
                            .help = "ratio of the highest to the lowest density, which falls "
                                    "exponentially along the longest axis",
                            .value = "Q",
                            .least = 1,
                            .most = kMaxDensityRatio});
  field(&O::pattern, {.name = "pattern",
                      .help = "arrangement of the points; random: independent; slices: planes "
                              "across the axis; rings: planes through the axis; lines: rows of "
                              "scanner rays; grid: lines along and across the axis"});
  field(&O::pattern_ratio,
        {.name = "pattern_ratio",
         .help = "step between the rows of a pattern, divided by the step along a row",
         .value = "R",
         .least = 1,
         .most = kMaxPatternRatio});
  field(&O::pattern_axis,
        {.name = "pattern_axis", .help = "direction of the axis of the pattern", .value = "X,Y,Z"});
  field(&O::scans, {.name = "scans",
                    .help = "number of scanners around the surface, each with an equal part of the "
                            "points, where it sees the surface",
                    .value = "K",
                    .least = 0,
                    .most = kMaxScans});
  field(&O::misalignment, {.name = "misalignment",
                           .help = "root mean square displacement of the scans, moved as rigid "
                                   "bodies, as a fraction of the bounding box's diagonal",
                           .value = "F",
                           .least = 0,
                           .most = 1});
  field(&O::scan_noise, {.name = "scan_noise",
                         .help = "relative excess of the last scan's noise over the first scan's "
                                 "noise; the other scans lie between",
                         .value = "F",
                         .least = 0});
  field(
      &O::sensor,
      {.name = "sensor",
       .help =
           "add the position of each point's scanner as attributes sensor_x, sensor_y, sensor_z"});
  field(&O::normals, {.name = "normals", .help = "add normals to the points", .in_program = false});
  field(&O::seed,
        {.name = "seed", .help = "seed of all random numbers", .value = "S", .in_program = false});
}

// Samples points on the surface with the exact normals of their faces: independent random points,
// uniform by area (unless the density falls), or a pattern. Attributes except normals are
// interpolated linearly between the corners of the face, before noise; whole numbers are rounded.
// Outliers get the attributes of another place of the surface. Same mesh and options, same points
// for any number of threads. Throws InvalidInput for a mesh that is invalid or has no area, for
// options that are out of range or incompatible, and if no point is left.
PointCloud sample_surface(const Mesh& mesh, const SampleOptions& options = {},
                          const Context& context = {});

// Counts of clean().
struct CleanReport {
  std::size_t points = 0;            // number of points before
  std::size_t not_finite = 0;        // points dropped: a coordinate is NaN or infinite
  std::size_t duplicates = 0;        // points dropped: at the place of an earlier one
  std::size_t opposite_normals = 0;  // duplicates whose normal opposes the earlier one's
  std::size_t zero_normals = 0;      // remaining points with zero normals, if there are normals
};

// Lists the fields of CleanReport.
template <typename Visitor>
void visit_fields(FieldsOf<CleanReport>, const Visitor& field) {
  using C = CleanReport;
  field(&C::points, {.name = "points", .help = "number of points before cleaning"});
  field(&C::not_finite,
        {.name = "not_finite",
         .help = "number of points dropped because a coordinate is NaN or infinite"});
  field(&C::duplicates,
        {.name = "duplicates",
         .help = "number of points dropped because an earlier point has the same position"});
  field(&C::opposite_normals,
        {.name = "opposite_normals",
         .help =
             "number of dropped duplicates whose normal opposes the normal of the earlier point"});
  field(&C::zero_normals,
        {.name = "zero_normals", .help = "number of remaining points with a zero normal"});
}

// Drops points that are not finite, and merges points at one place (to 2^-23
// of the diagonal of their bounding box). A merged point keeps the attributes
// of its first point. Its normal is the mean direction of the normals within
// 90 degrees of the first one's normal. Normals that are not finite become
// zero. Throws InvalidInput if normals or attributes are not one per point.
CleanReport clean(PointCloud& cloud, const Context& context = {});

// Report of align_scans(). Lengths are in the unit of the points.
struct ScanAlignment {
  std::size_t scans = 0;  // number of scans by attribute value; 0 without it
  std::size_t pairs = 0;  // number of pairs of points from different scans
  // Distances of these pairs along the normal, before and after: 1.48 times the median, which is
  // the standard deviation if most distances are Gaussian.
  double distance_before = 0, distance = 0;
  double moved = 0;  // root mean square displacement of all points
};

// Lists the fields of ScanAlignment.
template <typename Visitor>
void visit_fields(FieldsOf<ScanAlignment>, const Visitor& field) {
  using S = ScanAlignment;
  field(&S::scans,
        {.name = "scans",
         .help =
             "number of scans: different values of the attribute 'scan'; 0 without the attribute"});
  field(&S::pairs,
        {.name = "pairs", .help = "number of compared pairs of points from different scans"});
  field(&S::distance_before, {.name = "distance_before",
                              .help = "standard deviation of the distance between paired points "
                                      "along the normal, before the alignment"});
  field(&S::distance, {.name = "distance",
                       .help = "standard deviation of the distance between paired points along the "
                               "normal, after the alignment"});
  field(&S::moved, {.name = "moved", .help = "root mean square displacement of all points"});
}

// Aligns scans of one surface, each moved as a rigid body. The attribute `scan` of points holds
// whole numbers, at most kMaxScans different ones. Near points of two scans with similar normals
// are paired, and each pair shall lie on one sphere (Chen, Medioni 1992; Rusinkiewicz 2019). Least
// squares over all scans, with weights that fall for large distances, are repeated until nothing
// moves. A motion that no pair determines, such as a rotation of a ball, is left out, and the mean
// of all points stays. Normals and attributes sensor_x, sensor_y, sensor_z are moved too. For
// overlapping scans within a few spacings; does nothing with fewer than two scans. Throws
// InvalidInput for an invalid cloud. Same input, same bits for any number of threads.
ScanAlignment align_scans(PointCloud& cloud, const Context& context = {});

// Options for computing normals and their signs.
struct OrientOptions {
  int neighbors = 0;             // number in a fit, 3 ... 10000; 0: chosen from the data
  bool keep_directions = false;  // keep directions of given nonzero normals, choose only signs
  // Point inside from which the surface is seen: normals point away from it. Decides all signs.
  std::optional<Vec3> center = {};
  // Point from which the surface was measured: normals point to it. Decides all signs, so it
  // excludes `center`. Without both, attributes sensor_x, sensor_y, sensor_z of the cloud are used
  // if all three exist with finite values: the place each point was measured from.
  std::optional<Vec3> sensor = {};
  // True: isolated points are not searched for; with a centre or a sensor they never are.
  bool keep_outliers = false;
  bool confidence = false;  // adds the attribute `confidence`, replacing an existing one
};

// Lists the fields of OrientOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<OrientOptions>, const Visitor& field) {
  using O = OrientOptions;
  field(&O::neighbors,
        {.name = "neighbors",
         .help = "number of neighbours that a normal is fitted to; 0: chosen from the data",
         .value = "N",
         .least = 3,
         .most = 10000,
         .may_be_zero = true});
  field(&O::keep_directions,
        {.name = "keep_directions",
         .help = "keep the directions of given normals and compute only their signs"});
  field(&O::center, {.name = "center",
                     .help = "point inside the surface, from which all normals point away",
                     .value = "X,Y,Z"});
  field(&O::sensor,
        {.name = "sensor",
         .help = "point from which the surface was measured, to which all normals point",
         .value = "X,Y,Z"});
  field(&O::keep_outliers, {.name = "keep_outliers",
                            .help = "do not search for isolated points, which otherwise get the "
                                    "normal of the nearest point that is not isolated"});
  field(&O::confidence, {.name = "confidence",
                         .help = "add the confidence of each normal's sign as the point attribute "
                                 "`confidence`, 0 ... 1"});
}

// Counts and confidence of orient().
struct OrientReport {
  std::size_t points = 0;      // number of given points
  std::size_t duplicates = 0;  // points at the place of an earlier one; they share its normal
  int neighbors = 0;           // number of neighbours in a fit
  std::size_t components = 0;  // parts of the neighbour graph; 0 with a centre or a sensor
  std::size_t computed = 0;    // normals with a new direction
  std::size_t flipped = 0;     // normals whose sign changed
  // Isolated points, far from all others: they get the normal of the nearest point that is not
  // isolated, with confidence 0.
  std::size_t outliers = 0;
  std::size_t undetermined = 0;  // points whose neighbours are collinear: their normals are zero
  // Mean confidence, 0 ... 1. The sign of a point is right with at least the probability (1 +
  // confidence) / 2. The confidence follows from the agreement of neighbouring normals, and from
  // winding numbers near 1 behind the point and 0 in front. With a centre or a sensor it follows
  // from the angle between normal and line of sight.
  double mean_confidence = 0;
  double unsure = 0;  // share of the points with a confidence below 0.5
};

// Lists the fields of OrientReport.
template <typename Visitor>
void visit_fields(FieldsOf<OrientReport>, const Visitor& field) {
  using R = OrientReport;
  field(&R::points, {.name = "points", .help = "number of given points"});
  field(&R::duplicates,
        {.name = "duplicates",
         .help = "number of points at the position of an earlier point, whose normal they share"});
  field(&R::neighbors,
        {.name = "neighbors", .help = "number of neighbours that a normal is fitted to"});
  field(&R::components,
        {.name = "components",
         .help = "number of connected parts of the neighbour graph; 0 with a centre or a sensor"});
  field(&R::computed,
        {.name = "computed", .help = "number of normals with a newly computed direction"});
  field(&R::flipped, {.name = "flipped", .help = "number of normals whose sign was changed"});
  field(&R::outliers, {.name = "outliers",
                       .help = "number of isolated points, which got the normal of the nearest "
                               "point that is not isolated"});
  field(&R::undetermined,
        {.name = "undetermined",
         .help = "number of points with a zero normal, because their neighbours lie on a line"});
  field(&R::mean_confidence, {.name = "mean_confidence",
                              .help = "mean confidence of all points; a sign is right with at "
                                      "least the probability (1 + confidence) / 2"});
  field(&R::unsure, {.name = "unsure", .help = "share of the points with a confidence below 0.5"});
}

// Share of unsure points above which normals, and surfaces made with them, are unreliable.
inline constexpr double kTooUnsure = 0.2;  // chosen: a shape with a fifth inside out is unusable

// Computes unit normals that point out of the solid. Directions come from planes and paraboloids
// through the nearest points. They are fitted between rows where points lie in rows, and to one
// side only beside sharp edges. Signs come from a minimum spanning tree of the neighbour graph
// (Hoppe 1992). Parts that the tree joins with low confidence or not at all are oriented so that
// their winding numbers agree. A closed part inside another one bounds a cavity. In thin, sparse
// or uneven places the winding number of all points may contradict: signs then come from a field
// of all points, directions from fits to one sheet. An open part without inside (a plane)
// follows the largest component of its mean normal. Same input, same bits for any number of
// threads.
//
// Throws InvalidInput for an invalid cloud (clean() helps), more than kMaxPoints points, options
// out of range, and points that all lie on one line.
OrientReport orient(PointCloud& cloud, const OrientOptions& options = {},
                    const Context& context = {});

}  // namespace rholm
