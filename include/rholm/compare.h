// Two-sided distance between surfaces. Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/mesh.h"
#include "rholm/mesh_view.h"

namespace rholm {

inline constexpr std::size_t kMaxSamples = 100000000;  // about 8 GB of memory: a sanity limit

// Number and seed of the samples, and threshold of the F-score.
struct CompareOptions {
  std::size_t samples = 200000;  // number on each surface, area-weighted, 1 ... kMaxSamples
  std::uint64_t seed = 1;        // seed of the samples
  double threshold = 0.01;       // for the F-score, as a fraction of the diagonal of A's box
};

// Lists the fields of CompareOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<CompareOptions>, const Visitor& field) {
  using O = CompareOptions;
  field(&O::samples, {.name = "samples",
                      .help = "points on each surface, evenly spread over its area",
                      .value = "N",
                      .least = 1,
                      .most = kMaxSamples});
  field(&O::seed, {.name = "seed", .help = "of the random points", .value = "S"});
  field(&O::threshold, {.name = "threshold",
                        .help = "of the F-score, as a part of the diagonal of A's bounding box",
                        .value = "T",
                        .least = 0,
                        .above = true});
}

// Root mean square, mean and largest distance over all samples, in the shape's unit.
struct Distances {
  double rms = 0, mean = 0, max = 0;  // >= 0
};

// Lists the fields of Distances.
template <typename Visitor>
void visit_fields(FieldsOf<Distances>, const Visitor& field) {
  using D = Distances;
  field(&D::rms, {.name = "rms", .help = "root mean square", .unit = FieldUnit::kLength});
  field(&D::mean, {.name = "mean", .help = "mean", .unit = FieldUnit::kLength});
  field(&D::max, {.name = "max", .help = "largest", .unit = FieldUnit::kLength});
}

// Distance between two surfaces A and B. Lengths are in the shape's unit.
struct Comparison {
  std::size_t samples = 0;  // number on each surface
  std::uint64_t seed = 0;   // seed of the samples
  double diagonal = 0;      // diagonal of A's bounding box
  Distances a_to_b;         // distances from samples of A to their exact closest points on B
  Distances b_to_a;         // distances from samples of B to their exact closest points on A
  double hausdorff = 0;     // larger of the two max: a lower bound of the Hausdorff distance
  double threshold = 0;     // distance for precision and recall; shape's unit
  double precision = 0;     // share of B's samples within the threshold of A
  double recall = 0;        // share of A's samples within the threshold of B
  double f_score = 0;       // harmonic mean of the two
  // Median and mean angle between the oriented normal at a sample and the normal at its closest
  // point, over both directions together, degrees 0 ... 180.
  double normal_median_degrees = 0, normal_mean_degrees = 0;
};

// Lists the fields of Comparison.
template <typename Visitor>
void visit_fields(FieldsOf<Comparison>, const Visitor& field) {
  using C = Comparison;
  field(&C::samples, {.name = "samples", .help = "points on each surface"});
  field(&C::seed, {.name = "seed", .help = "that they were drawn with"});
  field(&C::diagonal,
        {.name = "diagonal", .help = "of A's bounding box", .unit = FieldUnit::kLength});
  field(&C::a_to_b, {.name = "a_to_b", .help = "from samples of A to their closest points on B"});
  field(&C::b_to_a, {.name = "b_to_a", .help = "from samples of B to their closest points on A"});
  field(&C::hausdorff, {.name = "hausdorff",
                        .help = "larger of the two largest distances: a lower bound of the "
                                "Hausdorff distance",
                        .unit = FieldUnit::kLength});
  field(&C::threshold, {.name = "threshold", .help = "of the F-score", .unit = FieldUnit::kLength});
  field(&C::precision,
        {.name = "precision", .help = "share of B's samples within the threshold of A"});
  field(&C::recall, {.name = "recall", .help = "share of A's samples within the threshold of B"});
  field(&C::f_score, {.name = "f_score", .help = "harmonic mean of precision and recall"});
  field(&C::normal_median_degrees,
        {.name = "normal_median_degrees",
         .help = "median of the angle between the normal at a sample and that at its closest "
                 "point, 0 ... 180"});
  field(&C::normal_mean_degrees, {.name = "normal_mean_degrees", .help = "mean of that angle"});
}

// Compares two meshes by exact closest points on triangles (double precision). Throws InvalidInput
// for a mesh without area, samples out of range or a threshold that is not positive.
Comparison compare(const Mesh& a, const Mesh& b, const CompareOptions& options = {},
                   const Context& context = {});

// Compares meshes that need not fit in memory, with the same bits as above. Reads them several
// times, in portions of triangles of at most `memory` bytes (3 MB if less), plus about 110 bytes
// per sample. Fastest if triangles near in memory are also near in space.
Comparison compare(const MeshInPlace& a, const MeshInPlace& b, std::size_t memory,
                   const CompareOptions& options = {}, const Context& context = {});

// Returns the distance from each point to its exact closest point on the surface.
std::vector<double> distances_to_surface(const std::vector<Vec3>& points, const Mesh& surface,
                                         const Context& context = {});

}  // namespace rholm
