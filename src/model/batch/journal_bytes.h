// The file of a BatchJournal. Layer: model, private.
//
// It begins with "RHOLMBJ1", the job (8 bytes), the number of rows (8) and the CRC-32 of these 24
// bytes. A record has its number of bytes after the checksum (4) and the CRC-32 of this number and
// these bytes (4). The bytes are the row's index (8) and the row (row_bytes.h). All little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rholm/batch.h"

namespace rholm {

inline constexpr std::size_t kJournalHead = 28;
inline constexpr std::size_t kRecordHead = 16;

std::string journal_head(std::uint64_t job, std::size_t rows);
std::string journal_record(std::size_t row, const BatchRow& cells);

// Position and size of a row, without the head of the record; size 0: there is none.
struct JournalPlace {
  std::uint64_t at = 0;
  std::uint32_t size = 0;
};
struct JournalContent {
  std::vector<JournalPlace> places;  // for all rows
  std::size_t done = 0;
  std::size_t whole = 0;  // bytes before any damaged or incomplete part; 0: the head is incomplete
};
// Throws InvalidInput (`name` is the file) for the journal of another job, and for other files.
JournalContent parse_journal(std::string_view bytes, const std::string& name, std::uint64_t job,
                             std::size_t rows);

}  // namespace rholm
