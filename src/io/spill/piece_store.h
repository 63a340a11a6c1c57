// Named pieces of what does not fit into memory at once: in a folder, or in memory where it does.
// Layer: io, private.
//
// A piece is a list of sections, bytes that are read one by one. It is made once, appears whole or
// not at all, and is read many times, by several threads at once. Names are words of letters,
// digits, '-' and '_' with slashes between them: "caps/12".
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rholm {

class PieceContent;
class StoreState;

// A piece that is read; several threads may do so. It can be read on when its store has replaced or
// removed it.
class PieceReader {
 public:
  explicit PieceReader(std::shared_ptr<const PieceContent> content);

  std::size_t n_sections() const;
  std::uint64_t size(std::size_t section) const;  // bytes
  // Throws Io, and InvalidInput if they are not what was written (by their CRC-32).
  std::vector<std::byte> read(std::size_t section) const;
  // The section as numbers in the order of this machine; what is too short for one more is left
  // out. Throws as read().
  template <class T>
  std::vector<T> values(std::size_t section) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> all(size(section) / sizeof(T));
    if (size(section) == all.size() * sizeof(T)) {
      read_into(section, std::as_writable_bytes(std::span(all)));
    } else {
      const std::vector<std::byte> bytes = read(section);
      if (!all.empty()) std::memcpy(all.data(), bytes.data(), all.size() * sizeof(T));
    }
    return all;
  }

 private:
  void read_into(std::size_t section, std::span<std::byte> bytes) const;  // of its size

  std::shared_ptr<const PieceContent> content_;
};

class PieceStore {
 public:
  // In memory.
  PieceStore();
  // In a folder, which is made if it is not there; each piece is a file of it. `manifest` says what
  // the pieces are made of: the input, the options, the version. A folder that has pieces of the
  // same manifest is taken up again: what was whole is there. Throws Io if the folder cannot be
  // made or another process has it; InvalidInput if it has pieces of another manifest, or other
  // files.
  explicit PieceStore(const std::filesystem::path& folder, const std::string& manifest = {});
  // In the folder of a store that another process has made, for as long as that is there. Two
  // processes do not write the same piece at the same time. Throws Io if it is not there.
  static std::unique_ptr<PieceStore> joined(const std::filesystem::path& folder);
  // Removes what it has made, unless it is to be kept.
  ~PieceStore();
  PieceStore(const PieceStore&) = delete;
  PieceStore& operator=(const PieceStore&) = delete;

  bool in_memory() const;
  bool was_there() const;  // the folder, from a run before
  bool has(const std::string& name) const;
  // Replaces an older one. Throws Io.
  void write(const std::string& name, std::span<const std::span<const std::byte>> sections);
  void write(const std::string& name, const std::vector<std::vector<std::byte>>& sections);
  // Throws Io if it is not there, InvalidInput if it is not whole.
  PieceReader open(const std::string& name) const;
  // Does nothing where there is none.
  void remove(const std::string& name);

  // Of all pieces, also those that are being written: now, and at most so far.
  std::uint64_t bytes() const;
  std::uint64_t most_bytes() const;
  // Throws Io if the disk of the folder has less room than that.
  void check_room(std::uint64_t bytes) const;
  // Whether the folder stays, for a run that takes it up again; at first it does not.
  void keep(bool kept);
  bool is_kept() const;

 private:
  friend class PieceAppender;
  std::unique_ptr<StoreState> state_;
};

// Many pieces that grow at once, "GROUP/0" ... "GROUP/(n - 1)", through buffers of limited size.
// finish() makes all of them appear together, in the place of any that have been there, or the
// destructor none. For one thread.
class PieceAppender {
 public:
  // The buffers have `most_bytes` in all; 64 KiB for each piece are good.
  PieceAppender(PieceStore& store, const std::string& group, std::size_t n, std::size_t most_bytes);
  ~PieceAppender();
  PieceAppender(const PieceAppender&) = delete;
  PieceAppender& operator=(const PieceAppender&) = delete;

  // Bytes of one call stay together, in one section; those of several may share it. Throws Io.
  void append(std::size_t piece, std::span<const std::byte> bytes) {
    Buffer& buffer = buffers_[piece];
    if (buffer.used + bytes.size() > buffer.room || bytes.empty()) {
      append_slowly(piece, bytes);
      return;
    }
    std::memcpy(buffer.bytes.get() + buffer.used, bytes.data(), bytes.size());
    buffer.used += bytes.size();
  }
  // A section of its own. Throws Io.
  void append_section(std::size_t piece, std::span<const std::byte> bytes);
  void finish();  // the last call; throws Io

 private:
  class Output;
  struct Buffer {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t room = 0, used = 0;
  };
  void append_slowly(std::size_t piece, std::span<const std::byte> bytes);
  void flush(std::size_t piece);

  std::unique_ptr<Output> output_;
  std::vector<Buffer> buffers_;
  std::size_t block_ = 0;      // bytes of a buffer
  std::size_t most_ = 0;       // buffers
  std::size_t n_buffers_ = 0;  // that have memory
};

// Numbers as bytes, in the order of this machine, and back; what is too short for one more is left
// out.
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

// A piece of one section.
template <class T>
void write_values(PieceStore& store, const std::string& name, const std::vector<T>& values) {
  const std::span<const std::byte> sections[] = {bytes_of(values)};
  store.write(name, sections);
}
template <class T>
std::vector<T> read_values(const PieceStore& store, const std::string& name) {
  return store.open(name).values<T>(0);
}

}  // namespace rholm
