#include "mpi/rank_options.h"

namespace rholm::mpi {

std::vector<cli::Option> rank_options(RankOptions& options) {
  return {{.name = "patience",
           .value = "SECONDS",
           .help = "a rank that is silent for so long, or at work without progress, ends the run; "
                   "300 by default",
           .target = &options.patience,
           .min = 5,
           .max = 1e7},
          {.name = "timings",
           .help = "at the end, on standard error: processor time of all ranks, and the bytes that "
                   "they have exchanged",
           .target = &options.timings}};
}

}  // namespace rholm::mpi
