// rholm expand with an exchangeable encoder. Layer: cli.
#pragma once

#include <functional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/context.h"
#include "rholm/model.h"

namespace rholm::cli {

// Type of expand_file() in model.h.
using ExpandFile =
    std::function<Expanded(const std::string& path, const ExpandOptions& options,
                           const Context& context, const std::function<Mesh()>& read)>;

struct ExpandBy {
  ExpandFile expand_file;
  // Throws UsageError for an input that the function cannot read.
  std::function<void(const std::string& path)> check_input;
};
// Makes the command with this function for expansions. Monte Carlo methods always run in this
// process.
Command expand_command_by(const ExpandBy& by);

}  // namespace rholm::cli
