#include "mpi/rank_options.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"

namespace rholm::mpi {

std::vector<cli::Option> rank_options(RankOptions& options) {
  return {{.name = "patience",
           .value = "SECONDS",
           .help = "a rank that is silent for so long, or at work without progress, ends the run; "
                   "300 by default",
           .target = &options.patience,
           .min = 5,
           .max = 1e7,
           .group = cli::Group::kAdvanced},
          {.name = "timings",
           .help = "at the end, on standard error: processor time of all ranks, and the bytes that "
                   "they have exchanged",
           .target = &options.timings,
           .group = cli::Group::kAdvanced}};
}

void check_input(const Ranks& ranks, const std::string& path) {
  std::error_code none;
  const bool is_stream = path == "-" || (std::filesystem::exists(path, none) &&
                                         !std::filesystem::is_regular_file(path, none));
  if (ranks.size() == 1 || !is_stream) return;
  throw cli::UsageError(fmt::format(
      "{} can be read by one rank alone, and there are {}: give the name of a file that "
      "all of them see",
      cli::display_name(path), ranks.size()));
}

}  // namespace rholm::mpi
