#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string_view>
#include <thread>

#include "io/shapes/test_support.h"
#include "rholm/file.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;

void write_text(const std::filesystem::path& path, std::string_view text) {
  write_file(path, {text.data(), text.size()});
}

TEST(atomic_file, file_appears_whole_on_commit) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a");
  file.write(std::string_view("one "));
  file.write(std::string_view("two"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  EXPECT_EQ(read_all(file.temporary_path()), "one two");
  EXPECT_EQ(folder.n_files(), 0u);  // the file has no name until then
  file.commit();
  EXPECT_EQ(read_all(folder / "a"), "one two");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(atomic_file, without_commit_the_old_file_stays) {
  const TemporaryFolder folder;
  write_all(folder / "a", "old");
  {
    AtomicFile file(folder / "a");
    file.write(std::string_view("new"));
  }
  EXPECT_EQ(read_all(folder / "a"), "old");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(atomic_file, full_disk_leaves_the_old_file_and_says_why) {
  // A limit on the size of files simulates a full disk. A child process has the limit.
  const TemporaryFolder folder;
  write_all(folder / "a", "old");
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit = {1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_text(folder / "a", std::string(5000, 'x'));
    } catch (const Error& error) {
      const bool right = error.code() == ErrorCode::kIo &&
                         std::string(error.what()).find("File too large") != std::string::npos;
      _exit(right ? 0 : 1);
    }
    _exit(2);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_all(folder / "a"), "old");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(atomic_file, places_that_cannot_be_written_are_named) {
  const TemporaryFolder folder;
  expect_error([&] { write_text(folder / "no/such/folder", "x"); }, ErrorCode::kIo,
               {"no/such/folder", "No such file or directory"});
  expect_error([&] { write_text(folder.path(), "x"); }, ErrorCode::kIo, {"Is a directory"});
  expect_error([&] { write_text("", "x"); }, ErrorCode::kIo);
  write_all(folder / "file", "x");
  expect_error([&] { write_text(folder / "file/below", "x"); }, ErrorCode::kIo,
               {"Not a directory"});
  expect_error([&] { write_text("/dev/full", "x"); }, ErrorCode::kIo, {"No space left"});
  if (geteuid() == 0) return;  // root may write everywhere
  chmod((folder / "file").c_str(), 0444);
  expect_error([&] { write_text(folder / "file", "y"); }, ErrorCode::kIo, {"Permission denied"});
  chmod(folder.path().c_str(), 0555);
  expect_error([&] { write_text(folder / "new", "y"); }, ErrorCode::kIo, {"Permission denied"});
  chmod(folder.path().c_str(), 0755);
}

TEST(atomic_file, commit_that_fails_says_so_and_cleans_up) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a");
    std::filesystem::create_directory(folder / "a");
    expect_error([&] { file.commit(); }, ErrorCode::kIo, {"Is a directory"});
  }
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(atomic_file, devices_and_pipes_are_written_directly) {
  const TemporaryFolder folder;
  write_text("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = read_all(pipe); });
  write_text(pipe, "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST(atomic_file, permissions_of_an_existing_file_stay) {
  const TemporaryFolder folder;
  write_all(folder / "a", "old");
  chmod((folder / "a").c_str(), 0640);
  write_text(folder / "a", "new");
  struct stat status = {};
  stat((folder / "a").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
  const mode_t mask = umask(0027);
  write_text(folder / "b", "new");
  umask(mask);
  stat((folder / "b").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(atomic_file, symbolic_links_stay_links) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  write_all(folder / "sub/target", "old");
  std::filesystem::create_symlink("sub/target", folder / "link");
  write_text(folder / "link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(read_all(folder / "sub/target"), "new");
  std::filesystem::create_symlink("sub/fresh", folder / "dangling");
  write_text(folder / "dangling", "first");
  EXPECT_EQ(read_all(folder / "sub/fresh"), "first");
}

TEST(atomic_file, names_that_cannot_be_are_refused_before_anything_is_written) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink(folder / "b", folder / "a");
  std::filesystem::create_symlink(folder / "a", folder / "b");
  expect_error([&] { AtomicFile file(folder / "a"); }, ErrorCode::kIo, {"symbolic links"});
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "a"));
  expect_error([&] { AtomicFile file(folder / std::string(300, 'x').c_str()); }, ErrorCode::kIo,
               {"too long"});
}

TEST(atomic_file, signal_handler_may_discard_unfinished_files) {
  const TemporaryFolder folder;
  write_all(folder / "a", "old");
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGTERM, [](int) {
      discard_unfinished_files();
      discard_unfinished_files();  // nothing is left to do
      _exit(0);
    });
    // Both unfinished files have names. The names that the handler takes over are not freed,
    // because the child is about to end.
    AtomicFile one(folder / "a", {}, AtomicFile::Writers::kSeveral);
    AtomicFile two(folder / "b", {}, AtomicFile::Writers::kSeveral);
    two.write(std::string_view("half"));
    if (folder.n_files() == 3) raise(SIGTERM);
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder.n_files(), 1u);
  EXPECT_EQ(read_all(folder / "a"), "old");
}

TEST(atomic_file, more_files_at_once_than_are_kept_in_mind_still_work) {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<AtomicFile>> files;
  files.reserve(100);
  for (int i = 0; i < 100; ++i) {
    files.push_back(std::make_unique<AtomicFile>(folder / std::to_string(i).c_str()));
  }
  for (auto& file : files) file->commit();
  files.clear();
  EXPECT_EQ(folder.n_files(), 100u);
}

TEST(atomic_file, dash_is_standard_output) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const int saved = dup(STDOUT_FILENO);
  fflush(stdout);
  dup2(ends[1], STDOUT_FILENO);
  write_text("-", "to standard output");
  dup2(saved, STDOUT_FILENO);
  close(saved);
  close(ends[1]);
  char buffer[64];
  const ssize_t n = read(ends[0], buffer, sizeof(buffer));
  close(ends[0]);
  EXPECT_EQ(std::string_view(buffer, static_cast<std::size_t>(n)), "to standard output");
}

}  // namespace
}  // namespace rholm
