#include "model/batch/table_parts.h"
#include "rholm/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const rholm::BatchTable table =
        rholm::parse_table_hdf5({reinterpret_cast<const char*>(data), size}, "fuzz");
    for (std::size_t i = 0; i < table.rows; ++i) table.row(i);
  } catch (const rholm::Error& refused) {
    if (refused.what()[0] == '\0') __builtin_trap();  // the error must have a message
  }
  return 0;
}
