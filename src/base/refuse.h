// Rejects bad input.
#pragma once

#include <string>

#include "rholm/error.h"

namespace rholm {

// Throws InvalidInput. The message has the value, the limit and what to do next.
[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorCode::kInvalidInput, message);
}

}  // namespace rholm
