// One shape of a batch. Layer: cli.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/batch/job.h"

namespace rholm::cli {

// Runs the command for a row of the manifest on so many threads, with all it says caught. Files
// that are not kept go to `scratch`. None if it was interrupted; whatever else goes wrong is in the
// row: exit_code, message.
std::optional<BatchRow> run_row(const BatchJob& job, std::size_t row, int threads,
                                const std::filesystem::path& scratch);

// Where a shape is: what is not absolute is beside the manifest.
std::filesystem::path path_of(const BatchJob& job, std::size_t row);

// Whether a row of results says that its command failed.
bool has_failed(const BatchRow& row);

}  // namespace rholm::cli
