// What the tables of formats have in common. Layer: io.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rholm/formats.h"

namespace rholm {

// By what the content of a file tells its format. Formats are asked in this order, and those of one
// kind in the order of their table.
enum class ToldBy {
  kSignature,  // bytes at known places, which nothing else has there
  kFirstWord,  // the first word or letter of a text
  kLines,      // words that begin lines
  kNothing     // the name of the file, or that no other format has claimed it
};

// The words of which that is true.
std::vector<std::string> words_of(const std::vector<std::pair<const char*, bool>>& words);

}  // namespace rholm
