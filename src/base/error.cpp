#include "rholm/error.h"

#include <algorithm>
#include <array>

#include "rholm/error_info.h"

namespace rholm {
namespace {

constexpr std::array kErrors = {
    ErrorInfo{ErrorCode::kInvalidInput, "InvalidInput", 3, "InvalidInputError", "ValueError",
              "The input is invalid: a malformed file, NaN, an open mesh, a number out of range."},
    ErrorInfo{ErrorCode::kIo, "Io", 1, "IoError", "OSError",
              "The operating system could not read or write a file."},
    ErrorInfo{ErrorCode::kUnsupported, "Unsupported", 3, "UnsupportedError", "",
              "The input is well-formed, but of a variant that is not supported."},
    ErrorInfo{ErrorCode::kNotStarShaped, "NotStarShaped", 3, "NotStarShapedError",
              "InvalidInputError",
              "The surface is not star-shaped from the given centre, or from any centre."},
    ErrorInfo{ErrorCode::kOutOfMemory, "OutOfMemory", 1, "OutOfMemoryError", "MemoryError",
              "The task needs more memory than is allowed."},
    ErrorInfo{ErrorCode::kNotConverged, "NotConverged", 4, "NotConvergedError", "ArithmeticError",
              "A tolerance was not reached within the limits."},
    ErrorInfo{ErrorCode::kCancelled, "Cancelled", 128, "CancelledError", "",
              "The progress callback asked to stop."}};

}  // namespace

std::span<const ErrorInfo> error_infos() { return kErrors; }

const ErrorInfo& error_info(ErrorCode code) {
  const auto found = std::find_if(kErrors.begin(), kErrors.end(),
                                  [&](const ErrorInfo& info) { return info.code == code; });
  return found == kErrors.end() ? kErrors.front() : *found;
}

const char* to_string(ErrorCode code) { return error_info(code).name; }

std::string snake_case_name(ErrorCode code) {
  std::string name;
  for (const char c : std::string(to_string(code))) {
    if (c >= 'A' && c <= 'Z' && !name.empty()) name += '_';
    name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

}  // namespace rholm
