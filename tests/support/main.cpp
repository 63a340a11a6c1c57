// The program of the tests of a layer: googletest's own, which instruction set runs, and processor
// time.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
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

// Notes the processor time of each test in the file that RHOLM_TEST_TIMES names, if it names one
// (scripts/test-times; support/times.py does it for tests in Python).
class NoteTimes : public testing::EmptyTestEventListener {
 public:
  NoteTimes(const char* file, const char* program)
      : file_(file), group_(std::filesystem::path(program).filename().string()) {}

  void OnTestStart(const testing::TestInfo&) override { before_ = spent(); }

  void OnTestEnd(const testing::TestInfo& test) override {
    const double seconds = spent() - before_;
    noted_ += seconds;
    note(seconds, std::string(test.test_suite_name()) + "." + test.name());
  }

  void OnTestProgramEnd(const testing::UnitTest&) override { note(spent() - noted_, "(start)"); }

 private:
  // Of this process, its threads, and the processes that it has waited for.
  static double spent() {
    double seconds = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
      rusage used{};
      getrusage(who, &used);
      for (const timeval& time : {used.ru_utime, used.ru_stime}) {
        seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
      }
    }
    return seconds;
  }

  // Many processes write at once: one line is one call, at the end of the file.
  void note(double seconds, const std::string& name) const {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.4f", seconds);
    const std::string line = std::string(number.data()) + "\t" + group_ + "\t" + name + "\n";
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
  double before_ = 0;
  double noted_ = 0;
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
    // googletest owns it
    testing::UnitTest::GetInstance()->listeners().Append(new NoteTimes(times, argv[0]));
  }
  return RUN_ALL_TESTS();
}
