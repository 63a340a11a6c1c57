// Coefficients of the radius by Monte Carlo, as in the paper, with a reliable deviation.
// Layer: paper.
//
// kEdges: points on the edges, uniform along the flat edge as in (P40), and the corrected field of
// (M1)-(M3) on both faces of the edge. On the arc only the density of the points would differ.
// kTriangles: points uniform on the spherical triangles, r conj(Y) times the solid angle (the
// paper's reference [16]). Each edge or triangle is a "place" and gets the same number of points.
// Both are unbiased. All sums are direct, O(samples L^2).
//
// The deviation. Points come in pairs. Half the difference of a pair measures the scatter at one
// place, and the sum of all squared differences estimates the variance of each coefficient. The
// estimate has about as many degrees of freedom as there are pairs that matter (Satterthwaite):
// many on a mesh of many faces, already with two samples per place. Deviations of whole-surface
// estimates would have rounds - 1 degrees of freedom, and 3 sigma of 4 rounds hold 94 %. If the
// number of pairs that matter is small (coarse mesh, small samples), `deviation` is the standard
// error times Student's factor. Then 3 deviations hold the error in about 99.7 % of all seeds.
// Over 1000 seeds at 2, 4, 8 and 32 points per place on meshes of 4 and 8 faces they hold 99.6
// to 99.9 % of all coefficients, and at least 98.7 % of each. The stopping rule uses the standard
// error.
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

// Places of the random points.
enum class SamplePlaces {
  kEdges,     // on the flat edges
  kTriangles  // on the spherical triangles
};
EnumNames names_of(SamplePlaces places);  // "edge", "triangle"

inline constexpr std::size_t kMostSamples = std::size_t{1} << 30;  // chosen: a sanity limit

// Number of samples, and when to stop.
struct MonteCarloOptions {
  int degree = 64;                             // L, 0 ... kMaxDegree
  SamplePlaces places = SamplePlaces::kEdges;  // where the points are
  std::uint64_t seed = 1;                      // seed of the random numbers
  // Points on each edge or triangle, 2 ... kMostSamples; an odd number is raised to the next even
  // one. Empty: rounds of samples are added until `deviation` is reached.
  std::optional<std::size_t> samples = {};
  // Wanted relative_deviation, 1e-8 ... 1.
  double deviation = 1e-2;
  // Points on each place at which to stop even without `deviation`, 2 ... kMostSamples.
  std::size_t most_samples = 4096;
};
// Lists the fields of MonteCarloOptions (fields.h).
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

// Coefficients, and their standard errors.
struct MonteCarlo {
  Expansion expansion;  // mean over the samples
  // For each coefficient: 3 deviations hold the true error in about 99.7 % of all seeds.
  Coefficients deviation;
  std::size_t places = 0;   // number of sampled edges or triangles
  std::size_t samples = 0;  // number of points on each place
  int rounds = 0;           // number of rounds of samples
  // sqrt(V / (M - V)) over 1 <= l <= L: V is the sum of the squared standard errors, M the sum of
  // the squared coefficients, of which V is scatter. For L = 0 both are for c_00. Empty above 1,
  // and above 1/2 with fewer than 100 pairs of points: there M - V is itself mere scatter.
  std::optional<double> relative_deviation;
  bool reached = false;  // the wanted deviation is reached; true for a fixed number of samples
  // For each l, the l2 standard error of its 2l + 1 coefficients together. Over sqrt(4 pi) it is
  // the root mean square error of the function of degree l over the sphere.
  std::vector<double> degree_deviation;
  // Same meaning as in Analysis; the uncertainty is 3 deviations. Empty without very many samples.
  std::optional<double> truncation_rms, truncation_rms_doubt;
  StageTimes times;  // stages "samples", "sums", "norms"
};

// Lists the fields of MonteCarlo, without the coefficients.
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

// Computes coefficients with the same bits for the same chart, options and seed, for every number
// of threads. Throws InvalidInput for options out of range, a surface without solid angle as seen
// from the centre, or one that comes too near to the centre.
MonteCarlo monte_carlo(const StarChart& chart, const MonteCarloOptions& options = {},
                       const Context& context = {});

}  // namespace rholm
