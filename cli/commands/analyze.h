// rholm analyze, whoever works through the file. Layer: cli.
#pragma once

#include <functional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/context.h"
#include "rholm/model.h"

namespace rholm::cli {

// As encode_file() of model.h.
using EncodeFile =
    std::function<Encoded(const std::string& path, const EncodeOptions& options,
                          const Context& context, const std::function<Mesh()>& read)>;

struct AnalyzeBy {
  EncodeFile encode_file;
  // Throws UsageError for an input that it cannot take.
  std::function<void(const std::string& path)> check_input;
};
// The command with one expansion done in that way; atlases and Monte Carlo methods know no other
// than that of this process.
Command analyze_command_by(const AnalyzeBy& by);

}  // namespace rholm::cli
