#include "model/batch/journal_bytes.h"
#include "model/batch/row_bytes.h"
#include "rholm/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kRows = 8;
  const std::string bytes =
      rholm::journal_head(1, kRows) + std::string(reinterpret_cast<const char*>(data), size);
  const rholm::JournalContent content = rholm::parse_journal(bytes, "fuzz", 1, kRows);
  for (const rholm::JournalPlace& place : content.places) {
    if (place.size == 0) continue;
    if (place.at + place.size > content.whole) __builtin_trap();
    if (!rholm::parse_row(std::string_view(bytes).substr(place.at, place.size))) __builtin_trap();
  }
  return 0;
}
