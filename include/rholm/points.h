// Points without faces: made from meshes, put in order, given normals. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"

namespace rholm {

inline constexpr std::size_t kMaxPoints = 100000000;  // some 5 GB of memory: the sanity limit
inline constexpr double kMaxDensityRatio = 1000;      // bounds the tries per point

inline constexpr double kMaxPatternRatio = 1000;  // rows as good as alone
inline constexpr int kMaxScans = 1000;            // the sanity limit

// Where points lie on a surface. All but random ones are rows: steps along them are the smaller.
enum class SamplePattern {
  kRandom,  // independent of each other
  kSlices,  // where planes across the axis cut it, as in a stack of tomograms
  kRings,   // where planes through the axis and the middle cut it, at equal angles
  kLines,   // where rays of each scanner meet it first, row by row
  kGrid,    // where lines meet it that face it: a grid along the axis, and two across it
};
// "random", "slices", "rings", "lines", "grid".
EnumNames names_of(SamplePattern pattern);  // "random", "slices", "rings", "lines", "grid"

// What is measured of a surface, and how badly. Lengths are fractions of the diagonal of the
// mesh's bounding box.
struct SampleOptions {
  std::size_t points = 100000;  // 1 ... kMaxPoints, before holes; with a pattern about as many
  // Standard deviation of a Gaussian displacement, the same and independent along x, y and z: so
  // the distance to a flat surface has it too.
  double noise = 0;
  // Each normal is turned about an axis in the tangent plane, of uniform direction, by an angle
  // that is Gaussian with mean 0 and this standard deviation, degrees.
  double normal_noise = 0;
  // Share of the points that is replaced (floor(share * points) of them, evenly spread over the
  // list) by points uniform in the bounding box grown by 10 %, with normals uniform on the sphere.
  double outliers = 0;
  // Balls about points uniform on the surface; what lies in one is removed, after all the above.
  int holes = 0;
  double hole_radius = 0;  // of these balls, 0 ... 1
  // The density falls exponentially along the longest axis of the bounding box, from the low
  // coordinate to the high, to 1 / density_ratio; 1 ... kMaxDensityRatio.
  double density_ratio = 1;
  SamplePattern pattern = SamplePattern::kRandom;  // where points lie
  // Steps from row to row over those along them, 1 ... kMaxPatternRatio. Of rings at the mean
  // distance from the axis, of lines in angles.
  double pattern_ratio = 1;
  Vec3 pattern_axis = {0, 0, 1};  // of any length but 0; rows of scanners run across it
  // Scanners all around, at three times the radius of a ball about the middle that holds the
  // surface; each has its part of the points, of what it sees. 0: points are of no scanner. With
  // any, points have the attribute `scan`, 0 ... scans - 1. Random points and lines have them.
  int scans = 0;
  // Each scan is moved as a rigid body, at random; the root mean square distance that points of the
  // surface then have from where they were, over all scans.
  double misalignment = 0;
  // By so much more than the first scan the last one is noisy; others lie between.
  double scan_noise = 0;
  bool sensor = false;     // attributes sensor_x, sensor_y, sensor_z: the scanner of each point
  bool normals = true;     // given with the points
  std::uint64_t seed = 1;  // of all random numbers
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<SampleOptions>, const Visitor& field) {
  using O = SampleOptions;
  field(&O::points, {.name = "points",
                     .help = "how many, before holes; with a pattern about as many",
                     .value = "N",
                     .least = 1,
                     .most = kMaxPoints,
                     .in_python = false});
  field(&O::noise,
        {.name = "noise",
         .help = "standard deviation of each point along x, y and z, a part of the diagonal",
         .value = "F",
         .least = 0,
         .most = 1});
  field(&O::normal_noise,
        {.name = "normal_noise",
         .help = "standard deviation of the angle each normal is turned by, degrees",
         .value = "DEG",
         .least = 0,
         .most = 180});
  field(&O::outliers, {.name = "outliers",
                       .help = "share of the points that is anywhere in the box, grown by 10 %",
                       .value = "F",
                       .least = 0,
                       .most = 1});
  field(&O::holes, {.name = "holes",
                    .help = "balls about random points of the surface, in which points are removed",
                    .value = "K",
                    .least = 0,
                    .in_program = false});
  field(&O::hole_radius, {.name = "hole_radius",
                          .help = "radius of these balls, a part of the diagonal",
                          .value = "R",
                          .least = 0,
                          .most = 1,
                          .in_program = false});
  field(&O::density_ratio, {.name = "density_ratio",
                            .help = "density falls by this along the longest axis, exponentially",
                            .value = "Q",
                            .least = 1,
                            .most = kMaxDensityRatio});
  field(&O::pattern,
        {.name = "pattern",
         .help = "where points lie: random; slices across an axis; rings, planes through it; grid, "
                 "lines along it and across; lines, rays of scanners in rows"});
  field(&O::pattern_ratio, {.name = "pattern_ratio",
                            .help = "steps between the rows of a pattern over those along them",
                            .value = "R",
                            .least = 1,
                            .most = kMaxPatternRatio});
  field(&O::pattern_axis,
        {.name = "pattern_axis", .help = "axis of the pattern", .value = "X,Y,Z"});
  field(&O::scans,
        {.name = "scans",
         .help = "scanners all around, each with its part of the points, of what it sees",
         .value = "K",
         .least = 0,
         .most = kMaxScans});
  field(&O::misalignment, {.name = "misalignment",
                           .help = "root mean square distance by which scans are moved, each as a "
                                   "rigid body, a part of the diagonal",
                           .value = "F",
                           .least = 0,
                           .most = 1});
  field(&O::scan_noise,
        {.name = "scan_noise",
         .help = "the last scan has so much more noise than the first, others between",
         .value = "F",
         .least = 0});
  field(&O::sensor,
        {.name = "sensor",
         .help = "with the place of its scanner at each point: sensor_x, sensor_y, sensor_z"});
  field(&O::normals,
        {.name = "normals", .help = "whether points have normals", .in_program = false});
  field(&O::seed,
        {.name = "seed", .help = "of all random numbers", .value = "S", .in_program = false});
}

// Points on the surface, independent random ones, uniform by area (unless the density falls), or in
// a pattern, with the exact normals of their faces. Attributes but normals are interpolated
// linearly between the corners of the face, before noise; whole numbers are rounded; outliers have
// those of some other place of the surface. Same mesh and options, same points for any number of
// threads. Throws InvalidInput for a mesh that is not valid or has no area, for options that are
// out of range or do not go together, and where holes, a pattern or scanners leave no point.
PointCloud sample_surface(const Mesh& mesh, const SampleOptions& options = {},
                          const Context& context = {});

// What clean() found.
struct CleanReport {
  std::size_t points = 0;            // before
  std::size_t not_finite = 0;        // points dropped: a coordinate is NaN or infinite
  std::size_t duplicates = 0;        // points dropped: at the place of an earlier one
  std::size_t opposite_normals = 0;  // of these, with a normal against the earlier one's
  std::size_t zero_normals = 0;      // of the points that stay, if there are normals
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<CleanReport>, const Visitor& field) {
  using C = CleanReport;
  field(&C::points, {.name = "points", .help = "number of points before"});
  field(&C::not_finite,
        {.name = "not_finite", .help = "points dropped: a coordinate was NaN or infinite"});
  field(&C::duplicates,
        {.name = "duplicates", .help = "points dropped: at the place of an earlier one"});
  field(&C::opposite_normals,
        {.name = "opposite_normals", .help = "of these, with a normal against the earlier one's"});
  field(&C::zero_normals,
        {.name = "zero_normals", .help = "of the points that stay, those with a zero normal"});
}

// Makes a list of points fit for work: drops what is not finite, and merges points at one
// place (to 2^-23 of the diagonal of their bounding box) into the first one, which keeps its
// attributes. Its normal becomes the mean direction of all their normals, but for those at more
// than 90 degrees to its own. Normals that are not finite become zero. Throws InvalidInput if
// normals or attributes are not one per point.
CleanReport clean(PointCloud& cloud, const Context& context = {});

// What align_scans() did. Lengths are in the unit of the points.
struct ScanAlignment {
  std::size_t scans = 0;  // different values of the attribute; 0 without one
  std::size_t pairs = 0;  // points of one scan that were compared with those of another
  // Of these pairs, along the normal: 1.48 times the median of the distances, the standard
  // deviation if most of them are Gaussian. Before anything moved, and after.
  double distance_before = 0, distance = 0;
  double moved = 0;  // root mean square way of all points
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<ScanAlignment>, const Visitor& field) {
  using S = ScanAlignment;
  field(&S::scans, {.name = "scans", .help = "different values of the attribute; 0 without one"});
  field(&S::pairs,
        {.name = "pairs", .help = "points of one scan that were compared with those of another"});
  field(
      &S::distance_before,
      {.name = "distance_before",
       .help = "of these pairs along the normal, as a standard deviation, before anything moved"});
  field(&S::distance, {.name = "distance", .help = "the same after"});
  field(&S::moved, {.name = "moved", .help = "root mean square way of all points"});
}

// Brings scans of one surface together, each moved as a rigid body: points with the attribute
// `scan`, whole numbers, at most kMaxScans different ones. Pairs of near points of two scans that
// face the same way shall lie on one sphere; least squares over all scans at once, with weights
// that fall for large distances, until nothing moves (Chen, Medioni 1992; Rusinkiewicz 2019). What
// no pair knows of, as a turn of a ball, is left alone, and the mean of all points does not move.
// Normals and attributes sensor_x, sensor_y, sensor_z go with their points. For scans that are off
// by a few spacings and overlap; does nothing without the attribute, or with one scan. Throws
// InvalidInput for a cloud that is not valid. Same input, same bits for any number of threads.
ScanAlignment align_scans(PointCloud& cloud, const Context& context = {});

// How normals are found and which side is outside.
struct OrientOptions {
  int neighbors = 0;             // of a fit, 3 ... 1000; 0: chosen from the data
  bool keep_directions = false;  // of the normals there are (zero ones are computed): signs only
  // The surface is seen from here from inside: normals point away. Decides every sign alone.
  std::optional<Vec3> center = {};
  // It has been measured from here: normals point to it. Decides every sign alone, so that there is
  // a centre, or a sensor, or none. With none, attributes sensor_x, sensor_y, sensor_z of the cloud
  // do, if there are all three, of finite values: the place that each point was measured from.
  std::optional<Vec3> sensor = {};
  // Points far from all others are not looked for; with a centre or a sensor they never are.
  bool keep_outliers = false;
  bool confidence = false;  // the cloud gets an attribute `confidence`, instead of any of that name
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<OrientOptions>, const Visitor& field) {
  using O = OrientOptions;
  field(&O::neighbors, {.name = "neighbors",
                        .help = "points that a normal is fitted to; 0: chosen from the data",
                        .value = "N",
                        .least = 3,
                        .most = 1000,
                        .may_be_zero = true});
  field(&O::keep_directions, {.name = "keep_directions",
                              .help = "believe the normals that are given up to their signs"});
  field(
      &O::center,
      {.name = "center", .help = "normals point away from here, a point inside", .value = "X,Y,Z"});
  field(&O::sensor, {.name = "sensor",
                     .help = "normals point to here, where the points were measured from",
                     .value = "X,Y,Z"});
  field(&O::keep_outliers, {.name = "keep_outliers",
                            .help = "do not look for points far from all others, which take the "
                                    "normal of the nearest"});
  field(&O::confidence,
        {.name = "confidence", .help = "give each point its confidence, 0 ... 1, as an attribute"});
}

// What orient() did, and how sure it is.
struct OrientReport {
  std::size_t points = 0;      // given
  std::size_t duplicates = 0;  // points at the place of an earlier one; they share its normal
  int neighbors = 0;           // of a fit
  std::size_t components = 0;  // of the graph of neighbours; 0 with a centre or a sensor
  std::size_t computed = 0;    // normals whose direction is new
  std::size_t flipped = 0;     // normals that point to the other side now than they did
  // Points far from all others, outliers: they take the normal of the nearest one that is none,
  // with a confidence of 0.
  std::size_t outliers = 0;
  std::size_t undetermined = 0;  // points whose neighbours lie on a line: their normals are zero
  // Of a point, 0 ... 1: its sign is right with the probability (1 + confidence) / 2, or a larger
  // one. From how far its neighbours' normals agree with its own, and how nearly the winding number
  // is 1 behind and 0 before it; with a centre or a sensor, from the angle between normal and line
  // of sight.
  double mean_confidence = 0;
  double unsure = 0;  // share of the points with a confidence below 0.5
};

// Its list.
template <typename Visitor>
void visit_fields(FieldsOf<OrientReport>, const Visitor& field) {
  using R = OrientReport;
  field(&R::points, {.name = "points", .help = "points given"});
  field(&R::duplicates, {.name = "duplicates",
                         .help = "points at the place of an earlier one, whose normal they share"});
  field(&R::neighbors, {.name = "neighbors", .help = "points of a fit"});
  field(&R::components, {.name = "components",
                         .help = "parts of the graph of neighbours; 0 with a centre or a sensor"});
  field(&R::computed, {.name = "computed", .help = "normals whose direction is new"});
  field(&R::flipped, {.name = "flipped", .help = "normals that were turned round"});
  field(&R::outliers, {.name = "outliers",
                       .help = "points far from all others, which took the normal of the nearest"});
  field(&R::undetermined,
        {.name = "undetermined",
         .help = "points whose neighbours lie on a line: their normals are zero"});
  field(
      &R::mean_confidence,
      {.name = "mean_confidence",
       .help = "mean over the points: a sign is right with the probability (1 + confidence) / 2"});
  field(&R::unsure, {.name = "unsure", .help = "share of the points with a confidence below 0.5"});
}

// Share of unsure points from which normals, and a surface made with them, should not be trusted.
inline constexpr double kTooUnsure = 0.2;  // chosen: a fifth of the shape inside out is no shape

// Gives points unit normals that point out of the solid they bound. Directions: planes and
// paraboloids through the nearest points, between rows where points lie in rows, and beside sharp
// edges through those of one side only. Signs: along a minimum spanning tree of the graph of
// neighbours (Hoppe 1992), then, between parts that it joins in doubt or not at all, so that their
// winding numbers agree; a closed part inside another bounds a cavity. Where the winding number of
// all says that this is wrong, in thin, sparse or unevenly sampled places, signs come from a field
// that all points share, and directions from fits to one sheet at a time. What is open and has no
// inside (a plane) points to the side of its mean normal's largest component. Same input, same bits
// for any number of threads.
//
// Throws InvalidInput for a cloud that is not valid (clean() helps), more than kMaxPoints points,
// options out of range, and points that lie on one line: they have no plane.
OrientReport orient(PointCloud& cloud, const OrientOptions& options = {},
                    const Context& context = {});

}  // namespace rholm
