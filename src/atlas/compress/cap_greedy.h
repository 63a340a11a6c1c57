// Covers a surface to a tolerance by a small number of large caps (method 7.8). Layer: atlas.
#pragma once

#include <vector>

#include "atlas/compress/cap_candidate.h"
#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

struct GreedyOptions {
  CandidateOptions candidate;
  double largest = 0.35, smallest = 0.005;  // supports, as shares of the diagonal
  double uncovered = 0.002;                 // share of the samples that may stay uncovered
  // The cover stops if the numbers of all caps, estimated from
  // the chosen caps, exceed this bound. 0 means no bound.
  std::size_t most_numbers = 0;
  std::uint64_t seed = 1;
};

// Caps of an atlas, with their weights, in the order of choice. Each
// choice is the cap with the fewest numbers per newly covered sample.
struct GreedyCover {
  std::vector<Candidate> chosen;
  std::vector<std::uint32_t> seeds;      // sample at each chosen cap's seed
  std::vector<std::uint8_t> is_covered;  // 1 for covered samples
  double uncovered = 1;                  // share of uncovered samples
  std::size_t foreseen = 0;              // if > 0, numbers of all caps (estimated) that ended it
};
// Covers the samples; flagged samples in `covered` (one flag per sample) count as covered.
GreedyCover greedy_cover(const SampleLevels& samples, double diagonal, const GreedyOptions& options,
                         std::vector<std::uint8_t> covered, const Context& context);

}  // namespace rholm
