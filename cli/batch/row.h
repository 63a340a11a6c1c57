// One shape of a batch. Layer: cli.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/batch/job.h"

namespace rholm::cli {

// Runs the command for a row of the manifest with the given threads, and captures its output. Files
// that are not kept go to `scratch`. Returns nothing if interrupted. Any other failure is in the
// row: exit_code, message.
std::optional<BatchRow> run_row(const BatchJob& job, std::size_t row, int threads,
                                const std::filesystem::path& scratch);

// Returns the path of a shape; a relative path is relative to the manifest.
std::filesystem::path path_of(const BatchJob& job, std::size_t row);

// Returns true if a row of results has a failed command.
bool has_failed(const BatchRow& row);

}  // namespace rholm::cli
