// The main() of test programs: runs googletest, reports the instruction set and notes times.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/targets.h"

namespace {

class SayTarget : public testing::Environment {
 public:
  void SetUp() override {
    std::printf("instruction set: %s%s\n", rholm::test::running_target().c_str(),
                std::getenv("RHOLM_TEST_TARGET") != nullptr ? " (forced)" : "");
  }
};

// Notes the processor time and the duration of each test in the file that RHOLM_TEST_TIMES names,
// if it is set (scripts/test-times). The Python version is in support/times.py.
class NoteTimes : public testing::EmptyTestEventListener {
 public:
  NoteTimes(const char* file, const char* program)
      : file_(file), group_(std::filesystem::path(program).filename().string()) {}

  void OnTestStart(const testing::TestInfo&) override { before_ = spent(); }

  void OnTestEnd(const testing::TestInfo& test) override {
    const Times times = spent() - before_;
    noted_ = noted_ + times;
    note(times, std::string(test.test_suite_name()) + "." + test.name());
  }

  void OnTestProgramEnd(const testing::UnitTest&) override { note(spent() - noted_, "(start)"); }

 private:
  // Both fields are in seconds.
  struct Times {
    double processor, duration;

    friend Times operator+(Times a, Times b) {
      return {a.processor + b.processor, a.duration + b.duration};
    }
    friend Times operator-(Times a, Times b) {
      return {a.processor - b.processor, a.duration - b.duration};
    }
  };

  // Returns the times of this process, its threads, and the processes that it has waited for, since
  // the listener was made.
  [[nodiscard]] Times spent() const {
    double seconds = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
      rusage used{};
      getrusage(who, &used);
      for (const timeval& time : {used.ru_utime, used.ru_stime}) {
        seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
      }
    }
    const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - made_;
    return {seconds, duration.count()};
  }

  // Many processes append at once: each line is written by one call.
  void note(Times times, const std::string& name) const {
    std::array<char, 64> numbers{};
    std::snprintf(numbers.data(), numbers.size(), "%.4f\t%.4f", times.processor, times.duration);
    const std::string line = std::string(numbers.data()) + "\t" + group_ + "\t" + name + "\n";
    const int file = open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
    if (file < 0 || write(file, line.data(), line.size()) < 0) {
      std::perror(file_.c_str());
    }
    if (file >= 0) {
      close(file);
    }
  }

  std::string file_;
  std::string group_;
  std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  Times before_{};
  Times noted_{};
};

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const std::string wrong = rholm::test::force_target_of_environment();
  if (!wrong.empty()) {
    std::fprintf(stderr, "%s\n", wrong.c_str());
    return 2;
  }
  testing::AddGlobalTestEnvironment(new SayTarget);  // googletest owns it
  const char* const times = std::getenv("RHOLM_TEST_TIMES");
  if (times != nullptr) {
    // googletest owns the listener.
    testing::UnitTest::GetInstance()->listeners().Append(new NoteTimes(times, argv[0]));
  }
  return RUN_ALL_TESTS();
}
