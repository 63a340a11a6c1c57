#include "cli/commands/commands.h"

namespace rholm::cli {
namespace {

constexpr Command (*kMakers[])() = {
    info_command,       repair_command,      simplify_command, center_command,   expand_command,
    compress_command,   synthesize_command,  spectrum_command, compare_command,  convert_command,
    render_command,     report_command,      make_command,     filter_command,   recenter_command,
    rotate_command,     align_command,       smooth_command,   transfer_command, orient_command,
    partition_command,  reconstruct_command, batch_command,
#ifdef RHOLM_STUDIO
    studio_command,
#endif
    completion_command, man_page_command,    reference_command};

}  // namespace

std::span<Command (*const)()> command_makers() { return kMakers; }

ProgramText rholm_text() {
  return {.name = "rholm",
          .summary = "spherical harmonics of 3D shapes, from a mesh to coefficients and back",
          .usage = "COMMAND ... [--threads N] [--quiet]",
          .examples = {"rholm make bumpy -o bumpy.ply",
                       "rholm expand bumpy.ply --degree 32 -o bumpy.h5",
                       "rholm synthesize bumpy.h5 --degree 4,16,32 -o smooth.ply"},
          .description =
              "Computes the spherical harmonics of closed meshes exactly and with a known error, "
              "and makes meshes, pictures and reports from coefficients. A file named - is "
              "standard input or standard output; standard output needs --format. Data and reports "
              "go to standard output, and all other messages to standard error."};
}

std::vector<Command> all_commands() {
  std::vector<Command> commands;
  for (const auto make : kMakers) commands.push_back(make());
  return commands;
}

}  // namespace rholm::cli
