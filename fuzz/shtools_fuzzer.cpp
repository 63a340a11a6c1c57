#include "coefficients_fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::fuzzing::check_coefficients_reader(data, size);
  return 0;
}
