#include "base/shared_sets.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/random.h"

namespace rholm {
namespace {

// Oracle: the same pairs are united one after the other.
TEST(shared_sets, are_those_of_one_thread) {
  constexpr std::uint32_t kN = 20000;
  for (const std::size_t n_pairs : {0u, 1000u, 10000u, 40000u}) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(n_pairs);
    for (std::size_t i = 0; i < n_pairs; ++i) {
      pairs[i] = {static_cast<std::uint32_t>(random_bits(n_pairs, 2 * i) % kN),
                  static_cast<std::uint32_t>(random_bits(n_pairs, 2 * i + 1) % kN)};
    }
    DisjointSets expected(kN);
    for (const auto& [a, b] : pairs) expected.unite(a, b);
    for (const int threads : {1, 4}) {
      SharedSets sets(kN);
      parallel_for(n_pairs, 16, {.threads = threads}, {}, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sets.unite(pairs[i].first, pairs[i].second);
      });
      for (std::uint32_t i = 0; i < kN; ++i) {
        ASSERT_EQ(sets.is_first(i), expected.find(i) == i);
        ASSERT_EQ(sets.find(i), expected.find(i));
      }
    }
  }
}

// All threads unite sets with the same few roots.
TEST(shared_sets, of_a_chain_have_its_first_member) {
  constexpr std::uint32_t kN = 100000;
  SharedSets sets(kN);
  parallel_for(kN - 1, 1, {.threads = 4}, {}, [&](std::size_t i, std::size_t) {
    const auto at = static_cast<std::uint32_t>(kN - 2 - i);
    sets.unite(at, at + 1);
  });
  for (std::uint32_t i = 0; i < kN; ++i) ASSERT_EQ(sets.find(i), 0U);
}

}  // namespace
}  // namespace rholm
