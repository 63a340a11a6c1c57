#include "base/cancel.h"

#include <utility>

#include "rholm/error.h"

namespace rholm {
namespace {

thread_local const CancelScope* scope_of_thread = nullptr;

}  // namespace

CancelScope::CancelScope(std::function<bool()> keep_going)
    : keep_going_(std::move(keep_going)), outer_(std::exchange(scope_of_thread, this)) {}

CancelScope::~CancelScope() { scope_of_thread = outer_; }

const CancelScope* cancel_scope() { return scope_of_thread; }

void ask_cancel() {
  if (scope_of_thread != nullptr && !scope_of_thread->keep_going()) {
    throw Error(ErrorCode::kCancelled, "the computation was cancelled");
  }
}

CancelScopeSwap::CancelScopeSwap(const CancelScope* scope)
    : before_(std::exchange(scope_of_thread, scope)) {}

CancelScopeSwap::~CancelScopeSwap() { scope_of_thread = before_; }

}  // namespace rholm
