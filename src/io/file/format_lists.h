// Declarations that the tables of formats share. Layer: io.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rholm/formats.h"

namespace rholm {

// The property of a file's content that identifies its format. Formats are tested in this order,
// and formats with the same property in the order of their table.
enum class ToldBy {
  kSignature,  // bytes at fixed positions, which no other format has there
  kFirstWord,  // the first word or letter of a text
  kLines,      // words that begin lines
  kNothing     // the name of the file, or that no other format matches
};

// Returns the words whose value is true.
std::vector<std::string> words_of(const std::vector<std::pair<const char*, bool>>& words);

}  // namespace rholm
