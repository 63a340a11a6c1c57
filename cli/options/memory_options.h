// "--max-memory" and "--work-dir": shapes larger than memory. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/terminal/session.h"

namespace rholm::cli {

// Returns the number of threads that work may use.
int threads_of(const Context& context);

struct MemoryOptions {
  std::optional<double> gib;
  std::string work_dir;

  // Returns the given limit in bytes, or the memory of the machine or its container.
  std::size_t limit() const;
  // Returns the given folder, or the system's folder for temporary files.
  std::string folder() const;
  // Enforces the given limit from now on: larger allocations fail. In a batch, whose rows share the
  // process, only require() enforces it.
  void keep(const Session& session) const;
  // Returns "more memory than the 0.1 GiB of --max-memory: 0.2 would do" if `needed` bytes exceed a
  // given limit. `needed` may be an estimate, preferably somewhat high.
  std::optional<std::string> refusal(double needed) const;
  // Throws OutOfMemory "`what` needs more memory than ..." in this case. If accepted work still
  // hits the limit, its message says that `most` bytes would do, by default a quarter more.
  void require(double needed, const std::string& what, double most = 0) const;
};
Option max_memory_option(MemoryOptions& options);
// Returns both options.
std::vector<Option> memory_options(MemoryOptions& options);

}  // namespace rholm::cli
