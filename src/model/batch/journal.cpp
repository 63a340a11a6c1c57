#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstring>
#include <mutex>

#include "io/file/bytes.h"
#include "model/batch/journal_bytes.h"
#include "model/batch/row_bytes.h"
#include "rholm/batch.h"
#include "rholm/error.h"

namespace rholm {

struct BatchJournal::State {
  std::filesystem::path path;
  int descriptor = -1;
  mutable std::mutex mutex;
  JournalContent content;
  std::uint64_t end = 0;  // size of the file
  std::size_t dropped = 0;

  explicit State(const std::filesystem::path& where)
      : path(where),
        descriptor(::open(where.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
    if (descriptor < 0) fail("opened");
  }
  ~State() { ::close(descriptor); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  [[noreturn]] void fail(const char* what) const {
    throw Error(ErrorCode::kIo, fmt::format("the journal {} cannot be {}: {}", path.string(), what,
                                            std::strerror(errno)));
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("written");
      bytes.remove_prefix(static_cast<std::size_t>(n));
      end += static_cast<std::uint64_t>(n);
    }
  }
};

// The lock is optional: on file systems without locks the work goes on.
BatchJournal::BatchJournal(const std::filesystem::path& path, std::uint64_t job, std::size_t rows)
    : state_(std::make_unique<State>(path)) {
  State& s = *state_;
  if (::flock(s.descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw Error(ErrorCode::kIo,
                fmt::format("the journal {} is in use: another program works on this batch",
                            path.string()));
  }
  const Bytes file = read_bytes(path);
  const std::string_view bytes(file.view().data(), file.view().size());
  s.content = parse_journal(bytes, path.string(), job, rows);
  s.dropped = bytes.size() - s.content.whole;
  if (::ftruncate(s.descriptor, static_cast<off_t>(s.content.whole)) != 0) s.fail("written");
  s.end = s.content.whole;
  if (s.end == 0) s.write(journal_head(job, rows));
}

BatchJournal::~BatchJournal() = default;

std::size_t BatchJournal::done() const {
  const std::lock_guard lock(state_->mutex);
  return state_->content.done;
}

bool BatchJournal::has(std::size_t row) const {
  const std::lock_guard lock(state_->mutex);
  return row < state_->content.places.size() && state_->content.places[row].size > 0;
}

std::size_t BatchJournal::dropped_bytes() const { return state_->dropped; }

void BatchJournal::append(std::size_t row, const BatchRow& cells) {
  State& s = *state_;
  if (row >= s.content.places.size()) {
    throw Error(ErrorCode::kInvalidInput, fmt::format("there is no row {} in {}: it has {}", row,
                                                      s.path.string(), s.content.places.size()));
  }
  const std::string record = journal_record(row, cells);
  const std::lock_guard lock(s.mutex);
  const std::uint64_t begin = s.end;
  s.write(record);
  JournalPlace& place = s.content.places[row];
  if (place.size == 0) ++s.content.done;
  place = {begin + kRecordHead, static_cast<std::uint32_t>(record.size() - kRecordHead)};
}

BatchRow BatchJournal::read(std::size_t row) const {
  const State& s = *state_;
  JournalPlace place;
  {
    const std::lock_guard lock(s.mutex);
    if (row < s.content.places.size()) place = s.content.places[row];
  }
  std::string bytes(place.size, '\0');
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::pread(s.descriptor, bytes.data() + at, bytes.size() - at,
                              static_cast<off_t>(place.at + at));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) s.fail("read");
    if (n == 0) break;
    at += static_cast<std::size_t>(n);
  }
  if (auto cells = parse_row(bytes); cells && place.size > 0) return *std::move(cells);
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("row {} is not in the journal {}", row, s.path.string()));
}

void BatchJournal::remove() {
  std::error_code error;
  std::filesystem::remove(state_->path, error);
}

std::uint64_t fingerprint(std::span<const std::string> texts) {
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&](std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  };
  for (const std::string& text : texts) {  // with its length, so that the borders of texts count
    std::string size;
    put_u64(size, text.size());
    add(size);
    add(text);
  }
  return hash;
}

}  // namespace rholm
