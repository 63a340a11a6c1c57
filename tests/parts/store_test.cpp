#include "parts/store.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "parts/memory_store.h"
#include "rholm/error.h"

namespace rholm {
namespace {

TEST(memory_store, keeps_what_it_is_given_without_a_copy) {
  MemoryStore store;
  std::vector<double> numbers(1000, 0.5);
  numbers.shrink_to_fit();
  const double* const place = numbers.data();
  write_values(store, "numbers", std::move(numbers));
  const PieceValues<double> read = read_values<double>(store, "numbers");
  EXPECT_EQ(read.data(), place);
  EXPECT_EQ(store.bytes(), 1000 * sizeof(double));
  // Values that the caller may change are a copy.
  std::vector<double> own = read_values<double>(store, "numbers");
  EXPECT_EQ(own, std::vector<double>(1000, 0.5));
  EXPECT_NE(own.data(), place);
}

TEST(memory_store, takes_no_more_memory_than_the_values) {
  MemoryStore store;
  std::vector<double> numbers;
  numbers.reserve(100000);
  numbers.push_back(1);
  const double* const place = numbers.data();
  write_values(store, "numbers", std::move(numbers));
  EXPECT_NE(read_values<double>(store, "numbers").data(), place);
}

TEST(memory_store, copies_what_stays_another_s) {
  MemoryStore store;
  std::vector<std::uint32_t> numbers = {1, 2, 3};
  write_values(store, "numbers", numbers);
  numbers.assign(3, 9);
  EXPECT_EQ(read_values<std::uint32_t>(store, "numbers").at(2), 3u);
}

TEST(memory_store, has_values_for_as_long_as_they_are_read) {
  std::vector<PieceValues<std::uint32_t>> kept;
  {
    MemoryStore store;
    for (const std::uint32_t i : {7u, 8u}) {
      write_values(store, "number", std::vector{i});
      kept.push_back(read_values<std::uint32_t>(store, "number"));
    }
    store.remove("number");
    EXPECT_FALSE(store.has("number"));
    EXPECT_THROW(store.open("number"), Error);
  }
  EXPECT_EQ(kept[0].front(), 7u);
  EXPECT_EQ(kept[1].front(), 8u);
}

TEST(piece_values, are_those_that_fit_wherever_they_lie) {
  MemoryStore store;
  // The section has 11 bytes, one number and a half, and follows a section of one byte.
  std::vector<std::vector<std::byte>> sections = {{std::byte{1}}, {}, {}};
  sections[1].resize(11);
  sections[1][0] = std::byte{5};
  store.write("piece", sections);
  const PieceReader piece = store.open("piece");
  const PieceValues<std::uint64_t> values = piece.values<std::uint64_t>(1);
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0], 5u);
  EXPECT_THROW(values.at(1), std::out_of_range);
  EXPECT_TRUE(piece.values<double>(0).empty());
  EXPECT_TRUE(piece.values<double>(2).empty());
  // Bytes at an address that is not aligned for numbers may be copied.
  const auto owner = std::make_shared<const std::vector<std::byte>>(20, std::byte{3});
  const std::span<const std::byte> odd = std::span(*owner).subspan(1, 16);
  store.write("odd", std::vector<SectionBytes>{{odd, owner}});
  EXPECT_EQ(read_values<std::uint64_t>(store, "odd").at(1), 0x0303030303030303u);
  EXPECT_EQ(store.bytes(), 12u + 16u);
}

TEST(piece_values, may_move) {
  PieceValues<int> first(std::vector<int>{1, 2, 3});
  const int* const place = first.data();
  const PieceValues<int> second = std::move(first);
  EXPECT_EQ(second.data(), place);
  EXPECT_EQ(second.end() - second.begin(), 3);
}

}  // namespace
}  // namespace rholm
