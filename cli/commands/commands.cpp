#include "cli/commands/commands.h"

namespace rholm::cli {

std::vector<Command> all_commands() {
  return {info_command(),        repair_command(),     simplify_command(),   center_command(),
          analyze_command(),     synthesize_command(), spectrum_command(),   compare_command(),
          convert_command(),     render_command(),     report_command(),     make_command(),
          filter_command(),      recenter_command(),   rotate_command(),     align_command(),
          smooth_command(),      transfer_command(),   orient_command(),     partition_command(),
          reconstruct_command(), bench_command(),      completion_command(), man_page_command()};
}

}  // namespace rholm::cli
