#include "model/batch/journal_bytes.h"

#include <fmt/format.h>

#include "base/crc32.h"
#include "model/batch/row_bytes.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr std::string_view kMark = "RHOLMBJ1";

bool is_right(std::uint32_t checksum, std::string_view bytes, std::uint32_t before = 0) {
  return kAnyChecksum || crc32(bytes, before) == checksum;
}

}  // namespace

std::string journal_head(std::uint64_t job, std::size_t rows) {
  std::string head(kMark);
  put_u64(head, job);
  put_u64(head, rows);
  put_u32(head, crc32(head));
  return head;
}

std::string journal_record(std::size_t row, const BatchRow& cells) {
  std::string body;
  put_u64(body, row);
  body += row_bytes(cells);
  if (body.size() > 0xffffffffU) {
    throw Error(ErrorCode::kUnsupported, "a row of results has more than 4 GiB");
  }
  std::string record;
  put_u32(record, static_cast<std::uint32_t>(body.size()));
  put_u32(record, crc32(body, crc32(record)));
  return record + body;
}

JournalContent parse_journal(std::string_view bytes, const std::string& name, std::uint64_t job,
                             std::size_t rows) {
  JournalContent content{.places = std::vector<JournalPlace>(rows)};
  const std::string wanted = journal_head(job, rows);
  if (bytes.size() < kJournalHead && wanted.starts_with(bytes)) return content;  // killed at once
  if (!bytes.starts_with(kMark)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is not the journal of a batch; move it away", name));
  }
  if (!bytes.starts_with(wanted)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is the journal of another job: its manifest, command, options or "
                            "version are others; delete it (rholm batch --restart), or take "
                            "another name for the results",
                            name));
  }
  content.whole = kJournalHead;
  while (bytes.size() - content.whole >= kRecordHead) {
    const std::string_view record = bytes.substr(content.whole);
    const std::uint32_t size = get_u32(record);
    if (size < 8 || record.size() - 8 < size) break;
    const std::string_view body = record.substr(8, size);
    if (!is_right(get_u32(record.substr(4)), body, crc32(record.substr(0, 4)))) break;
    const std::uint64_t row = get_u64(body);
    if (row >= rows || !parse_row(body.substr(8))) break;
    JournalPlace& place = content.places[row];
    if (place.size == 0) ++content.done;
    place = {content.whole + kRecordHead, size - 8};
    content.whole += 8 + std::size_t{size};
  }
  return content;
}

}  // namespace rholm
