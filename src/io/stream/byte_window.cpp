#include "io/stream/byte_window.h"

#include <algorithm>

#include "base/parallel.h"

namespace rholm {

std::span<const char> ByteWindow::at_least(std::size_t n, const Context& context) {
  constexpr std::size_t kLeastRoom = std::size_t{1} << 16;  // what a pipe holds by default
  while (last_ - first_ < n && !ended_) {
    if (first_ > 0) {
      std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(first_),
                bytes_.begin() + static_cast<std::ptrdiff_t>(last_), bytes_.begin());
      last_ -= first_;
      first_ = 0;
    }
    if (bytes_.size() < std::max(n, last_ + kLeastRoom)) {
      // Grows as bytes come: what is asked for may be more than there is.
      bytes_.resize(std::min(std::max(n, last_ + kLeastRoom), 2 * last_ + kLeastRoom));
    }
    const InputFile::Piece piece = file_.read(std::span(bytes_).subspan(last_));
    last_ += piece.size;
    ended_ = piece.ended;
    report_progress(context, "read",
                    size() == 0 ? 0
                                : std::min(1.0, static_cast<double>(passed_ + last_) /
                                                    static_cast<double>(size())));
  }
  return bytes();
}

}  // namespace rholm
