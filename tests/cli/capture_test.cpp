#include "cli/terminal/capture.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

// All threads write at the same time: each capture has the output of its own thread, in order.
TEST(capture, has_what_its_own_thread_said) {
  constexpr int kThreads = 4, kTimes = 1000;
  std::vector<std::jthread> threads;
  threads.reserve(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([i] {
      Capture said;
      Session session(CommonOptions{});
      std::string report;
      for (int k = 0; k < kTimes; ++k) {
        const std::string word = std::to_string(i) + ":" + std::to_string(k);
        print_text(word);
        session.report(word);
        session.note(word);
        session.warn(word);
        report += word + word;
      }
      print_json({{"i", i}});
      EXPECT_EQ(said.report, report + "{\n  \"i\": " + std::to_string(i) + "\n}\n");
      EXPECT_EQ(said.notes.size(), static_cast<std::size_t>(kTimes));
      EXPECT_EQ(said.warnings, said.notes);
    });
  }
}

TEST(capture, the_last_one_counts_and_gives_way) {
  EXPECT_EQ(capture(), nullptr);
  Capture outer;
  {
    Capture inner;
    print_text("inner");
    EXPECT_EQ(inner.report, "inner");
  }
  print_text("outer");
  EXPECT_EQ(outer.report, "outer");
}

}  // namespace
}  // namespace rholm::cli
