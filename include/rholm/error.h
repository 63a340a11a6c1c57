// Errors of the library. Layer: base.
//
// Bad input throws an exception. It has a code from a closed list, and a message that names the
// value, the limit and what to do next. The library never prints and never exits.
#pragma once

#include <stdexcept>
#include <string>

namespace rholm {

// Kinds of errors.
enum class ErrorCode {
  kInvalidInput,   // the data does not allow the request (malformed file, NaN, open mesh, ...)
  kIo,             // the operating system refused to read or write
  kUnsupported,    // well-formed input of a variant that is not handled
  kNotStarShaped,  // the surface is not star-shaped from any (or the given) centre
  kOutOfMemory,    // more memory than allowed is needed
  kNotConverged,   // a tolerance was not reached within the limits
  kCancelled,      // the progress callback asked to stop
};

// Returns the code's name as it appears in reports: "InvalidInput", "Io", ...
const char* to_string(ErrorCode code);

// Exception of the library. what() is for people: the value, the limit, what to do next.
class Error : public std::runtime_error {
 public:
  // Makes an error of that kind with that message.
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ErrorCode code() const { return code_; }  // kind of error, for programs

 private:
  ErrorCode code_;
};

}  // namespace rholm
