#include "cli/terminal/capture.h"

#include <utility>

namespace rholm::cli {
namespace {

thread_local Capture* current = nullptr;

}  // namespace

Capture::Capture() : outer_(std::exchange(current, this)) {}

Capture::~Capture() { current = outer_; }

Capture* capture() { return current; }

}  // namespace rholm::cli
