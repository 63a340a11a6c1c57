// From the words of a command line to the targets of a command's options. Layer: cli.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/grammar/command.h"

namespace rholm::cli {

// The command line does not mean anything: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Fills the targets of the command's options and of the common ones from `words` (without the
// command's name). Throws UsageError.
void parse(const Command& command, std::span<const std::string> words, CommonOptions& common);

}  // namespace rholm::cli
