// What is said of each kind of error, and what the program and Python do at it. Layer: base.
#pragma once

#include <span>
#include <string>

#include "rholm/error.h"

namespace rholm {

// A kind of error.
struct ErrorInfo {
  ErrorCode code;            // which it is
  const char* name;          // in reports: "InvalidInput"
  int exit_code;             // of the program; a signal that cancelled is added to 128
  const char* python_class;  // of the Python package: "InvalidInputError"
  const char* python_base;   // what that class is too: "ValueError"; empty if it is only an Error
  const char* meaning;       // one sentence
};
// All kinds of errors.
std::span<const ErrorInfo> error_infos();
// The description of one kind.
const ErrorInfo& error_info(ErrorCode code);
// The name of a kind in JSON: "invalid_input".
std::string snake_case_name(ErrorCode code);

}  // namespace rholm
