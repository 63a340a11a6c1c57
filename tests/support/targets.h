// Instruction sets, forced at run time.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace rholm::test {

// Calls visit(name) with one instruction set after the other that this machine has and the library
// was compiled for.
template <typename Visit>
void for_each_target(const Visit& visit) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    visit(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace rholm::test
