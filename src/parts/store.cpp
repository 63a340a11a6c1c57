#include "parts/store.h"

#include "base/refuse.h"

namespace rholm {
namespace {

// Limits of a buffer's size. Chosen: below, opening files costs time; above, nothing is gained.
constexpr std::size_t kLeastBlock = std::size_t{1} << 12, kMostBlock = std::size_t{1} << 20;

}  // namespace

void check_piece_name(const std::string& name) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  bool plain = !name.empty() && name.front() != '/' && name.back() != '/';
  for (std::size_t i = 0; i < name.size() && plain; ++i) {
    plain = is_plain(name[i]) || (name[i] == '/' && name[i - 1] != '/');
  }
  if (!plain) refuse("no piece of a run is called '" + name + "'");
}

void PieceStore::write(const std::string& name,
                       std::span<const std::span<const std::byte>> sections) {
  std::vector<SectionBytes> all;
  all.reserve(sections.size());
  for (const std::span<const std::byte> bytes : sections) all.push_back({bytes});
  write(name, std::move(all));
}

void PieceStore::write(const std::string& name, std::vector<std::vector<std::byte>> sections) {
  const auto owner =
      std::make_shared<const std::vector<std::vector<std::byte>>>(std::move(sections));
  std::vector<SectionBytes> all;
  all.reserve(owner->size());
  for (const std::vector<std::byte>& bytes : *owner) all.push_back({bytes, owner});
  write(name, std::move(all));
}

PieceAppender::PieceAppender(PieceStore& store, const std::string& group, std::size_t n,
                             std::size_t most_bytes)
    : pieces_(store.grow(group, n)),
      buffers_(n),
      block_(std::clamp(most_bytes / std::max<std::size_t>(n, 1), kLeastBlock, kMostBlock)),
      most_(std::max<std::size_t>(most_bytes / block_, 1)) {}

void PieceAppender::flush(std::size_t piece) {
  Buffer& buffer = buffers_[piece];
  if (buffer.used > 0) pieces_->append(piece, {buffer.bytes.get(), buffer.used});
  buffer.used = 0;
}

void PieceAppender::append_section(std::size_t piece, std::span<const std::byte> bytes) {
  flush(piece);
  pieces_->append(piece, bytes);
}

void PieceAppender::append_slowly(std::size_t piece, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  Buffer& buffer = buffers_[piece];
  flush(piece);
  if (bytes.size() > block_) {
    pieces_->append(piece, bytes);
    return;
  }
  if (buffer.room == 0) {
    if (n_buffers_ == most_) {
      for (std::size_t k = 0; k < buffers_.size(); ++k) {
        flush(k);
        buffers_[k] = {};
      }
      n_buffers_ = 0;
    }
    buffer.bytes = std::make_unique_for_overwrite<std::byte[]>(block_);
    buffer.room = block_;
    ++n_buffers_;
  }
  std::memcpy(buffer.bytes.get(), bytes.data(), bytes.size());
  buffer.used = bytes.size();
}

void PieceAppender::finish() {
  for (std::size_t piece = 0; piece < buffers_.size(); ++piece) {
    flush(piece);
    buffers_[piece] = {};
  }
  pieces_->finish();
}

}  // namespace rholm
