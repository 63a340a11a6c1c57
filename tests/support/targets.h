// Forces instruction sets at run time. The main() of the tests forces the instruction set that
// RHOLM_TEST_TARGET names for the whole run (force_target_of_environment()).
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace rholm::test {

// Makes every kernel use the best of `targets` from now on. No other thread may run meanwhile.
inline void force_targets(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Forces instruction sets until its destructor restores the previous ones; 0 stands for all.
class ForcedTargets {
 public:
  explicit ForcedTargets(std::int64_t targets) : before_(hwy::SupportedTargets()) {
    force_targets(targets);
  }
  ~ForcedTargets() { force_targets(before_); }
  ForcedTargets(const ForcedTargets&) = delete;
  ForcedTargets& operator=(const ForcedTargets&) = delete;

 private:
  std::int64_t before_;
};

// Returns what both this machine and the build support, best first, even if others are forced.
inline std::vector<std::int64_t> available_targets() {
  const ForcedTargets all(0);
  return hwy::SupportedAndGeneratedTargets();
}

// Calls visit(name) with each available instruction set forced in turn.
template <typename Visit>
void for_each_target(const Visit& visit) {
  for (const std::int64_t target : available_targets()) {
    const ForcedTargets forced(target);
    visit(hwy::TargetName(target));
  }
}

// Forces the instruction set that the environment variable RHOLM_TEST_TARGET names; without the
// variable the best one is used. Returns an error message, or "" if there is no error.
std::string force_target_of_environment();

// Returns the name of the instruction set that kernels use.
inline std::string running_target() {
  return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());
}

}  // namespace rholm::test
