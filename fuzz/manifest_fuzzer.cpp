#include "rholm/batch.h"
#include "rholm/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const rholm::Manifest manifest =
        rholm::parse_manifest({reinterpret_cast<const char*>(data), size}, "fuzz");
    for (const rholm::ManifestItem& item : manifest.items) {
      if (item.path.empty() || item.values.size() != manifest.columns.size()) __builtin_trap();
    }
  } catch (const rholm::Error& refused) {
    if (refused.what()[0] == '\0') __builtin_trap();  // the error must have a message
  }
  return 0;
}
