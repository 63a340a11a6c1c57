#include "io/file/output_buffer.h"

#include <algorithm>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20;  // bytes passed to the system at once
constexpr std::size_t kFirst = std::size_t{1} << 12;  // initial number of bytes in memory

}  // namespace

OutputBuffer::OutputBuffer(AtomicFile* file, std::size_t rows, const Context& context)
    : file_(file), context_(context), rows_(rows), bytes_(file != nullptr ? kPiece : kFirst) {}

void OutputBuffer::make_room(std::size_t n) {
  if (file_ != nullptr) flush();
  if (bytes_.size() - used_ < n) bytes_.resize(std::max(2 * bytes_.size(), used_ + n));
}

void OutputBuffer::flush() {
  if (file_ == nullptr) return;
  file_->write(std::span(bytes_).first(used_));
  used_ = 0;
  const double part = rows_ == 0 ? 1 : static_cast<double>(rows_done_) / static_cast<double>(rows_);
  report_progress(context_, "write", std::min(part, 1.0));
}

std::vector<char> OutputBuffer::take() {
  bytes_.resize(used_);
  return std::move(bytes_);
}

}  // namespace rholm
