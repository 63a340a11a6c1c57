// A report as columns of a table. Layer: cli.
#pragma once

#include <functional>
#include <string>

#include "cli/terminal/json_text.h"
#include "rholm/batch.h"

namespace rholm::cli {

// The values of an object: those within others with names joined by dots; lists of numbers as
// lists, of texts as one text, "; " between; of anything else as JSON. null is no value. Left out
// is what `wanted` refuses, and what `row` has already.
void flatten(const Json& report, const std::function<bool(const std::string& name)>& wanted,
             BatchRow& row);

// Whether a column says how long something took, or how much memory: not the same in every run.
bool is_of_the_run(const std::string& name);

}  // namespace rholm::cli
