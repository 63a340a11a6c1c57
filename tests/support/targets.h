// Instruction sets, forced at run time. The program of the tests takes the one that
// RHOLM_TEST_TARGET names for all of a run (force_target_of_environment()).
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string>
#include <vector>

namespace rholm::test {

// Every kernel takes the best of these from now on. Nothing else may run meanwhile.
inline void force_targets(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Instruction sets for the life of the object, then those from before; 0 stands for all.
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

// What this machine has and the library was compiled for, best first, whatever is forced.
inline std::vector<std::int64_t> available_targets() {
  const ForcedTargets all(0);
  return hwy::SupportedAndGeneratedTargets();
}

// Calls visit(name) with one of these after the other.
template <typename Visit>
void for_each_target(const Visit& visit) {
  for (const std::int64_t target : available_targets()) {
    const ForcedTargets forced(target);
    visit(hwy::TargetName(target));
  }
}

// Forces the instruction set that the environment variable RHOLM_TEST_TARGET names; with no such
// variable the best one stays. Returns what is wrong, if anything is.
std::string force_target_of_environment();

// The one that kernels take.
inline std::string running_target() {
  return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());
}

}  // namespace rholm::test
