#include "cli/grammar/command.h"

#include <utility>

#include "cli/terminal/session.h"

namespace rholm::cli {

std::vector<Option> common_options(CommonOptions& values) {
  return {
      {.name = "threads",
       .value = "N",
       .help = "worker threads; 0 (the default) is one per processor; results do not depend on it",
       .target = &values.threads,
       .min = 0,
       .max = 4096},
      {.name = "quiet",
       .help = "errors only, and the report that was asked for: no notes, no progress, no "
               "report beside an output",
       .target = &values.quiet},
  };
}

Option json_option(bool& json) {
  return {.name = "json", .help = "the report as JSON on standard output", .target = &json};
}

void append(std::vector<Option>& list, std::vector<Option> more) {
  for (Option& option : more) list.push_back(std::move(option));
}

}  // namespace rholm::cli
