#include "io/file/bytes.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/parallel.h"
#include "io/file/input_file.h"

namespace rholm {
namespace {

constexpr std::size_t kChunk = std::size_t{32} << 20;     // bytes between two progress reports
constexpr std::size_t kFirstRoom = std::size_t{1} << 16;  // default capacity of a pipe

class GrowingBuffer {
 public:
  explicit GrowingBuffer(std::size_t room) { grow_to(room); }
  ~GrowingBuffer() { std::free(data_); }
  GrowingBuffer(const GrowingBuffer&) = delete;
  GrowingBuffer& operator=(const GrowingBuffer&) = delete;

  std::span<char> room() {
    if (size_ == room_) grow_to(2 * room_);
    return {data_ + size_, room_ - size_};
  }
  void advance(std::size_t n) { size_ += n; }
  std::size_t size() const { return size_; }
  Bytes take() {
    // realloc to a smaller size does not move large blocks; it gives the unused part back.
    if (room_ - size_ > kFirstRoom) grow_to(std::max<std::size_t>(size_, 1));
    return Bytes(std::exchange(data_, nullptr), size_);
  }

 private:
  void grow_to(std::size_t room) {
    char* data = static_cast<char*>(std::realloc(data_, room));
    if (data == nullptr) throw std::bad_alloc();
    data_ = data;
    room_ = room;
  }
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t room_ = 0;
};

}  // namespace

Bytes read_bytes(const std::filesystem::path& path, const Context& context, double to) {
  InputFile file(path);
  const std::size_t expected = file.size();
  // One byte more than the size, so that the end of the file is seen without growing.
  GrowingBuffer buffer(std::max(expected + 1, kFirstRoom));
  for (;;) {
    const std::span<char> room = buffer.room();
    const InputFile::Piece piece = file.read(room.first(std::min(room.size(), kChunk)));
    if (piece.ended) return buffer.take();
    buffer.advance(piece.size);
    const double part =
        expected == 0
            ? 0
            : std::min(1.0, static_cast<double>(buffer.size()) / static_cast<double>(expected));
    report_progress(context, "read", part * to);
  }
}

}  // namespace rholm
