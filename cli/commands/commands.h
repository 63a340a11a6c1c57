// The commands in the order of the pipeline, one file each. Layer: cli.
#pragma once

#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

Command info_command();
Command repair_command();
Command simplify_command();
Command center_command();
Command analyze_command();
Command synthesize_command();
Command spectrum_command();
Command compare_command();
Command convert_command();
Command render_command();
Command report_command();
Command make_command();
Command filter_command();
Command recenter_command();
Command rotate_command();
Command align_command();
Command smooth_command();
Command transfer_command();
Command orient_command();
Command partition_command();
Command reconstruct_command();
Command bench_command();
Command completion_command();
Command man_page_command();

std::vector<Command> all_commands();

}  // namespace rholm::cli
