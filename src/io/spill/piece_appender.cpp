#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/spill/piece_store.h"
#include "io/spill/store_state.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Of a buffer; chosen: below, what it costs to open a file counts; above, nothing is gained.
constexpr std::size_t kLeastBlock = std::size_t{1} << 12, kMostBlock = std::size_t{1} << 20;

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Error(ErrorCode::kIo,
              fmt::format("cannot write {}: {}", path.string(), std::strerror(error)));
}

}  // namespace

// A folder of files, each open only while it is written to, that gets its name at the end; or
// pieces in memory.
class PieceAppender::Output {
 public:
  Output(StoreState& store, const std::string& group, std::size_t n)
      : store_(store), group_(group), tables_(n) {
    check_piece_name(group);
    if (!store_.folder) {
      pieces_.resize(n);
      return;
    }
    part_ = store_.part_of(group);
    std::error_code error;
    std::filesystem::create_directories(part_, error);
    if (error) fail(part_, error.value());
  }
  ~Output() {
    if (done_) return;
    store_.take(bytes_);
    std::error_code ignored;
    if (!part_.empty()) std::filesystem::remove_all(part_, ignored);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void append(std::size_t piece, std::span<const std::byte> bytes) {
    if (!store_.folder) {
      pieces_[piece].emplace_back(bytes.begin(), bytes.end());
      count(bytes.size());
      return;
    }
    append_to_file(piece, bytes);
    tables_[piece].push_back(section_of(bytes));
  }

  void finish() {
    if (store_.folder) {
      finish_files();
    } else {
      finish_memory();
    }
    done_ = true;
  }

 private:
  void count(std::size_t bytes) {
    bytes_ += bytes;
    store_.add(bytes);
  }

  void append_to_file(std::size_t piece, std::span<const std::byte> bytes, bool last = false) {
    const bool first = tables_[piece].empty();
    SpillFile file(part_ / std::to_string(piece),
                   first ? SpillFile::Mode::kNew : SpillFile::Mode::kAppend);
    if (first) {
      file.write(piece_head());
      count(kPieceHead);
    }
    file.write(bytes);
    count(bytes.size());
    if (last) file.sync();
    file.close();
  }

  void finish_files() {
    for (std::size_t piece = 0; piece < tables_.size(); ++piece) {
      append_to_file(piece, piece_tail(tables_[piece]), true);
      tables_[piece] = {};
    }
    const std::filesystem::path path = store_.path_of(group_);
    std::error_code error;
    std::uint64_t before = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path, error)) {
      before += entry.file_size(error);
    }
    std::filesystem::remove_all(path, error);
    std::filesystem::rename(part_, path, error);
    if (error) fail(path, error.value());
    store_.take(before);
  }

  void finish_memory() {
    std::uint64_t before = 0;
    {
      const std::lock_guard lock(store_.mutex);
      std::erase_if(store_.pieces, [&](const auto& piece) {
        const bool ours = piece.first.starts_with(group_ + "/");
        if (ours) before += piece.second->bytes();
        return ours;
      });
      for (std::size_t k = 0; k < pieces_.size(); ++k) {
        auto made = std::make_shared<PieceContent>();
        made->memory = std::move(pieces_[k]);
        store_.pieces[group_ + "/" + std::to_string(k)] = std::move(made);
      }
    }
    store_.take(before);
  }

  StoreState& store_;
  std::string group_;
  std::filesystem::path part_;
  std::vector<std::vector<PieceSection>> tables_;
  std::vector<std::vector<std::vector<std::byte>>> pieces_;  // in memory
  std::uint64_t bytes_ = 0;
  bool done_ = false;
};

PieceAppender::PieceAppender(PieceStore& store, const std::string& group, std::size_t n,
                             std::size_t most_bytes)
    : output_(std::make_unique<Output>(*store.state_, group, n)),
      buffers_(n),
      block_(std::clamp(most_bytes / std::max<std::size_t>(n, 1), kLeastBlock, kMostBlock)),
      most_(std::max<std::size_t>(most_bytes / block_, 1)) {}

PieceAppender::~PieceAppender() = default;

void PieceAppender::flush(std::size_t piece) {
  Buffer& buffer = buffers_[piece];
  if (buffer.used > 0) output_->append(piece, {buffer.bytes.get(), buffer.used});
  buffer.used = 0;
}

void PieceAppender::append_section(std::size_t piece, std::span<const std::byte> bytes) {
  flush(piece);
  output_->append(piece, bytes);
}

void PieceAppender::append_slowly(std::size_t piece, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  Buffer& buffer = buffers_[piece];
  flush(piece);
  if (bytes.size() > block_) {
    output_->append(piece, bytes);
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
  output_->finish();
}

}  // namespace rholm
