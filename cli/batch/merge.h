// Merges the results of shards into one table. Layer: cli.
#pragma once

#include "cli/batch/job.h"

namespace rholm::cli {

// Returns the table that one run over the whole manifest would give. Throws UsageError for no parts
// or for different formats. Throws InvalidInput for parts of other jobs, and for rows that are
// missing, duplicate, or not in the manifest.
BatchTable merge_parts(const BatchOptions& options);

}  // namespace rholm::cli
