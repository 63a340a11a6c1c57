#include "shape_fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::fuzzing::check_reader(data, size, "xyz");
  return 0;
}
