// Set of integers of a range that counts the members in front of each member.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rholm {

// Takes 3/16 byte for each number of the range.
class RankedSet {
 public:
  // The range is low ... low + n - 1.
  RankedSet(std::uint32_t low, std::size_t n)
      : low_(low), words_((n + 63) / 64), ranks_(words_.size()) {}

  void add(std::uint32_t number) {
    const std::uint32_t bit = number - low_;
    words_[bit / 64] |= std::uint64_t{1} << bit % 64;
  }
  // Returns all members in ascending order.
  std::vector<std::uint32_t> sorted() {
    std::uint32_t count = 0;
    for (std::size_t w = 0; w < words_.size(); ++w) {
      ranks_[w] = count;
      count += static_cast<std::uint32_t>(std::popcount(words_[w]));
    }
    std::vector<std::uint32_t> numbers;
    numbers.reserve(count);
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t bits = words_[w]; bits != 0; bits &= bits - 1) {
        numbers.push_back(low_ + static_cast<std::uint32_t>(
                                     64 * w + static_cast<std::size_t>(std::countr_zero(bits))));
      }
    }
    return numbers;
  }
  // Returns the index of a member in sorted(), which must have been called before.
  std::uint32_t rank(std::uint32_t number) const {
    const std::uint32_t bit = number - low_;
    const std::uint64_t below = (std::uint64_t{1} << bit % 64) - 1;
    return ranks_[bit / 64] + static_cast<std::uint32_t>(std::popcount(words_[bit / 64] & below));
  }

 private:
  std::uint32_t low_;
  std::vector<std::uint64_t> words_;
  std::vector<std::uint32_t> ranks_;
};

}  // namespace rholm
