// Stores values by name, in memory or in a folder, for the parts of a task. Layer: parts, private.
//
// A piece is a list of sections; a section is bytes that are read together. A piece is made once,
// appears whole or not at all, and is read many times, by several threads at once. Names are words
// of letters, digits, '-' and '_', separated by slashes: "caps/12".
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rholm {

// The stored content of a piece.
class PieceContent {
 public:
  PieceContent() = default;
  virtual ~PieceContent() = default;
  PieceContent(const PieceContent&) = delete;
  PieceContent& operator=(const PieceContent&) = delete;

  virtual std::size_t n_sections() const = 0;
  virtual std::uint64_t size(std::size_t section) const = 0;  // in bytes
  // Returns the bytes in memory, valid as long as this object; null if they are in a file.
  virtual const std::byte* place(std::size_t section) const = 0;
  // Throws Io, and InvalidInput if the bytes differ from the bytes written.
  virtual void read(std::size_t section, std::span<std::byte> bytes) const = 0;
};

// The numbers of a piece: a view of memory without a copy, or a vector read from a file.
template <class T>
class PieceValues {
 public:
  using value_type = T;  // NOLINT(readability-identifier-naming): as containers have it

  PieceValues(std::shared_ptr<const PieceContent> content, std::span<const T> values)
      : content_(std::move(content)), values_(values) {}
  explicit PieceValues(std::vector<T> read) : read_(std::move(read)), values_(read_) {}
  PieceValues(PieceValues&&) noexcept = default;  // the buffer of a moved vector stays in place
  PieceValues& operator=(PieceValues&&) noexcept = default;
  PieceValues(const PieceValues&) = delete;
  PieceValues& operator=(const PieceValues&) = delete;
  ~PieceValues() = default;

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  const T* data() const { return values_.data(); }
  const T* begin() const { return values_.data(); }
  const T* end() const { return values_.data() + values_.size(); }
  const T& operator[](std::size_t i) const { return values_[i]; }
  const T& front() const { return values_.front(); }
  const T& at(std::size_t i) const {
    if (i >= values_.size()) throw std::out_of_range("a piece has fewer values");
    return values_[i];
  }
  // Converts to a vector that can be changed: numbers in memory are copied.
  operator std::vector<T>() && {  // NOLINT(misc-explicit-constructor)
    return content_ ? std::vector<T>(begin(), end()) : std::move(read_);
  }

 private:
  std::shared_ptr<const PieceContent> content_;
  std::vector<T> read_;
  std::span<const T> values_;
};

// Reads a piece; several threads may use one reader. It stays readable after its store has replaced
// or removed the piece.
class PieceReader {
 public:
  explicit PieceReader(std::shared_ptr<const PieceContent> content)
      : content_(std::move(content)) {}

  std::size_t n_sections() const { return content_->n_sections(); }
  std::uint64_t size(std::size_t section) const { return content_->size(section); }  // in bytes
  // Throws Io, and InvalidInput if the bytes differ from the bytes written.
  std::vector<std::byte> read(std::size_t section) const {
    std::vector<std::byte> bytes(size(section));
    content_->read(section, bytes);
    return bytes;
  }
  // Returns the section as numbers in this machine's byte order. Bytes at the end that are too few
  // for a number are left out. Throws like read().
  template <class T>
  PieceValues<T> values(std::size_t section) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t n = size(section) / sizeof(T);
    const std::byte* place = content_->place(section);
    if (place != nullptr && reinterpret_cast<std::uintptr_t>(place) % alignof(T) == 0) {
      return {content_, std::span(reinterpret_cast<const T*>(place), n)};
    }
    std::vector<T> all(n);
    if (size(section) == n * sizeof(T)) {
      content_->read(section, std::as_writable_bytes(std::span(all)));
    } else {
      const std::vector<std::byte> bytes = read(section);
      if (n > 0) std::memcpy(all.data(), bytes.data(), n * sizeof(T));
    }
    return PieceValues<T>(std::move(all));
  }

 private:
  std::shared_ptr<const PieceContent> content_;
};

// Bytes of a section to be written. A store in memory keeps bytes with an owner without a copy.
struct SectionBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner = {};
};

// Number of bytes of all pieces, also of pieces that are being written. Any thread may use it.
class PieceBytes {
 public:
  void add(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    now_ += bytes;
    most_ = std::max(most_, now_);
  }
  void take(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    now_ -= std::min(bytes, now_);
  }
  std::uint64_t now() const {
    const std::lock_guard lock(mutex_);
    return now_;
  }
  std::uint64_t most() const {
    const std::lock_guard lock(mutex_);
    return most_;
  }

 private:
  mutable std::mutex mutex_;
  std::uint64_t now_ = 0, most_ = 0;
};

// Pieces "GROUP/0" ... "GROUP/(n - 1)" that grow section by section. finish() makes all appear
// together and replaces any older ones. Without finish(), the destructor drops them.
class GrowingPieces {
 public:
  GrowingPieces() = default;
  virtual ~GrowingPieces() = default;
  GrowingPieces(const GrowingPieces&) = delete;
  GrowingPieces& operator=(const GrowingPieces&) = delete;

  // Both throw Io.
  virtual void append(std::size_t piece, std::span<const std::byte> section) = 0;
  virtual void finish() = 0;
};

class PieceStore {
 public:
  PieceStore() = default;
  virtual ~PieceStore() = default;
  PieceStore(const PieceStore&) = delete;
  PieceStore& operator=(const PieceStore&) = delete;

  virtual bool in_memory() const = 0;
  virtual bool has(const std::string& name) const = 0;
  // Writes a piece, replacing an older one. Throws Io.
  virtual void write(const std::string& name, std::vector<SectionBytes> sections) = 0;
  void write(const std::string& name, std::span<const std::span<const std::byte>> sections);
  void write(const std::string& name, std::vector<std::vector<std::byte>> sections);
  // Throws Io if the piece is not there, InvalidInput if it is not whole.
  virtual PieceReader open(const std::string& name) const = 0;
  // Does nothing where there is no such piece.
  virtual void remove(const std::string& name) = 0;
  virtual std::unique_ptr<GrowingPieces> grow(const std::string& group, std::size_t n) = 0;

  // Number of bytes of all pieces, also of those being written: now, and the maximum so far.
  std::uint64_t bytes() const { return bytes_.now(); }
  std::uint64_t most_bytes() const { return bytes_.most(); }
  // Throws Io if there is room for fewer bytes.
  virtual void check_room(std::uint64_t bytes) const = 0;
  // Sets whether pieces stay for a run that resumes this one. At first they do not, and in memory
  // they never do.
  virtual void keep(bool kept) = 0;
  virtual bool is_kept() const = 0;

 protected:
  PieceBytes bytes_;
};

// Throws InvalidInput for a name that no piece may have.
void check_piece_name(const std::string& name);

// Pieces that grow at the same time through buffers of limited size. For one thread.
class PieceAppender {
 public:
  // All buffers together have `most_bytes`; 64 KiB for each piece are good.
  PieceAppender(PieceStore& store, const std::string& group, std::size_t n, std::size_t most_bytes);

  // Bytes of one call stay together in one section; several calls may share a section. Throws Io.
  void append(std::size_t piece, std::span<const std::byte> bytes) {
    Buffer& buffer = buffers_[piece];
    if (buffer.used + bytes.size() > buffer.room || bytes.empty()) {
      append_slowly(piece, bytes);
      return;
    }
    std::memcpy(buffer.bytes.get() + buffer.used, bytes.data(), bytes.size());
    buffer.used += bytes.size();
  }
  // Appends a section of its own. Throws Io.
  void append_section(std::size_t piece, std::span<const std::byte> bytes);
  void finish();  // the last call; throws Io

 private:
  struct Buffer {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t room = 0, used = 0;
  };
  void append_slowly(std::size_t piece, std::span<const std::byte> bytes);
  void flush(std::size_t piece);

  std::unique_ptr<GrowingPieces> pieces_;
  std::vector<Buffer> buffers_;
  std::size_t block_ = 0;      // bytes of a buffer
  std::size_t most_ = 0;       // largest number of buffers
  std::size_t n_buffers_ = 0;  // number of buffers that have memory
};

// Converts numbers to bytes, in this machine's byte order, and back. Bytes at the end that are too
// few for a number are left out.
template <class T>
std::span<const std::byte> bytes_of(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T>);
  return std::as_bytes(values);
}
template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return bytes_of(std::span<const T>(values));
}

template <class T>
std::vector<T> vector_of(std::span<const std::byte> bytes) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

// Writes a piece of one section. A store in memory keeps a vector that is moved in without a copy.
template <class T>
void write_values(PieceStore& store, const std::string& name, std::vector<T>&& values) {
  values.shrink_to_fit();
  const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  std::vector<SectionBytes> sections;
  sections.push_back({bytes_of(*owner), owner});
  store.write(name, std::move(sections));
}
template <class T>
void write_values(PieceStore& store, const std::string& name, const std::vector<T>& values) {
  const std::span<const std::byte> sections[] = {bytes_of(values)};
  store.write(name, sections);
}
template <class T>
PieceValues<T> read_values(const PieceStore& store, const std::string& name) {
  return store.open(name).values<T>(0);
}

}  // namespace rholm
