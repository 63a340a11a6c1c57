// The program without its main(). Layer: cli.
#pragma once

#include <string>
#include <vector>

namespace rholm::cli {

// Runs `words` (without the program's name) and returns the exit code (exit_code.h); never throws.
int run_program(const std::vector<std::string>& words);

}  // namespace rholm::cli
