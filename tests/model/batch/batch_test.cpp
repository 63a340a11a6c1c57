#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/random.h"
#include "io/coefficients/test_support.h"
#include "io/shapes/test_support.h"
#include "model/batch/csv.h"
#include "model/batch/journal_bytes.h"
#include "model/batch/row_bytes.h"
#include "model/batch/table_parts.h"
#include "rholm/batch.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using coefficients_testing::error_code;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Manifest manifest_of(const std::string& text) { return parse_manifest(text, "list.csv"); }

void expect_refused(const std::string& text, const std::string& words) {
  EXPECT_EQ(error_code([&] { manifest_of(text); }, words), ErrorCode::kInvalidInput) << text;
}

TEST(Manifest, fields_are_what_rfc_4180_says) {
  const Manifest m = manifest_of(
      "\xef\xbb\xbfid,path,note\r\n"
      "1,a.ply,\"one, two\"\r\n"
      "\n"
      "2,\"b \"\"B\"\".ply\",\"two\nlines\"\n"
      "3,c.ply,");
  ASSERT_EQ(m.columns, std::vector<std::string>{"note"});
  ASSERT_EQ(m.items.size(), 3U);
  EXPECT_EQ(m.items[0].values[0], "one, two");
  EXPECT_EQ(m.items[1].path, "b \"B\".ply");
  EXPECT_EQ(m.items[1].values[0], "two\nlines");
  EXPECT_EQ(m.items[2].id, "3");
  EXPECT_EQ(m.items[2].values[0], "");
  EXPECT_EQ(manifest_of("path\na.ply\n").items[0].id, "a.ply");
}

TEST(Manifest, what_is_wrong_is_refused_with_its_line) {
  expect_refused("", "is empty");
  expect_refused("\n\n", "is empty");
  expect_refused("file\na.ply\n", "no column 'path'");
  expect_refused("path\n", "no shapes");
  expect_refused("path,path\na,b\n", "two columns");
  expect_refused("path,\na,b\n", "has no name");
  expect_refused("path,a/b\na,b\n", "without a slash");
  expect_refused("path,exit_code\na,b\n", "of their own");
  expect_refused("path,coefficients\na,b\n", "of their own");
  expect_refused("path\na\nb\na\n", "line 4");
  expect_refused("id,path\n1,a\n1,b\n", "line 3");
  expect_refused("id,path\n1,\n", "path is empty");
  expect_refused("id,path\n,a\n", "id is empty");
  expect_refused("id,path\n1,a,2\n", "3 fields");
  expect_refused("path\n\"a\n", "line 2: the quote that opens");
  expect_refused("path\na\"b\n", "line 2: a quote within");
  expect_refused("path\n\"a\"b\n", "behind the quote");
  expect_refused("path\n\xff.ply\n", "UTF-8");
  expect_refused(std::string("path\na\0b\n", 9), "UTF-8");
  const std::string longest(kMaxManifestField, 'x');
  EXPECT_EQ(manifest_of("path\n" + longest).items[0].path, longest);
  expect_refused("path\n" + longest + "x", "more than 65536 bytes");
}

TEST(Manifest, any_field_survives_being_written_and_read) {
  const std::string letters = "a,\"\r\n \xc3\xa9";
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    std::string field = "x";
    const auto n = static_cast<std::size_t>(8 * random_uniform(seed, 0));
    for (std::size_t i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(7 * random_uniform(seed, 1 + i));
      field += k == 6 ? letters.substr(6, 2) : letters.substr(k, 1);
    }
    const std::string text = "note,path\n" + csv_field(field) + ",a\n";
    EXPECT_EQ(manifest_of(text).items[0].values[0], field) << text;
  }
}

TEST(Csv, texts_like_formulas_have_an_apostrophe) {
  for (const char* text :
       {"=1+1", "+cmd", "-x.ply", "@sum", "'=1", "''-x", "-", "\t=1", "= \"a\",b"}) {
    const std::string field = csv_field(text);
    EXPECT_EQ(field.find_first_not_of('"'), field.find('\'')) << field;
    EXPECT_EQ(manifest_of("note,path\n" + field + ",a\n").items[0].values[0], text) << field;
  }
  // Numbers and other texts stay unchanged, also texts that begin with an apostrophe.
  for (const char* text : {"-1", "+2.5e-3", "1=1", "a@b", "'tis", "'", ""}) {
    EXPECT_EQ(csv_field(text), text);
    EXPECT_EQ(manifest_of(std::string("note,path\n") + text + ",a\n").items[0].values[0], text);
  }
  EXPECT_EQ(csv_field("=1+1", true), "=1+1");
}

// A manifest that is cut or has a flipped bit anywhere is read or refused.
TEST(Manifest, damaged_text_is_read_or_refused) {
  const std::string whole = "id,path,note\n1,a.ply,\"one, \"\"two\"\"\"\r\n2,\"b.ply\",\xc3\xa9\n";
  std::size_t read = 0, refused = 0;
  const auto look = [&](const std::string& text) {
    try {
      manifest_of(text);
      ++read;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
      EXPECT_STRNE(error.what(), "");
      ++refused;
    }
  };
  for (std::size_t n = 0; n < whole.size(); ++n) look(whole.substr(0, n));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string text = whole;
    text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << bit % 8));
    look(text);
  }
  EXPECT_GT(read, 50U);
  EXPECT_GT(refused, 50U);
}

TEST(Utf8, takes_what_unicode_defines_and_no_more) {
  for (const char* good :
       {"", "a", "\xc2\x80", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(is_utf8(good)) << good;
  }
  for (const char* bad : {"\x80", "\xc1\xbf", "\xc2", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xe2\x82",
                          "\xf4\x90\x80\x80", "\xf0\x8f\xbf\xbf", "\xf5\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bad)) << bad;
  }
}

BatchRow some_row(std::size_t i) {
  return {{"exit_code", std::int64_t{0}},
          {"area", 1.0 / static_cast<double>(i + 1)},
          {"closed", i % 2 == 0},
          {"name", std::string("r\xc3\xa9") + std::to_string(i)},
          {"list", std::vector<double>{1.5, kNone, static_cast<double>(i)}}};
}

void expect_same(const BatchRow& a, const BatchRow& b) { EXPECT_EQ(row_bytes(a), row_bytes(b)); }

TEST(RowBytes, round_trip_and_no_byte_may_be_missing) {
  const std::string bytes = row_bytes(some_row(3));
  ASSERT_TRUE(parse_row(bytes));
  expect_same(*parse_row(bytes), some_row(3));
  for (std::size_t n = 0; n < bytes.size(); ++n) EXPECT_FALSE(parse_row(bytes.substr(0, n))) << n;
  EXPECT_FALSE(parse_row(bytes + "x"));
}

TEST(BatchJournal, what_was_added_is_there_when_opened_again) {
  const TemporaryFolder folder;
  for (std::size_t round = 0; round < 3; ++round) {
    BatchJournal journal(folder / "j", 7, 6);
    EXPECT_EQ(journal.done(), 2 * round);
    EXPECT_EQ(journal.dropped_bytes(), 0U);
    for (const std::size_t row : {5 - 2 * round, 4 - 2 * round}) {
      EXPECT_FALSE(journal.has(row));
      journal.append(row, some_row(row));
      expect_same(journal.read(row), some_row(row));
    }
  }
  BatchJournal journal(folder / "j", 7, 6);
  for (std::size_t row = 0; row < 6; ++row) expect_same(journal.read(row), some_row(row));
  EXPECT_EQ(error_code([&] { journal.append(6, {}); }, "no row 6"), ErrorCode::kInvalidInput);
  journal.remove();
  EXPECT_FALSE(std::filesystem::exists(folder / "j"));
}

TEST(BatchJournal, that_of_another_job_is_refused_and_stays) {
  const TemporaryFolder folder;
  { BatchJournal(folder / "j", 7, 6).append(0, some_row(0)); }
  const std::string before = read_all(folder / "j");
  const auto open = [&](std::uint64_t job, std::size_t rows) {
    return [&folder, job, rows] { BatchJournal(folder / "j", job, rows); };
  };
  EXPECT_EQ(error_code(open(8, 6), "another job"), ErrorCode::kInvalidInput);
  EXPECT_EQ(error_code(open(7, 5), "another job"), ErrorCode::kInvalidInput);
  EXPECT_EQ(read_all(folder / "j"), before);
  write_all(folder / "j", "no journal at all, but somebody's notes");
  EXPECT_EQ(error_code(open(7, 6), "not the journal"), ErrorCode::kInvalidInput);
}

TEST(BatchJournal, one_program_at_a_time) {
  const TemporaryFolder folder;
  const BatchJournal journal(folder / "j", 7, 6);
  EXPECT_EQ(error_code([&] { BatchJournal(folder / "j", 7, 6); }, "in use"), ErrorCode::kIo);
}

std::string journal_of(std::size_t rows) {
  std::string bytes = journal_head(7, rows);
  for (std::size_t row = 0; row < rows; ++row) bytes += journal_record(row, some_row(row));
  return bytes;
}

// A journal that is cut anywhere keeps exactly its complete rows and is continued from there.
TEST(BatchJournal, a_torn_record_is_dropped_and_those_before_it_are_kept) {
  const std::string whole = journal_of(4);
  std::vector<std::size_t> ends = {kJournalHead};
  for (std::size_t row = 0; row < 4; ++row) {
    ends.push_back(ends.back() + journal_record(row, some_row(row)).size());
  }
  for (std::size_t n = 0; n <= whole.size(); ++n) {
    const JournalContent content = parse_journal(whole.substr(0, n), "j", 7, 4);
    std::size_t done = 0;
    while (done < 4 && ends[done + 1] <= n) ++done;
    EXPECT_EQ(content.done, done) << n;
    EXPECT_EQ(content.whole, n < kJournalHead ? 0 : ends[done]) << n;
  }
  const TemporaryFolder folder;
  write_all(folder / "j", whole.substr(0, ends[2] + 5));
  {
    BatchJournal journal(folder / "j", 7, 4);
    EXPECT_EQ(journal.done(), 2U);
    EXPECT_EQ(journal.dropped_bytes(), 5U);
    for (const std::size_t row : {2, 3}) journal.append(row, some_row(row));
  }
  EXPECT_EQ(read_all(folder / "j"), whole);
}

// A flipped bit invalidates a record and never changes its values: CRC-32 detects every single
// flipped bit.
TEST(BatchJournal, no_flipped_bit_is_believed) {
  const std::string whole = journal_of(3);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << bit % 8));
    if (bit / 8 < kJournalHead) {
      EXPECT_EQ(error_code([&] { parse_journal(bytes, "j", 7, 3); }, "j is"),
                ErrorCode::kInvalidInput);
      continue;
    }
    const JournalContent content = parse_journal(bytes, "j", 7, 3);
    EXPECT_LT(content.done, 3U) << bit;
    for (std::size_t row = 0; row < content.done; ++row) {
      const JournalPlace& place = content.places[row];
      const auto cells = parse_row(std::string_view(bytes).substr(place.at, place.size));
      ASSERT_TRUE(cells);
      expect_same(*cells, some_row(row));
    }
  }
}

TEST(ColumnOrder, numbers_within_names_count_as_numbers) {
  const std::vector<std::string> sorted = {"a", "a.2", "a.10", "a.010", "a.11", "a.b", "ab", "b"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      const bool expected = (sorted[i] == "a.10" && sorted[j] == "a.010")   ? false
                            : (sorted[i] == "a.010" && sorted[j] == "a.10") ? true
                                                                            : i < j;
      EXPECT_EQ(column_before(sorted[i], sorted[j]), expected) << sorted[i] << ' ' << sorted[j];
    }
  }
}

const std::vector<BatchRow> kRows = {
    {{"id", std::string("a")}, {"n", std::int64_t{1}}, {"mixed", true}, {"all", std::int64_t{-5}}},
    {{"id", std::string("b,\"")}, {"x", 0.1}, {"mixed", std::int64_t{2}}, {"all", std::int64_t{7}}},
    {{"id", std::string("c")},
     {"n", 2.5},
     {"list", std::vector<double>{1, 2, kNone}},
     {"all", std::int64_t{0}},
     {"flag", false},
     {"never", kNone}},
    {{"id", std::string("d")},
     {"list", std::vector<double>{kNone, 4}},
     {"all", std::int64_t{1}},
     {"text", std::string("\xc3\xa9")},
     {"list.one", 3.0}}};

BatchTable table_of(const std::vector<std::size_t>& rows) {
  const std::vector<std::string> leading = {"id"};
  BatchTable table =
      gather_batch(leading, rows.size(), [&](std::size_t i) { return kRows[rows[i]]; });
  table.about = {{"command", "info"}};
  return table;
}

TEST(BatchTable, a_column_is_what_all_its_values_are) {
  const BatchTable table = table_of({0, 1, 2, 3});
  std::vector<std::string> names;
  names.reserve(table.columns.size());
  for (const BatchColumn& column : table.columns) names.push_back(column.name);
  EXPECT_EQ(names, (std::vector<std::string>{"id", "all", "flag", "list", "list.one", "mixed", "n",
                                             "text", "x"}));
  EXPECT_EQ(std::get<1>(table.find("all")->values), (std::vector<std::int64_t>{-5, 7, 0, 1}));
  EXPECT_EQ(std::get<0>(table.find("flag")->values), (std::vector<std::int8_t>{-1, -1, 0, -1}));
  EXPECT_EQ(std::get<3>(table.find("mixed")->values),
            (std::vector<std::string>{"true", "2", "", ""}));
  const auto& n = std::get<2>(table.find("n")->values);
  EXPECT_EQ(n[0], 1.0);
  EXPECT_TRUE(std::isnan(n[1]));
  EXPECT_EQ(table.find("list")->width, 2U);
  EXPECT_EQ(std::get<2>(table.find("list")->values)[7], 4.0);
}

TEST(BatchTable, csv_has_a_column_for_each_number_of_a_list) {
  EXPECT_EQ(table_csv(table_of({0, 1, 2, 3}), true),
            "id,all,flag,list.0,list.1,list.one,mixed,n,text,x\n"
            "a,-5,,,,,true,1,,\n"
            "\"b,\"\"\",7,,,,,2,,,0.1\n"
            "c,0,false,1,2,,,2.5,,\n"
            "d,1,,,4,3,,,\xc3\xa9,\n");
}

TEST(BatchTable, files_keep_what_there_is) {
  const TemporaryFolder folder;
  for (const auto& rows : {std::vector<std::size_t>{0, 1, 2, 3}, {1}, {}}) {
    const BatchTable table = table_of(rows);
    write_batch(table, folder / "a.h5");
    const BatchTable back = read_batch(folder / "a.h5");
    EXPECT_EQ(back.about, table.about);
    EXPECT_EQ(back.leading, table.leading);
    EXPECT_EQ(table_csv(back, true), table_csv(table, true));
    write_batch(back, folder / "b.h5");
    EXPECT_EQ(read_all(folder / "b.h5"), read_all(folder / "a.h5"));
    write_batch(table, folder / "a.csv");
    write_batch(read_batch(folder / "a.csv"), folder / "b.csv");
    EXPECT_EQ(read_all(folder / "b.csv"), read_all(folder / "a.csv"));
  }
  EXPECT_EQ(error_code([&] { write_batch(table_of({0}), folder / "a.xls"); }, ".csv"),
            ErrorCode::kInvalidInput);
}

TEST(BatchTable, names_that_hdf5_cannot_have_are_refused) {
  const TemporaryFolder folder;
  for (const char* name : {"a/b", ".", "", "columns", "about"}) {
    const BatchTable table = gather_batch({}, 1, [&](std::size_t) -> BatchRow {
      return {{name, std::int64_t{1}}};
    });
    EXPECT_EQ(error_code([&] { write_batch(table, folder / "a.h5"); }, "another name"),
              ErrorCode::kInvalidInput);
    EXPECT_EQ(folder.n_files(), 0U);
  }
}

// The table has more columns than HDF5 keeps in a group's header by default.
TEST(BatchTable, a_file_may_have_thousands_of_columns) {
  const TemporaryFolder folder;
  BatchRow row;
  for (int i = 0; i < 3000; ++i) row.emplace_back("c." + std::to_string(i), i + 0.5);
  write_batch(gather_batch({}, 2, [&](std::size_t) { return row; }), folder / "a.h5");
  expect_same(read_batch(folder / "a.h5").row(1), row);
}

// The table of all rows is the same, however the rows were shared out.
TEST(BatchTable, parts_make_the_table_of_the_whole) {
  const TemporaryFolder folder;
  const std::vector<std::string> leading = {"id"};
  for (const char* name : {"p.h5", "p.csv"}) {
    const std::string extension = std::filesystem::path(name).extension();
    write_batch(table_of({0, 1, 2, 3}), folder / ("whole" + extension).c_str());
    for (unsigned mask = 0; mask < 16; ++mask) {
      std::vector<std::size_t> rows[2];
      std::pair<int, std::size_t> place[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const int part = static_cast<int>(mask >> i & 1);
        place[i] = {part, rows[part].size()};
        rows[part].push_back(i);
      }
      BatchTable parts[2];
      for (int p = 0; p < 2; ++p) {
        write_batch(table_of(rows[p]), folder / name);
        parts[p] = read_batch(folder / name);
      }
      BatchTable all = gather_batch(
          leading, 4, [&](std::size_t i) { return parts[place[i].first].row(place[i].second); });
      all.about = {{"command", "info"}};
      write_batch(all, folder / ("all" + extension).c_str());
      EXPECT_EQ(read_all(folder / ("all" + extension).c_str()),
                read_all(folder / ("whole" + extension).c_str()))
          << mask;
    }
  }
}

// Files with flipped bits or cut ends are refused, or read as a consistent table.
TEST(BatchTable, damaged_files_are_read_or_refused) {
  const TemporaryFolder folder;
  write_batch(table_of({0, 1, 2, 3}), folder / "a.h5");
  const std::string whole = read_all(folder / "a.h5");
  std::size_t refused = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    std::string bytes = whole;
    const auto at = static_cast<std::size_t>(random_uniform(seed, 0) * double(8 * whole.size()));
    if (seed % 4 == 0) {
      bytes.resize(at / 8);
    } else {
      bytes[at / 8] = static_cast<char>(bytes[at / 8] ^ (1 << at % 8));
    }
    try {
      const BatchTable table = parse_table_hdf5(bytes, "test");
      for (std::size_t i = 0; i < table.rows; ++i) table.row(i);
    } catch (const Error& error) {
      EXPECT_STRNE(error.what(), "");
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000U);
}

}  // namespace
}  // namespace rholm
