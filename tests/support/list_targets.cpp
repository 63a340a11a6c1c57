// Prints the instruction sets that RHOLM_TEST_TARGET may name on this machine, best first.
#include <cstdio>

#include "support/targets.h"

int main() {
  for (const std::int64_t target : rholm::test::available_targets())
    std::puts(hwy::TargetName(target));
}
