// Description of each kind of error, and the reactions of the program and Python. Layer: base.
#pragma once

#include <span>
#include <string>

#include "rholm/error.h"

namespace rholm {

// A kind of error.
struct ErrorInfo {
  ErrorCode code;            // kind of error
  const char* name;          // name in reports: "InvalidInput"
  int exit_code;             // exit code of the program; cancelled by a signal: 128 + its number
  const char* python_class;  // class in the Python package: "InvalidInputError"
  const char* python_base;   // second base class there: "ValueError"; empty for none
  const char* meaning;       // one sentence
};
// Returns the descriptions of all kinds of errors.
std::span<const ErrorInfo> error_infos();
// Returns the description of one kind.
const ErrorInfo& error_info(ErrorCode code);
// Returns the name of a kind in JSON: "invalid_input".
std::string snake_case_name(ErrorCode code);

}  // namespace rholm
