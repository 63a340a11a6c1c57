// The commands in the order of the pipeline, one file each. Layer: cli.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/grammar/help.h"

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
Command batch_command();
#ifdef RHOLM_STUDIO
Command studio_command();
#endif
Command completion_command();
Command man_page_command();
Command reference_command();
// Make these commands for another program, from its list of commands or its manual page for a date.
using ListCommands = std::function<std::vector<Command>()>;
Command completion_command(const std::string& program, ListCommands commands);
using PageOfDate = std::function<std::string(const std::string& date)>;
Command man_page_command(const std::string& program, PageOfDate page);

std::vector<Command> all_commands();
// Returns the program's description of itself.
ProgramText rholm_text();
// Returns functions that each make one command, with its own options at every call.
std::span<Command (*const)()> command_makers();

}  // namespace rholm::cli
