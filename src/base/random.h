// Counter-based random numbers: the k-th number of a stream needs no state, so that samples do
// not depend on threads or order.
#pragma once

#include <cstdint>

namespace rholm {

// Returns 64 well-mixed bits of (seed, counter), by two rounds of the splitmix64 finaliser (Steele,
// Lea, Flood 2014).
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter);

// Returns a uniform number in [0, 1) with 53 random bits.
double random_uniform(std::uint64_t seed, std::uint64_t counter);

}  // namespace rholm
