// Values of a table as text. Layer: model, private.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rholm/batch.h"

namespace rholm {

bool has_value(const Cell& cell);
// A list without the numbers at its end that are none.
std::span<const double> trimmed(const std::vector<double>& list);

// Shortest digits that read back as the same number; empty for what is not there.
std::string number_text(double value);
// true, false, numbers, texts as they are, lists with spaces between.
std::string cell_text(const Cell& cell);

}  // namespace rholm
