#include "parts/stages.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "parts/memory_store.h"
#include "parts/threads.h"
#include "rholm/error.h"

namespace rholm {
namespace {

TEST(time_left, is_that_of_costs_at_the_speed_so_far) {
  TimeLeft left({{"a", 1}, {"b", 3}});
  EXPECT_FALSE(left.is_known());
  left.done("a", 0.5, 20);
  left.done("a", 1, 40);
  EXPECT_TRUE(left.is_known());
  EXPECT_DOUBLE_EQ(left.seconds(), 120);
  left.done("b", 0.5, 160);  // slower than expected
  EXPECT_DOUBLE_EQ(left.seconds(), 160 * 1.5 / 2.5);
  left.add({{"c", 1}});
  EXPECT_DOUBLE_EQ(left.seconds(), 160);
  left.done("b", 1, 200);
  left.done("c", 1, 300);
  EXPECT_DOUBLE_EQ(left.seconds(), 0);
}

TEST(time_left, does_not_count_what_was_done_before) {
  TimeLeft left({{"a", 1}, {"b", 3}});
  left.done("a", 1, 0);  // takes no time, because it was done before
  EXPECT_FALSE(left.is_known());
  left.done("b", 0.5, 60);
  EXPECT_DOUBLE_EQ(left.seconds(), 60);
  left.done("unknown", 1, 90);  // takes time although it was not planned
  EXPECT_DOUBLE_EQ(left.seconds(), 90);
}

TEST(time_left, is_said_as_exactly_as_it_is_known) {
  EXPECT_EQ(text_of_seconds(1), "5 s");
  EXPECT_EQ(text_of_seconds(43), "45 s");
  EXPECT_EQ(text_of_seconds(58), "1 min");
  EXPECT_EQ(text_of_seconds(3000), "50 min");
  EXPECT_EQ(text_of_seconds(7500), "2 h 5 min");
}

TEST(stages, tell_of_parts_and_ask_whether_to_go_on) {
  std::vector<std::string> told;
  std::size_t asked = 0;
  Context context;
  context.progress = [&](std::string_view stage, double part) {
    ++asked;
    if (!stage.empty())
      told.push_back(std::string(stage) + " " + std::to_string(part).substr(0, 4));
    return asked < 100;
  };
  Threads alone;
  StageTimes times;
  MemoryStore store;
  Stages stages(alone, store, {{"first", 1}}, times, context);
  std::vector<std::size_t> parts;
  stages.each("first", 4, [&](std::size_t part) {
    parts.push_back(part);
    // Progress of loops within a part is reported as progress of the stage.
    stages.context().progress("inner", 0.9);
  });
  EXPECT_EQ(parts, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(told, (std::vector<std::string>{"first 0.00", "first 0.00", "first 0.25", "first 0.25",
                                            "first 0.50", "first 0.50", "first 0.75", "first 0.75",
                                            "first 1.00"}));
  EXPECT_EQ(times.count("first"), 1U);
  asked = 100;
  EXPECT_THROW(stages.once("second", [] { FAIL() << "it was cancelled"; }), Error);
}

// A store in memory that reports that it may be kept.
class KeptStore final : public PieceStore {
 public:
  using PieceStore::write;
  bool in_memory() const override { return true; }
  bool has(const std::string& name) const override { return store_.has(name); }
  void write(const std::string& name, std::vector<SectionBytes> sections) override {
    store_.write(name, std::move(sections));
  }
  PieceReader open(const std::string& name) const override { return store_.open(name); }
  void remove(const std::string& name) override { store_.remove(name); }
  std::unique_ptr<GrowingPieces> grow(const std::string& group, std::size_t n) override {
    return store_.grow(group, n);
  }
  void check_room(std::uint64_t) const override {}
  void keep(bool kept) override { kept_ = kept; }
  bool is_kept() const override { return kept_; }

 private:
  MemoryStore store_;
  bool kept_ = false;
};

std::vector<int> numbers_of(std::size_t part) {
  return std::vector<int>(part, static_cast<int>(part));
}

TEST(stages, give_the_values_of_all_parts_and_work_none_again) {
  Threads alone;
  MemoryStore store;
  for (const bool again : {false, true}) {
    StageTimes times;
    Stages stages(alone, store, {}, times, {});
    std::vector<std::size_t> worked;
    const auto work = [&](std::size_t part) {
      worked.push_back(part);
      return numbers_of(part);
    };
    EXPECT_EQ(stages.values<int>({"numbers", 4, {"numbers"}}, work),
              (std::vector<int>{1, 2, 2, 3, 3, 3}));
    EXPECT_EQ(worked.size(), again ? 0u : 4u);
    EXPECT_TRUE(stages.values<int>({"numbers", 0, {"none"}}, work).empty());
    EXPECT_EQ(stages.values<int>({"numbers", 2, {"one"}}, work), numbers_of(1));
    EXPECT_EQ(times.size(), 1u);
  }
}

TEST(stages, work_parts_that_have_not_left_all_they_leave) {
  Threads alone;
  MemoryStore store;
  StageTimes times;
  Stages stages(alone, store, {}, times, {});
  write_values(store, "a/0", numbers_of(1));
  write_values(store, "a/1", numbers_of(1));
  write_values(store, "b/1", numbers_of(1));
  std::vector<std::size_t> worked;
  stages.each({"both", 3, {"a", "b"}}, [&](std::size_t part) { worked.push_back(part); });
  EXPECT_EQ(worked, (std::vector<std::size_t>{0, 2}));
}

TEST(stages, go_on_after_a_failure_where_it_ended) {
  Threads alone;
  MemoryStore store;
  std::vector<std::size_t> worked;
  std::size_t bad = 2;
  const auto run = [&] {
    StageTimes times;
    Stages stages(alone, store, {}, times, {});
    return stages.values<int>({"numbers", 4, {"numbers"}}, [&](std::size_t part) {
      if (part == bad) throw Error(ErrorCode::kIo, "the disk is full");
      worked.push_back(part);
      return numbers_of(part);
    });
  };
  EXPECT_THROW(run(), Error);
  bad = 4;
  EXPECT_EQ(run().size(), 6u);
  EXPECT_EQ(worked, (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(stages, remove_what_no_later_stage_reads) {
  Threads alone;
  for (const bool kept : {false, true}) {
    KeptStore store;
    store.keep(kept);
    StageTimes times;
    Stages stages(alone, store, {}, times, {});
    stages.values<int>({"first", 3, {"first"}}, numbers_of);
    const Stage last = {
        .name = "second", .count = 3, .outputs = {"second"}, .last_inputs = {"first", "none"}};
    stages.values<int>(last, [&](std::size_t part) {
      EXPECT_TRUE(store.has("first/" + std::to_string(part)));
      return numbers_of(part);
    });
    for (const std::string part : {"0", "1", "2"}) {
      EXPECT_EQ(store.has("first/" + part), kept);
      EXPECT_TRUE(store.has("second/" + part));
    }
  }
}

}  // namespace
}  // namespace rholm
