#include "io/spill/folder_store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "io/spill/piece_file.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Returns the bytes of a file, or 0 if there is no file.
std::uint64_t size_of_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw Error(ErrorCode::kIo,
              fmt::format("cannot write {}: {}", path.string(), std::strerror(error)));
}

// Writes the file of a piece. Files of a run that may be resumed survive a crash of the machine.
void write_piece(const std::filesystem::path& path, const std::vector<SectionBytes>& sections,
                 bool resumable) {
  SpillFile file(path, SpillFile::Mode::kNew);
  file.write(piece_head());
  std::vector<PieceSection> table;
  for (const SectionBytes& section : sections) {
    file.write(section.bytes);
    table.push_back(section_of(section.bytes));
  }
  file.write(piece_tail(table));
  if (resumable) file.sync();
  file.close();
}

// Reads sections from an open file.
class FileContent final : public PieceContent {
 public:
  explicit FileContent(const std::filesystem::path& path) : file_(path, SpillFile::Mode::kRead) {
    sections_ = parse_piece(
        file_.size(), file_.name(),
        [&](std::uint64_t at, std::span<std::byte> bytes) { return file_.read(at, bytes); });
    starts_.reserve(sections_.size());
    std::uint64_t at = kPieceHead;
    for (const PieceSection& section : sections_) {
      starts_.push_back(at);
      at += section.size;
    }
  }

  std::size_t n_sections() const override { return sections_.size(); }
  std::uint64_t size(std::size_t section) const override { return sections_.at(section).size; }
  const std::byte* place(std::size_t) const override { return nullptr; }
  void read(std::size_t section, std::span<std::byte> bytes) const override {
    const bool there = file_.read(starts_.at(section), bytes);
    check_section(sections_[section], there ? bytes : bytes.first(0), file_.name());
  }

 private:
  SpillFile file_;
  std::vector<PieceSection> sections_;
  std::vector<std::uint64_t> starts_;
};

}  // namespace

// A folder of files, each open only while it is written to, which gets its name at the end.
class FolderStore::Growing final : public GrowingPieces {
 public:
  Growing(FolderStore& store, std::string group, std::size_t n)
      : store_(store), group_(std::move(group)), part_(store_.part_of(group_)), tables_(n) {
    std::error_code error;
    std::filesystem::create_directories(part_, error);
    if (error) fail(part_, error.value());
  }
  ~Growing() override {
    if (done_) return;
    store_.bytes_.take(bytes_);
    std::error_code ignored;
    std::filesystem::remove_all(part_, ignored);
  }
  Growing(const Growing&) = delete;
  Growing& operator=(const Growing&) = delete;

  void append(std::size_t piece, std::span<const std::byte> section) override {
    append_to_file(piece, section);
    tables_[piece].push_back(section_of(section));
  }

  void finish() override {
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
    store_.bytes_.take(before);
    done_ = true;
  }

 private:
  void count(std::size_t bytes) {
    bytes_ += bytes;
    store_.bytes_.add(bytes);
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

  FolderStore& store_;
  std::string group_;
  std::filesystem::path part_;
  std::vector<std::vector<PieceSection>> tables_;
  std::uint64_t bytes_ = 0;
  bool done_ = false;
};

FolderStore::FolderStore(const std::filesystem::path& folder, const std::string& manifest)
    : FolderStore(std::make_unique<SpillFolder>(folder, manifest)) {
  bytes_.add(folder_->bytes_there());
}

std::unique_ptr<FolderStore> FolderStore::joined(const std::filesystem::path& folder) {
  return std::unique_ptr<FolderStore>(new FolderStore(std::make_unique<SpillFolder>(folder)));
}

bool FolderStore::has(const std::string& name) const {
  check_piece_name(name);
  std::error_code error;
  return std::filesystem::is_regular_file(path_of(name), error);
}

void FolderStore::write(const std::string& name, std::vector<SectionBytes> sections) {
  check_piece_name(name);
  const std::filesystem::path path = path_of(name), part = part_of(name);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error) fail(path.parent_path(), error.value());
  try {
    write_piece(part, sections, is_kept());
    bytes_.add(size_of_file(part));
    const std::uint64_t before = size_of_file(path);
    if (::rename(part.c_str(), path.c_str()) != 0) fail(path, errno);
    bytes_.take(before);
  } catch (...) {
    ::unlink(part.c_str());
    throw;
  }
}

PieceReader FolderStore::open(const std::string& name) const {
  check_piece_name(name);
  return PieceReader(std::make_shared<const FileContent>(path_of(name)));
}

void FolderStore::remove(const std::string& name) {
  check_piece_name(name);
  const std::filesystem::path path = path_of(name);
  const std::uint64_t bytes = size_of_file(path);
  if (::unlink(path.c_str()) == 0) {
    bytes_.take(bytes);
  } else if (errno != ENOENT && errno != ENOTDIR) {
    throw Error(ErrorCode::kIo,
                fmt::format("cannot remove {}: {}", path.string(), std::strerror(errno)));
  }
}

std::unique_ptr<GrowingPieces> FolderStore::grow(const std::string& group, std::size_t n) {
  check_piece_name(group);
  return std::make_unique<Growing>(*this, group, n);
}

}  // namespace rholm
