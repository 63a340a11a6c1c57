// Counter-based random numbers: the k-th number of a stream needs no state, so that samples do
// not depend on threads or order.
#pragma once

#include <cstdint>

namespace rholm {

// 64 well-mixed bits of (seed, counter): two rounds of the splitmix64 finaliser (Steele, Lea,
// Flood 2014).
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter);

// Uniform in [0, 1), 53 bits.
double random_uniform(std::uint64_t seed, std::uint64_t counter);

}  // namespace rholm
