// Few large caps that cover a surface to a tolerance (method 7.8). Layer: atlas.
#pragma once

#include <vector>

#include "atlas/compress/cap_candidate.h"
#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

struct GreedyOptions {
  CandidateOptions candidate;
  double largest = 0.35, smallest = 0.005;  // supports, of the diagonal
  double uncovered = 0.002;                 // share of the samples that may be left
  // Given up where the numbers of all caps would be more than this, as foreseen from those chosen;
  // 0: never.
  std::size_t most_numbers = 0;
  std::uint64_t seed = 1;
};

// Caps of an atlas, with their weights, in the order they were chosen. The cap that costs fewest
// numbers per newly covered sample wins.
struct GreedyCover {
  std::vector<Candidate> chosen;
  std::vector<std::uint32_t> seeds;      // samples
  std::vector<std::uint8_t> is_covered;  // samples
  double uncovered = 1;                  // share
  std::size_t foreseen = 0;              // numbers of all caps; 0 unless it was given up for them
};
// Samples that are `covered` (one per sample) count as done.
GreedyCover greedy_cover(const SampleLevels& samples, double diagonal, const GreedyOptions& options,
                         std::vector<std::uint8_t> covered, const Context& context);

}  // namespace rholm
