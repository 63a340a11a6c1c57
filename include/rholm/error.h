// Errors of the library. Layer: base.
//
// Bad input is answered by an exception with a code from a closed list and a message that names
// the value, the limit and what to do next. The library never prints and never exits.
#pragma once

#include <stdexcept>
#include <string>

namespace rholm {

enum class ErrorCode {
  kInvalidInput,   // the data cannot mean what was asked (malformed file, NaN, open mesh, ...)
  kIo,             // the operating system refused to read or write
  kUnsupported,    // well-formed, but a variant that is not handled
  kNotStarShaped,  // the surface is not star-shaped from any (or the given) centre
  kOutOfMemory,    // more memory than allowed would be needed
  kNotConverged,   // a tolerance was not reached within the limits
  kCancelled,      // the progress callback asked to stop
};

// The code's name as it appears in reports: "InvalidInput", "Io", ...
const char* to_string(ErrorCode code);

class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace rholm
