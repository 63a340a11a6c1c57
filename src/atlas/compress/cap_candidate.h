// A large cap around a sample: the smallest degree that meets a tolerance (method 7.8).
// Layer: atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/cap/cap_fit.h"
#include "atlas/cap/normal_equations.h"
#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"

namespace rholm {

struct CandidateOptions {
  double tolerance = 0;  // rms distance of samples, their unit
  double stray = 0;      // a cap's surface farther from all samples would be a sheet of its own
  int max_degree = 14;
  std::size_t samples = 1000;  // of a fit, about
};

// CapFitOptions::penalty of few large caps.
inline constexpr double kFewPenalty = 2e-9;
// Pivots of their normal matrices below that part of their diagonal element are rounding.
inline constexpr double kFewPivot = 1e-13;

// Numbers that a model keeps of a cap beside its coefficients: seed, rotation, radius, dilation,
// support.
inline constexpr std::size_t kFrameNumbers = 9;

struct Candidate {
  Cap cap;  // Cap::first is not set
  std::vector<double> coefficients;
  double inside = 0;  // samples of the finest level in its support, estimated
  double rms = 0;     // of those samples it covers
  // Samples it covers, of the level it was fitted to, by their indices in the finest one.
  std::vector<std::uint32_t> covered;
  double share = 1;  // samples of the finest level that one of these stands for
  std::size_t cost() const { return coefficients.size() + kFrameNumbers; }
};

// Memory that is used again, one per thread.
struct CandidateScratch {
  PatchSearch search;
  CapPoints points, probes;
  std::vector<std::uint32_t> indices;  // of the points, in their level
  std::vector<double> distance2;       // of the points from the seed
  CapFitScratch fit;
  std::vector<double> coefficients, values, surface;
  std::vector<Neighbor> near;
};

// Where a candidate is, whatever its half angle: `radius` about a sample.
struct CandidatePlace {
  const SampleLevel* level = nullptr;  // that it is fitted to
  std::uint32_t seed = 0, start = 0;   // the sample, and the level's nearest one
  double radius = 0;
  Vec3 axis;
};
CandidatePlace candidate_place(const SampleLevels& samples, std::uint32_t seed, double radius,
                               const CandidateOptions& options, CandidateScratch& scratch);

// What a candidate is worth: samples that are not `covered` (one of the finest level each) per
// number.
double gain_of(const Candidate& candidate, std::span<const std::uint8_t> covered);
// What there is already for that: a candidate that is not worth more is none.
struct Rival {
  std::span<const std::uint8_t> covered = {};
  double value = 0;
};

// Tries a cap whose support is that; false if no degree meets the tolerance.
bool make_candidate(const SampleLevels& samples, const CandidatePlace& place, double half_angle,
                    const CandidateOptions& options, const Rival& rival, CandidateScratch& scratch,
                    Candidate& candidate);

// Whether a point of its surface within its support is farther than `band` off the surface of the
// samples, or where they have ended, or faces the other way; at probes about `spacing` apart, or as
// samples are where those are fewer: nearer ones see the same samples, which tell an end two and a
// half spacings beyond it.
// Samples may be random: voids between them are not their end.
bool strays(const SampleLevels& samples, const Cap& cap, std::span<const double> coefficients,
            double band, double spacing, CandidateScratch& scratch);

// The samples of the finest level that a cap covers.
std::vector<std::uint32_t> covered_by(const SampleLevels& samples, const Candidate& candidate,
                                      std::uint32_t seed, double tolerance,
                                      CandidateScratch& scratch);

}  // namespace rholm
