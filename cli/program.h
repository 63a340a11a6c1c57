// The program without its main(). Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/grammar/help.h"
#include "cli/grammar/run.h"

namespace rholm::cli {

// Runs `words` (without the program's name) and returns the exit code (exit_code.h); never throws.
int run_program(const std::vector<std::string>& words);

// Runs a program with other commands; the caller reports the outcome.
Outcome run_program(const ProgramText& program, const std::vector<Command>& commands,
                    const std::vector<std::string>& words);
// Runs a program that is one command without a name.
Outcome run_program(const Command& command, const std::vector<std::string>& words);

}  // namespace rholm::cli
