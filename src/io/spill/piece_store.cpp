#include "io/spill/piece_store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "base/refuse.h"
#include "io/spill/store_state.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Bytes of a file; none if it is not there.
std::uint64_t size_of_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Error(ErrorCode::kIo,
              fmt::format("cannot write {}: {}", path.string(), std::strerror(error)));
}

// Those of a run that may be resumed outlive the machine's end.
void write_piece(const std::filesystem::path& path,
                 std::span<const std::span<const std::byte>> sections, bool resumable) {
  SpillFile file(path, SpillFile::Mode::kNew);
  file.write(piece_head());
  std::vector<PieceSection> table;
  for (const std::span<const std::byte> section : sections) {
    file.write(section);
    table.push_back(section_of(section));
  }
  file.write(piece_tail(table));
  if (resumable) file.sync();
  file.close();
}

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

PieceReader::PieceReader(std::shared_ptr<const PieceContent> content)
    : content_(std::move(content)) {}

std::size_t PieceReader::n_sections() const {
  return content_->file ? content_->sections.size() : content_->memory.size();
}

std::uint64_t PieceReader::size(std::size_t section) const {
  return content_->file ? content_->sections.at(section).size : content_->memory.at(section).size();
}

std::vector<std::byte> PieceReader::read(std::size_t section) const {
  std::vector<std::byte> bytes(size(section));
  read_into(section, bytes);
  return bytes;
}

void PieceReader::read_into(std::size_t section, std::span<std::byte> bytes) const {
  if (!content_->file) {
    const std::vector<std::byte>& all = content_->memory.at(section);
    std::copy(all.begin(), all.end(), bytes.begin());
    return;
  }
  const bool there = content_->file->read(content_->starts.at(section), bytes);
  check_section(content_->sections[section], there ? bytes : bytes.first(0),
                content_->file->name());
}

PieceStore::PieceStore() : state_(std::make_unique<StoreState>()) {}

PieceStore::PieceStore(const std::filesystem::path& folder, const std::string& manifest)
    : PieceStore() {
  state_->folder.emplace(folder, manifest);
  state_->add(state_->folder->bytes_there());
}

PieceStore::~PieceStore() = default;

std::unique_ptr<PieceStore> PieceStore::joined(const std::filesystem::path& folder) {
  auto store = std::make_unique<PieceStore>();
  store->state_->folder.emplace(folder);
  return store;
}

bool PieceStore::in_memory() const { return !state_->folder; }
bool PieceStore::was_there() const { return state_->folder && state_->folder->was_there(); }

bool PieceStore::has(const std::string& name) const {
  check_piece_name(name);
  if (state_->folder) {
    std::error_code error;
    return std::filesystem::is_regular_file(state_->path_of(name), error);
  }
  const std::lock_guard lock(state_->mutex);
  return state_->pieces.contains(name);
}

void PieceStore::write(const std::string& name,
                       const std::vector<std::vector<std::byte>>& sections) {
  const std::vector<std::span<const std::byte>> spans(sections.begin(), sections.end());
  write(name, spans);
}

void PieceStore::write(const std::string& name,
                       std::span<const std::span<const std::byte>> sections) {
  check_piece_name(name);
  StoreState& s = *state_;
  if (!s.folder) {
    auto made = std::make_shared<PieceContent>();
    for (const std::span<const std::byte> section : sections) {
      made->memory.emplace_back(section.begin(), section.end());
    }
    const std::uint64_t bytes = made->bytes();
    std::shared_ptr<const PieceContent> piece = std::move(made);
    {
      const std::lock_guard lock(s.mutex);
      s.pieces[name].swap(piece);
    }
    s.add(bytes);
    if (piece) s.take(piece->bytes());
    return;
  }
  const std::filesystem::path path = s.path_of(name), part = s.part_of(name);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(path.parent_path(), error.value());
  try {
    write_piece(part, sections, is_kept());
    s.add(size_of_file(part));
    const std::uint64_t before = size_of_file(path);
    if (::rename(part.c_str(), path.c_str()) != 0) fail(path, errno);
    s.take(before);
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
}

PieceReader PieceStore::open(const std::string& name) const {
  check_piece_name(name);
  if (!state_->folder) {
    const std::lock_guard lock(state_->mutex);
    const auto found = state_->pieces.find(name);
    if (found != state_->pieces.end()) return PieceReader(found->second);
    throw Error(ErrorCode::kIo, "there is no piece " + name);
  }
  auto content = std::make_shared<PieceContent>();
  content->file = std::make_unique<SpillFile>(state_->path_of(name), SpillFile::Mode::kRead);
  const SpillFile& file = *content->file;
  content->sections = parse_piece(
      file.size(), file.name(),
      [&](std::uint64_t at, std::span<std::byte> bytes) { return file.read(at, bytes); });
  content->starts.reserve(content->sections.size());
  std::uint64_t at = kPieceHead;
  for (const PieceSection& section : content->sections) {
    content->starts.push_back(at);
    at += section.size;
  }
  return PieceReader(std::move(content));
}

void PieceStore::remove(const std::string& name) {
  check_piece_name(name);
  if (!state_->folder) {
    std::shared_ptr<const PieceContent> gone;
    {
      const std::lock_guard lock(state_->mutex);
      const auto found = state_->pieces.find(name);
      if (found == state_->pieces.end()) return;
      gone = std::move(found->second);
      state_->pieces.erase(found);
    }
    state_->take(gone->bytes());
    return;
  }
  const std::filesystem::path path = state_->path_of(name);
  const std::uint64_t bytes = size_of_file(path);
  if (::unlink(path.c_str()) == 0) {
    state_->take(bytes);
  } else if (errno != ENOENT && errno != ENOTDIR) {
    throw Error(ErrorCode::kIo,
                fmt::format("cannot remove {}: {}", path.string(), std::strerror(errno)));
  }
}

std::uint64_t PieceStore::bytes() const { return state_->bytes(); }
std::uint64_t PieceStore::most_bytes() const { return state_->most(); }

void PieceStore::check_room(std::uint64_t bytes) const {
  if (state_->folder) state_->folder->check_room(bytes);
}

void PieceStore::keep(bool kept) {
  if (state_->folder) state_->folder->keep(kept);
}

bool PieceStore::is_kept() const { return state_->folder && state_->folder->is_kept(); }

}  // namespace rholm
