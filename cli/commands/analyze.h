// rholm analyze with an exchangeable encoder. Layer: cli.
#pragma once

#include <functional>
#include <string>

#include "cli/grammar/command.h"
#include "rholm/context.h"
#include "rholm/model.h"

namespace rholm::cli {

// Type of encode_file() in model.h.
using EncodeFile =
    std::function<Encoded(const std::string& path, const EncodeOptions& options,
                          const Context& context, const std::function<Mesh()>& read)>;

struct AnalyzeBy {
  EncodeFile encode_file;
  // Throws UsageError for an input that the encoder cannot read.
  std::function<void(const std::string& path)> check_input;
};
// Makes the command with this encoder for single expansions; atlases and Monte Carlo methods always
// use the encoder of this process.
Command analyze_command_by(const AnalyzeBy& by);

}  // namespace rholm::cli
