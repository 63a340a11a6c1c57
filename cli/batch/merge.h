// Results of shards made one table. Layer: cli.
#pragma once

#include "cli/batch/job.h"

namespace rholm::cli {

// What one run over the whole manifest would have given. Throws UsageError without parts or for
// formats that differ, InvalidInput for parts of other jobs, rows that are missing, in two parts,
// or not of the manifest.
BatchTable merge_parts(const BatchOptions& options);

}  // namespace rholm::cli
