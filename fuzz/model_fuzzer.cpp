#include "coefficients_fuzzing.h"
#include "model/file/model_read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::Expansion expansion;
  try {
    expansion = rholm::parse_model({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const rholm::Error&) {
    return 0;
  }
  rholm::fuzzing::check_expansion_survives(expansion);
  return 0;
}
