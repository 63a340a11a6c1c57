// Fits a large cap around a sample with the smallest degree
// that meets a tolerance (method 7.8). Layer: atlas.
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
  double tolerance = 0;  // rms distance of samples, in their unit
  double stray = 0;      // largest distance of a cap's surface from the samples' surface
  int max_degree = 14;
  std::size_t samples = 1000;  // approximate number of samples of a fit
};

// CapFitOptions::penalty of large caps.
inline constexpr double kFewPenalty = 2e-9;
// Pivots of large caps' matrices below this part of their diagonal element are rounding errors.
inline constexpr double kFewPivot = 1e-13;

// Numbers that a model stores per cap besides
// coefficients: seed, rotation, radius, dilation, support.
inline constexpr std::size_t kFrameNumbers = 9;

struct Candidate {
  Cap cap;  // Cap::first is not set
  std::vector<double> coefficients;
  double inside = 0;  // estimated number of the finest level's samples in its support
  double rms = 0;     // rms of the covered samples
  // Covered samples of the level of the fit, by their indices in the finest level.
  std::vector<std::uint32_t> covered;
  double share = 1;  // number of finest samples that one of these represents
  std::size_t cost() const { return coefficients.size() + kFrameNumbers; }
};

// Reusable memory, one per thread.
struct CandidateScratch {
  PatchSearch search;
  CapPoints points, probes;
  std::vector<std::uint32_t> indices;  // indices of the points in their level
  std::vector<double> distance2;       // squared distances of the points from the seed
  CapFitScratch fit;
  std::vector<double> coefficients, values, surface;
  std::vector<Neighbor> near;
};

// Place of a candidate, for any half angle: a disc of `radius` around a sample.
struct CandidatePlace {
  const SampleLevel* level = nullptr;  // level of the fit
  std::uint32_t seed = 0, start = 0;   // the sample, and the nearest one in the level
  double radius = 0;
  Vec3 axis;
};
CandidatePlace candidate_place(const SampleLevels& samples, std::uint32_t seed, double radius,
                               const CandidateOptions& options, CandidateScratch& scratch);

// Returns the gain of a candidate: the number of finest samples it covers
// that are not `covered` (one flag per sample of the finest level).
double gain_of(const Candidate& candidate, std::span<const std::uint8_t> covered);
// Best earlier candidate; a new candidate must have a larger gain per number.
struct Rival {
  std::span<const std::uint8_t> covered = {};
  double value = 0;
};

// Tries a cap with this support; returns false if no degree meets the tolerance.
bool make_candidate(const SampleLevels& samples, const CandidatePlace& place, double half_angle,
                    const CandidateOptions& options, const Rival& rival, CandidateScratch& scratch,
                    Candidate& candidate);

// Returns true if the cap's surface leaves the samples within its support. This is
// the case if a point is farther than `band` off their surface, beyond their end, or
// has an opposite normal. Probes are about `spacing` apart, or as far as the samples
// if these are sparser. Closer probes would find the same samples, which mark an end
// only 2.5 spacings beyond it. Voids between random samples are not an end.
bool strays(const SampleLevels& samples, const Cap& cap, std::span<const double> coefficients,
            double band, double spacing, CandidateScratch& scratch);

// Returns the samples of the finest level that a cap covers.
std::vector<std::uint32_t> covered_by(const SampleLevels& samples, const Candidate& candidate,
                                      std::uint32_t seed, double tolerance,
                                      CandidateScratch& scratch);

}  // namespace rholm
