// Requests, answers and refusals. Layer: studio.
#pragma once

#include <stdexcept>
#include <string>

#include "rholm/studio.h"

namespace rholm::studio {

using Request = StudioRequest;
using Response = StudioResponse;
using Event = StudioEvent;

// Thrown for a request that cannot be answered. The code is for the page, the message for people.
class Refusal : public std::runtime_error {
 public:
  Refusal(int status, std::string code, const std::string& message)
      : std::runtime_error(message), status_(status), code_(std::move(code)) {}
  int status() const { return status_; }
  const std::string& code() const { return code_; }

 private:
  int status_;
  std::string code_;
};

// Status 400: the request is wrong. Status 404: the requested object does not exist.
inline Refusal bad_request(const std::string& message) { return {400, "bad_request", message}; }
inline Refusal not_found(const std::string& message) { return {404, "not_found", message}; }

}  // namespace rholm::studio
