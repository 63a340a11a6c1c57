#include "cli/command.h"

#include <utility>

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

void append(std::vector<Option>& list, std::vector<Option> more) {
  for (Option& option : more) list.push_back(std::move(option));
}

std::vector<Command> all_commands() {
  return {info_command(),        repair_command(),     simplify_command(),   center_command(),
          analyze_command(),     synthesize_command(), spectrum_command(),   compare_command(),
          convert_command(),     render_command(),     report_command(),     make_command(),
          filter_command(),      recenter_command(),   rotate_command(),     align_command(),
          smooth_command(),      transfer_command(),   orient_command(),     partition_command(),
          reconstruct_command(), bench_command(),      completion_command(), man_page_command()};
}

}  // namespace rholm::cli
