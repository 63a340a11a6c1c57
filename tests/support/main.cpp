// The program of the tests of a layer: googletest's own, and which instruction set runs.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "support/targets.h"

namespace {

class SayTarget : public testing::Environment {
 public:
  void SetUp() override {
    std::printf("instruction set: %s%s\n", rholm::test::running_target().c_str(),
                std::getenv("RHOLM_TEST_TARGET") != nullptr ? " (forced)" : "");
  }
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
  return RUN_ALL_TESTS();
}
