// Coefficients of the radius by Monte Carlo, as the paper has it, with a deviation that is honest.
// Layer: paper.
//
// kEdges: points on the edges, uniform along the flat edge as in (P40) (on the arc only their
// density would differ), and the corrected field of (M1)-(M3) on both of its faces. kTriangles:
// points uniform on the spherical triangles, r conj(Y) times the solid angle (the paper's reference
// [16]). Each edge or triangle, a "place", gets the same number of points. Both are unbiased. All
// sums are direct, O(samples L^2).
//
// The deviation. Points come in pairs; half the difference of a pair says how one place scatters,
// and the squares of all differences add up to the variance of each coefficient: its estimate has
// about as many degrees of freedom as there are pairs that matter (Satterthwaite), on a mesh of
// many faces a large number already with two samples a place. Standard deviations of whole-surface
// estimates would have rounds - 1 of them instead, and 3 sigma of 4 rounds hold 94 %. Where few
// pairs matter (a coarse mesh, few samples) `deviation` is wider than the standard error by
// Student's factor, so that 3 deviations hold the error in about 99.7 % of all seeds there too:
// measured over 1000 seeds at 2, 4, 8 and 32 points a place on meshes of 4 and 8 faces, 99.6
// to 99.9 % of all coefficients, at least 98.7 % of each. Stopping at a wanted deviation uses the
// standard error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rholm/analyze.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/star.h"

namespace rholm {

// Where the random points are.
enum class SamplePlaces {
  kEdges,     // on the flat edges
  kTriangles  // on the spherical triangles
};
EnumNames names_of(SamplePlaces places);  // "edge", "triangle"

inline constexpr std::size_t kMostSamples = std::size_t{1} << 30;  // chosen: a sanity limit

// How much is wanted, and when to stop.
struct MonteCarloOptions {
  int degree = 64;                             // L, 0 ... kMaxDegree
  SamplePlaces places = SamplePlaces::kEdges;  // of the points
  std::uint64_t seed = 1;                      // of their random numbers
  // Points on each edge / triangle, 2 ... kMostSamples; an odd number is taken as the next even
  // one. None: rounds of samples are added until `deviation` is reached.
  std::optional<std::size_t> samples = {};
  // Wanted relative_deviation, 1e-8 ... 1.
  double deviation = 1e-2;
  // Where to stop without having reached it: points on each place, 2 ... kMostSamples.
  std::size_t most_samples = 4096;
};
// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<MonteCarloOptions>, const Visitor& field) {
  using O = MonteCarloOptions;
  field(&O::degree, {.name = "degree",
                     .help = "highest degree L",
                     .value = "L",
                     .least = 0,
                     .most = kMaxDegree,
                     .in_python = false});
  field(&O::places, {.name = "places",
                     .help = "where the random points are: on edges, or on spherical triangles",
                     .in_program = false});
  field(&O::seed, {.name = "seed", .help = "of the random points", .value = "S"});
  field(&O::samples, {.name = "samples",
                      .help = "points on each edge or triangle, an even number; by default points "
                              "are added until the deviation is reached",
                      .value = "N",
                      .least = 2,
                      .most = kMostSamples});
  field(&O::deviation, {.name = "deviation",
                        .help = "wanted relative deviation of the coefficients",
                        .value = "S",
                        .least = 1e-8,
                        .most = 1});
  field(&O::most_samples,
        {.name = "most_samples",
         .help = "points on each edge or triangle at which to stop without the wanted deviation",
         .value = "N",
         .least = 2,
         .most = kMostSamples});
}

// Coefficients, and how far they may be off.
struct MonteCarlo {
  Expansion expansion;  // the mean
  // Of each coefficient: 3 of it hold the true error in about 99.7 % of all seeds.
  Coefficients deviation;
  std::size_t places = 0;   // edges or triangles that were sampled
  std::size_t samples = 0;  // on each of them
  int rounds = 0;           // in which they were added
  // sqrt(V / (M - V)): V the sum of the squared standard errors over 1 <= l <= L, M that of the
  // squared coefficients found (V of which is scatter). For L = 0 that of c_00. None above 1, or
  // above 1/2 with fewer than 100 pairs of points: M - V is itself no more than scatter there.
  std::optional<double> relative_deviation;
  bool reached = false;  // the wanted deviation; true for a fixed number of samples
  // For each l, the standard error of its 2l + 1 coefficients together, l2: over the sphere, its
  // function of degree l is this over sqrt(4 pi) off, root mean square.
  std::vector<double> degree_deviation;
  // As in Analysis, the doubt by 3 deviations: none unless samples are very many.
  std::optional<double> truncation_rms, truncation_rms_doubt;
  StageTimes times;  // "samples", "sums", "norms"
};

// Its list, without the coefficients.
template <typename Visitor>
void visit_fields(FieldsOf<MonteCarlo>, const Visitor& field) {
  using M = MonteCarlo;
  field(&M::places, {.name = "places", .help = "edges or triangles that were sampled"});
  field(&M::samples, {.name = "samples", .help = "points on each of them"});
  field(&M::rounds, {.name = "rounds", .help = "rounds in which they were added"});
  field(&M::relative_deviation, {.name = "relative_deviation",
                                 .help = "standard error relative to the coefficients without the "
                                         "mean; none if too few points tell"});
  field(&M::reached, {.name = "reached", .help = "whether the wanted deviation is reached"});
  field(&M::degree_deviation,
        {.name = "degree_deviation",
         .help = "for each degree the standard error of its coefficients together"});
  field(&M::truncation_rms,
        {.name = "truncation_rms", .help = "root mean square of what degrees above L would add"});
  field(&M::truncation_rms_doubt,
        {.name = "truncation_rms_doubt", .help = "how far that may be off, by 3 deviations"});
  field(&M::times, {.name = "times", .help = "seconds of each stage"});
}

// Same chart, options and seed give the same bits for every number of threads. Throws InvalidInput
// for options out of range, a surface that no direction sees, or one that comes too near to the
// centre.
MonteCarlo monte_carlo(const StarChart& chart, const MonteCarloOptions& options = {},
                       const Context& context = {});

}  // namespace rholm
