#include "rholm/error.h"

namespace rholm {

const char* to_string(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidInput:
      return "InvalidInput";
    case ErrorCode::kIo:
      return "Io";
    case ErrorCode::kUnsupported:
      return "Unsupported";
    case ErrorCode::kNotStarShaped:
      return "NotStarShaped";
    case ErrorCode::kOutOfMemory:
      return "OutOfMemory";
    case ErrorCode::kNotConverged:
      return "NotConverged";
    case ErrorCode::kCancelled:
      return "Cancelled";
  }
  return "Unknown";
}

}  // namespace rholm
