// Data in a store is returned complete or not at all, whatever happens to the folder meanwhile.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "../shapes/test_support.h"
#include "base/random.h"
#include "io/spill/folder_store.h"
#include "parts/memory_store.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;
using Bytes = std::vector<std::byte>;
using Sections = std::vector<Bytes>;

Bytes some_bytes(std::size_t n, std::uint64_t seed) {
  Bytes bytes(n);
  for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::byte>(random_bits(seed, i));
  return bytes;
}

Sections all_of(const PieceReader& piece) {
  Sections sections;
  for (std::size_t k = 0; k < piece.n_sections(); ++k) {
    sections.push_back(piece.read(k));
    EXPECT_EQ(piece.size(k), sections.back().size());
  }
  return sections;
}

Bytes joined(const Sections& sections) {
  Bytes all;
  for (const Bytes& section : sections) all.insert(all.end(), section.begin(), section.end());
  return all;
}

const Sections kThree = {some_bytes(1000, 1), {}, some_bytes(37, 2)};

// Tests run with a store in memory and with a store in a folder.
class PieceStores : public ::testing::TestWithParam<bool> {
 protected:
  std::unique_ptr<PieceStore> make() {
    if (GetParam()) return std::make_unique<MemoryStore>();
    return std::make_unique<FolderStore>(folder_ / "store", "a test");
  }
  TemporaryFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(, PieceStores, ::testing::Bool());

TEST_P(PieceStores, give_back_what_was_written) {
  const auto store = make();
  EXPECT_FALSE(store->has("a/b"));
  store->write("a/b", kThree);
  store->write("nothing", Sections{});
  EXPECT_TRUE(store->has("a/b"));
  EXPECT_FALSE(store->has("a"));
  EXPECT_EQ(all_of(store->open("a/b")), kThree);
  EXPECT_EQ(store->open("nothing").n_sections(), 0u);
  expect_error([&] { store->open("a/c"); }, ErrorCode::kIo, {"a/c"});
}

TEST_P(PieceStores, replace_and_remove_pieces_that_may_still_be_read) {
  const auto store = make();
  store->write("a", kThree);
  const PieceReader before = store->open("a");
  store->write("a", Sections{some_bytes(5, 3)});
  const PieceReader after = store->open("a");
  store->remove("a");
  store->remove("a");
  EXPECT_FALSE(store->has("a"));
  EXPECT_EQ(all_of(before), kThree);
  EXPECT_EQ(all_of(after), Sections{some_bytes(5, 3)});
  EXPECT_EQ(store->bytes(), 0u);
}

TEST_P(PieceStores, count_their_bytes) {
  const auto store = make();
  store->write("a", Sections{some_bytes(100000, 1)});
  const std::uint64_t one = store->bytes();
  EXPECT_GE(one, 100000u);
  EXPECT_LE(one, 100200u);
  store->write("b", Sections{some_bytes(50000, 1)});
  store->remove("a");
  EXPECT_LE(store->bytes(), 50200u);
  EXPECT_GE(store->most_bytes(), 150000u);
  EXPECT_LE(store->most_bytes(), 150400u);
}

TEST_P(PieceStores, know_no_names_beyond_words_and_slashes) {
  const auto store = make();
  for (const char* name : {"", "/a", "a/", "a//b", "..", "a/../b", "a.part", "a b"}) {
    SCOPED_TRACE(name);
    expect_error([&] { store->write(name, kThree); }, ErrorCode::kInvalidInput, {"called"});
    expect_error([&] { store->has(name); }, ErrorCode::kInvalidInput);
  }
}

TEST_P(PieceStores, serve_several_threads_at_once) {
  const auto store = make();
  store->write("shared", kThree);
  const PieceReader shared = store->open("shared");
  std::vector<int> right(4, 0);
  std::vector<std::thread> threads;
  threads.reserve(right.size());
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k < 20; ++k) {
        const std::string name = "of/" + std::to_string(t) + "/" + std::to_string(k);
        const Sections own = {some_bytes(3000, 100 * t + k)};
        store->write(name, own);
        store->write("same", own);
        const bool same = all_of(store->open(name)) == own && all_of(shared) == kThree &&
                          all_of(store->open("same")).size() == 1;
        right[t] += same ? 1 : 0;
        if (k % 2 == 1) store->remove(name);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, std::vector<int>(4, 20));
}

TEST_P(PieceStores, grow_many_pieces_at_once_by_any_buffer) {
  constexpr std::size_t kPieces = 50;
  for (const std::size_t most : {0u, 5000u, 300000u, 100000000u}) {
    const auto store = make();
    std::vector<Bytes> wanted(kPieces);
    PieceAppender appender(*store, "grown", kPieces, most);
    for (std::size_t i = 0; i < 4000; ++i) {
      // The first pieces receive more data; one piece receives nothing.
      const std::size_t piece = random_bits(1, i) % (1 + random_bits(2, i) % (kPieces - 1));
      const Bytes bytes = some_bytes(i == 77 ? 20000 : random_bits(3, i) % 100, i);
      appender.append(piece, bytes);
      wanted[piece].insert(wanted[piece].end(), bytes.begin(), bytes.end());
      EXPECT_FALSE(store->has("grown/0"));
    }
    appender.finish();
    for (std::size_t k = 0; k < kPieces; ++k) {
      EXPECT_EQ(joined(all_of(store->open("grown/" + std::to_string(k)))), wanted[k]);
    }
    EXPECT_FALSE(store->has("grown/" + std::to_string(kPieces)));
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < kPieces; ++k) {
      all += wanted[k].size();
      store->remove("grown/" + std::to_string(k));
    }
    EXPECT_EQ(store->bytes(), 0u);
    EXPECT_GE(store->most_bytes(), all);
  }
}

TEST_P(PieceStores, keep_bytes_of_one_call_together) {
  const auto store = make();
  PieceAppender appender(*store, "rows", 2, 0);
  for (std::size_t i = 0; i < 5000; ++i) appender.append(i % 2, some_bytes(7, i));
  appender.append_section(0, some_bytes(3, 0));
  appender.finish();
  const PieceReader piece = store->open("rows/0");
  EXPECT_GT(piece.n_sections(), 2u);
  for (std::size_t k = 0; k + 1 < piece.n_sections(); ++k) EXPECT_EQ(piece.size(k) % 7, 0u);
  EXPECT_EQ(piece.read(piece.n_sections() - 1), some_bytes(3, 0));
}

TEST_P(PieceStores, have_nothing_of_what_was_not_finished) {
  const auto store = make();
  store->write("grown/0", kThree);
  const std::uint64_t before = store->bytes();
  {
    PieceAppender appender(*store, "grown", 3, 0);
    for (std::size_t i = 0; i < 5000; ++i) appender.append(i % 3, some_bytes(50, i));
    EXPECT_GT(store->bytes(), before);
  }
  EXPECT_EQ(store->bytes(), before);
  EXPECT_EQ(all_of(store->open("grown/0")), kThree);
  EXPECT_FALSE(store->has("grown/1"));
}

TEST_P(PieceStores, replace_all_pieces_of_a_group) {
  const auto store = make();
  for (const std::size_t n : {5u, 2u}) {
    PieceAppender appender(*store, "grown", n, 1000);
    appender.append(1, some_bytes(n, n));
    appender.finish();
  }
  EXPECT_EQ(joined(all_of(store->open("grown/1"))), some_bytes(2, 2));
  EXPECT_FALSE(store->has("grown/3"));
  store->remove("grown/0");
  store->remove("grown/1");
  EXPECT_EQ(store->bytes(), 0u);
}

TEST(PieceStore, numbers_are_bytes_and_back) {
  const std::vector<double> numbers = {1, -2.5, 1e300};
  EXPECT_EQ(vector_of<double>(bytes_of(numbers)), numbers);
  EXPECT_TRUE(vector_of<double>({}).empty());
}

TEST(PieceStore, leaves_nothing_behind) {
  const TemporaryFolder folder;
  { FolderStore(folder / "made").write("a", kThree); }
  EXPECT_EQ(folder.n_files(), 0u);
  std::filesystem::create_directory(folder / "given");
  { FolderStore(folder / "given").write("a", kThree); }
  EXPECT_TRUE(std::filesystem::is_empty(folder / "given"));
  std::filesystem::remove(folder / "given");
  {
    FolderStore store(folder / "made");
    store.write("a", kThree);
    write_all(folder / "made/letter", "of somebody else");
  }
  EXPECT_EQ(read_all(folder / "made/letter"), "of somebody else");
  EXPECT_FALSE(std::filesystem::exists(folder / "made/pieces"));
}

TEST(PieceStore, is_taken_up_again) {
  const TemporaryFolder folder;
  {
    FolderStore store(folder / "made", "igea, version 1\nnoise 0");
    EXPECT_FALSE(store.was_there());
    store.keep(true);
    store.write("caps/1", kThree);
  }
  // Files that a killed run leaves behind.
  write_all(folder / "made/pieces/caps/2.7.part", "half");
  std::filesystem::create_directories(folder / "made/pieces/raw.0.part");
  write_all(folder / "made/pieces/raw.0.part/0", "half");
  {
    FolderStore store(folder / "made", "igea, version 1\nnoise 0");
    EXPECT_TRUE(store.was_there());
    EXPECT_EQ(all_of(store.open("caps/1")), kThree);
    EXPECT_FALSE(store.has("caps/2"));
    EXPECT_FALSE(std::filesystem::exists(folder / "made/pieces/raw.0.part"));
    EXPECT_FALSE(std::filesystem::exists(folder / "made/pieces/caps/2.7.part"));
    EXPECT_GE(store.bytes(), 1037u);
    store.remove("caps/1");
    EXPECT_EQ(store.bytes(), 0u);
  }
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(PieceStore, refuses_the_folder_of_another_run) {
  const TemporaryFolder folder;
  {
    FolderStore store(folder / "made", "igea\nnoise 0");
    store.keep(true);
    store.write("a", kThree);
  }
  expect_error([&] { FolderStore(folder / "made", "igea\nnoise 0.1"); }, ErrorCode::kInvalidInput,
               {"another run", "'noise 0' there, 'noise 0.1' now"});
  expect_error([&] { FolderStore(folder / "made", "igea"); }, ErrorCode::kInvalidInput,
               {"'noise 0' there, 'nothing' now"});
  write_all(folder / "made/manifest", "what is this");
  expect_error([&] { FolderStore(folder / "made", "igea"); }, ErrorCode::kInvalidInput);
  EXPECT_TRUE(std::filesystem::exists(folder / "made/pieces/a"));
}

TEST(PieceStore, refuses_a_folder_with_other_files) {
  const TemporaryFolder folder;
  write_all(folder / "letter", "x");
  expect_error([&] { FolderStore store(folder.path()); }, ErrorCode::kInvalidInput,
               {"other files", "letter"});
  EXPECT_EQ(folder.n_files(), 1u);
  expect_error([&] { FolderStore store(folder / "letter"); }, ErrorCode::kIo, {"letter"});
  expect_error([&] { FolderStore store(folder / "letter/below"); }, ErrorCode::kIo,
               {"Not a directory"});
  expect_error([&] { FolderStore store("/proc/no/such"); }, ErrorCode::kIo, {"/proc/no"});
}

TEST(PieceStore, is_one_program_s) {
  const TemporaryFolder folder;
  const FolderStore store(folder / "made", "same");
  // A lock belongs to an open file: this process cannot take a second lock either.
  expect_error([&] { FolderStore second(folder / "made", "same"); }, ErrorCode::kIo, {"in use"});
  EXPECT_TRUE(std::filesystem::exists(folder / "made/manifest"));
}

TEST(PieceStore, damaged_pieces_are_refused) {
  const TemporaryFolder folder;
  FolderStore store(folder / "made");
  store.write("a", Sections{some_bytes(60, 1), {}, some_bytes(9, 2)});
  const auto path = folder / "made/pieces/a";
  const std::string whole = read_all(path);
  const auto read = [&] { return all_of(store.open("a")); };
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1 << i % 8);
    write_all(path, damaged);
    expect_error(read, ErrorCode::kInvalidInput, {"made/pieces/a"});
  }
  for (std::size_t n = 0; n < whole.size(); ++n) {
    write_all(path, std::string_view(whole).substr(0, n));
    expect_error(read, ErrorCode::kInvalidInput, {"made/pieces/a"});
  }
  write_all(path, whole + "x");
  expect_error(read, ErrorCode::kInvalidInput);
  write_all(path, whole);
  const PieceReader open = store.open("a");
  std::filesystem::resize_file(path, 50);
  expect_error([&] { all_of(open); }, ErrorCode::kInvalidInput, {"damaged"});
}

// A limit on the size of files simulates a full disk. A child process has the limit.
template <class Action>
int exit_code_with_small_files(Action&& action) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      action();
    } catch (const Error& error) {
      const bool right = error.code() == ErrorCode::kIo &&
                         std::string(error.what()).find("File too large") != std::string::npos;
      _exit(right ? 0 : 1);
    }
    _exit(2);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(PieceStore, full_disk_leaves_what_was_whole) {
  const TemporaryFolder folder;
  EXPECT_EQ(exit_code_with_small_files([&] {
              FolderStore store(folder / "made");
              store.keep(true);
              store.write("a", kThree);
              store.write("a", Sections{some_bytes(30000, 1)});
            }),
            0);
  EXPECT_EQ(exit_code_with_small_files([&] {
              FolderStore store(folder / "made");
              store.keep(true);
              PieceAppender appender(store, "grown", 2, 10000);
              for (std::size_t i = 0; i < 1000; ++i) appender.append(i % 2, some_bytes(100, i));
              appender.finish();
            }),
            0);
  FolderStore store(folder / "made");
  EXPECT_EQ(all_of(store.open("a")), kThree);
  EXPECT_FALSE(store.has("grown/0"));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "made/pieces")) {
    files += entry.is_regular_file() ? 1 : 0;
  }
  EXPECT_EQ(files, 1u);
}

TEST(PieceStore, says_how_much_room_there_is) {
  const TemporaryFolder folder;
  const FolderStore store(folder / "made");
  store.check_room(1);
  expect_error([&] { store.check_room(std::uint64_t{1} << 62); }, ErrorCode::kIo,
               {"has room for", "are needed"});
  MemoryStore().check_room(std::uint64_t{1} << 62);
}

TEST(PieceStore, on_a_small_disk_says_that_it_is_full) {
  const TemporaryFolder folder;
  if (::mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) {
    GTEST_SKIP() << "no disk of 1 MB can be mounted here";
  }
  {
    FolderStore store(folder / "made");
    expect_error([&] { store.check_room(2000000); }, ErrorCode::kIo, {"has room for 0.0 GB"});
    store.write("a", kThree);
    expect_error([&] { store.write("b", Sections{some_bytes(2000000, 1)}); }, ErrorCode::kIo,
                 {"No space left"});
    EXPECT_FALSE(store.has("b"));
    EXPECT_EQ(all_of(store.open("a")), kThree);
  }
  EXPECT_EQ(folder.n_files(), 0u);
  ::umount(folder.path().c_str());
}

}  // namespace
}  // namespace rholm
