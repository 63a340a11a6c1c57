// A sample that depends on the points alone, not on their order. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// Returns 64 well-mixed bits of the coordinates; 0 and -0 are the same.
std::uint64_t place_hash(const Vec3& p);

// The k different points with the smallest hashes (a bottom-k sketch: Cohen, Kaplan 2007). A point
// that occurs a million times counts once.
class PointSample {
 public:
  explicit PointSample(std::size_t k);

  void add(const Vec3& p) {
    const std::uint64_t hash = place_hash(p);
    if (hash <= most_) keep(hash, p);
  }
  // Enlarges the sample. Points that have been dropped from the smaller one stay out.
  void grow(std::size_t k);
  // Ends it. Returns the first k points by their hashes, or all of a smaller sample.
  std::vector<Vec3> take(std::size_t k);
  std::vector<Vec3> take() { return take(k_); }
  // Returns the number of different points: exact up to k, then from the largest hash, with a
  // standard deviation of 1 / sqrt(k). After take().
  double n_different() const { return n_different_; }

 private:
  struct Kept {
    std::uint64_t hash;
    Vec3 place;
  };
  void keep(std::uint64_t hash, const Vec3& p);
  void drop_beyond(std::size_t k);

  std::size_t k_;
  std::uint64_t most_ = std::numeric_limits<std::uint64_t>::max();  // larger ones are dropped
  std::vector<Kept> kept_;
  // Found by the lowest bits of a hash; `bits` are others, which tell most different hashes apart.
  struct Slot {
    std::uint32_t bits = 0;
    std::uint32_t after = 0;  // the index in kept_, and 1; 0: free
  };
  std::vector<Slot> table_;
  double n_different_ = 0;
};

}  // namespace rholm
