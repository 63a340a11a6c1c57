// "--max-memory" and "--work-dir": shapes larger than memory. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

struct MemoryOptions {
  std::optional<double> gib;
  std::string work_dir;

  // Bytes: what was said, or what the machine has, or a container of it.
  std::size_t limit() const;
  // What was said, or where the system has temporary files.
  std::string folder() const;
};
Option max_memory_option(MemoryOptions& options);
// Both.
std::vector<Option> memory_options(MemoryOptions& options);

}  // namespace rholm::cli
