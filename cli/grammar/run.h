// A command run with its words, and what becomes of exceptions. Layer: cli.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "cli/grammar/command.h"

namespace rholm::cli {

// An exit code (exit_code.h), and what is to be said where it was an exception that led to it.
struct Outcome {
  int code = 0;
  std::string message = {};
};

// Calls `work`, which returns an exit code; never throws.
Outcome outcome_of(const std::function<int()>& work);

// Fills the command's options from `words` (without its name) and runs it. Throws what it throws,
// with what the command knows about it.
int run_command(const Command& command, std::span<const std::string> words);

}  // namespace rholm::cli
