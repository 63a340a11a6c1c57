#include "support/targets.h"

#include <cstdlib>

namespace rholm::test {

std::string force_target_of_environment() {
  const char* const wanted = std::getenv("RHOLM_TEST_TARGET");
  if (wanted == nullptr) return {};
  std::string there;
  for (const std::int64_t target : available_targets()) {
    if (hwy::TargetName(target) == std::string(wanted)) {
      force_targets(target);
      return {};
    }
    there += std::string(" ") + hwy::TargetName(target);
  }
  return std::string("RHOLM_TEST_TARGET is '") + wanted +
         "', which this machine or this build does not have; there are:" + there;
}

}  // namespace rholm::test
