// Exit codes of the program, besides the codes for interruption (128 + signal). Layer: cli.
#pragma once

namespace rholm::cli {

inline constexpr int kDone = 0;
inline constexpr int kFailure = 1;       // unreadable or unwritable file, no memory
inline constexpr int kUsage = 2;         // the command line is wrong
inline constexpr int kRefused = 3;       // input malformed, not supported, not star-shaped
inline constexpr int kNotConverged = 4;  // a precision was not reached

}  // namespace rholm::cli
