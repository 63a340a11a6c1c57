// The program without its main(). Layer: cli.
#pragma once

#include <string>
#include <vector>

namespace rholm::cli {

// Exit codes beside those of interruption (128 + signal).
inline constexpr int kDone = 0;
inline constexpr int kFailure = 1;       // unreadable or unwritable file, no memory
inline constexpr int kUsage = 2;         // the command line is wrong
inline constexpr int kRefused = 3;       // input malformed, not supported, not star-shaped
inline constexpr int kNotConverged = 4;  // a precision was not reached

// Runs `words` (without the program's name) and returns the exit code; never throws.
int run_program(const std::vector<std::string>& words);

}  // namespace rholm::cli
