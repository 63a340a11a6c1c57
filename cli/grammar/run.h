// Runs a command with its words, and handles exceptions. Layer: cli.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "cli/grammar/command.h"

namespace rholm::cli {

// An exit code (exit_code.h), and the message of the exception that caused it, if any.
struct Outcome {
  int code = 0;
  std::string message = {};
};

// Calls `work`, which returns an exit code; never throws.
Outcome outcome_of(const std::function<int()>& work);

// Parses `words` (without the name) into the command's options and runs it. Throws its exceptions,
// with the command's advice added.
int run_command(const Command& command, std::span<const std::string> words);

}  // namespace rholm::cli
