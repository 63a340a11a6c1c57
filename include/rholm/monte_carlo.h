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
#include "rholm/star.h"

namespace rholm {

// Where the random points are.
enum class SamplePlaces {
  kEdges,     // on the flat edges
  kTriangles  // on the spherical triangles
};
const char* to_string(SamplePlaces places);  // "monte-carlo-edge", "monte-carlo-triangle"
std::optional<SamplePlaces> parse_sample_places(const std::string& method);  // none: another method

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
inline constexpr std::size_t kMostSamples = std::size_t{1} << 30;  // chosen: a sanity limit

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

// Same chart, options and seed give the same bits for every number of threads. Throws InvalidInput
// for options out of range, a surface that no direction sees, or one that comes too near to the
// centre.
MonteCarlo monte_carlo(const StarChart& chart, const MonteCarloOptions& options = {},
                       const Context& context = {});

}  // namespace rholm
