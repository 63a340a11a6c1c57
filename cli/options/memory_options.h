// "--max-memory" and "--work-dir": shapes larger than memory. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/terminal/session.h"

namespace rholm::cli {

// As many threads as work may have.
int threads_of(const Context& context);

struct MemoryOptions {
  std::optional<double> gib;
  std::string work_dir;

  // Bytes: what was said, or what the machine has, or a container of it.
  std::size_t limit() const;
  // What was said, or where the system has temporary files.
  std::string folder() const;
  // Keeps to what was said from here on: what goes beyond is refused while it works. In a batch,
  // whose rows share the process, only by require().
  void keep(const Session& session) const;
  // "more memory than the 0.1 GiB of --max-memory: 0.2 would do" if a limit was said and `needed`
  // bytes are more. `needed` may be an estimate, and is best a little high.
  std::optional<std::string> refusal(double needed) const;
  // Throws OutOfMemory "`what` needs more memory than ..." then. Work that is let pass and comes to
  // the limit all the same is told that `most` bytes would do, by default a quarter more.
  void require(double needed, const std::string& what, double most = 0) const;
};
Option max_memory_option(MemoryOptions& options);
// Both.
std::vector<Option> memory_options(MemoryOptions& options);

}  // namespace rholm::cli
