#include "io/file/leftovers.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <functional>
#include <iterator>
#include <string_view>

#include "io/file/atomic_file.h"
#include "io/file/temporary_folder.h"
#include "io/shapes/test_support.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using testing::TemporaryFolder;
using testing::write_all;

// A process that runs `body` and is killed when this object is destroyed.
class Child {
 public:
  explicit Child(const std::function<void()>& body) {
    int ready[2] = {};
    EXPECT_EQ(pipe(ready), 0);
    pid_ = fork();
    if (pid_ == 0) {
      body();
      if (write(ready[1], "x", 1) == 1) pause();  // until it is killed
      _exit(1);
    }
    close(ready[1]);
    char byte = 0;
    EXPECT_EQ(read(ready[0], &byte, 1), 1) << "the child has failed";
    close(ready[0]);
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

 private:
  pid_t pid_ = 0;
};

// Runs `body` in another process, because a process examines a folder only once.
void elsewhere(const std::function<void()>& body) { const Child child(body); }

// Opens a file whose object the child leaves behind when it is killed.
void open_file(const std::filesystem::path& path, AtomicFile::Writers writers) {
  (new AtomicFile(path, {}, writers))->write(std::string_view("half"));
}

TEST(leftovers, a_killed_writer_leaves_nothing) {
  const TemporaryFolder folder;
  elsewhere([&] { open_file(folder / "a", AtomicFile::Writers::kThisProcess); });
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(leftovers, named_files_of_killed_writers_go_with_the_next) {
  const TemporaryFolder folder;
  elsewhere([&] { open_file(folder / "a", AtomicFile::Writers::kSeveral); });
  ASSERT_EQ(folder.n_files(), 1u);
  elsewhere([&] {
    AtomicFile file(folder / "b", {}, AtomicFile::Writers::kSeveral);
    file.write(std::string_view("whole"));
    file.commit();
  });
  EXPECT_EQ(folder.n_files(), 1u);
  EXPECT_TRUE(std::filesystem::exists(folder / "b"));
}

// Makes a system call of this process fail from now on.
void forbid(int call) {
  sock_filter filter[] = {
      {.code = BPF_LD | BPF_W | BPF_ABS, .jt = 0, .jf = 0, .k = offsetof(seccomp_data, nr)},
      {.code = BPF_JMP | BPF_JEQ | BPF_K, .jt = 0, .jf = 1, .k = static_cast<unsigned>(call)},
      {.code = BPF_RET | BPF_K, .jt = 0, .jf = 0, .k = SECCOMP_RET_ERRNO | EPERM},
      {.code = BPF_RET | BPF_K, .jt = 0, .jf = 0, .k = SECCOMP_RET_ALLOW}};
  const sock_fprog program = {.len = std::size(filter), .filter = filter};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0) {
    _exit(1);
  }
}

TEST(leftovers, where_files_may_get_no_name_later_they_have_one_from_the_start) {
  const TemporaryFolder folder;
  const Child writer([&] {
    forbid(__NR_linkat);
    open_file(folder / "a", AtomicFile::Writers::kThisProcess);
    AtomicFile file(folder / "b");
    file.write(std::string_view("whole"));
    file.commit();
  });
  EXPECT_EQ(folder.n_files(), 2u);  // "b", and the unfinished file of "a"
  EXPECT_TRUE(std::filesystem::exists(folder / "b"));
}

TEST(leftovers, files_of_those_that_still_write_stay) {
  const TemporaryFolder folder;
  const Child writer([&] { open_file(folder / "a", AtomicFile::Writers::kSeveral); });
  elsewhere([&] { remove_left_files(folder.path()); });
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(leftovers, files_of_others_stay) {
  const TemporaryFolder folder;
  for (const char* name : {".rholm", ".rholm.1-0.part.ply", "x.part", ".rholm-1-0.part"}) {
    write_all(folder / name, "not ours");
  }
  elsewhere([&] { remove_left_files(folder.path()); });
  EXPECT_EQ(folder.n_files(), 4u);
}

TEST(leftovers, a_link_is_not_followed) {
  const TemporaryFolder folder;
  write_all(folder / "a", "not ours");
  std::filesystem::create_symlink(folder / "a", folder / ".rholm.1-0.part");
  elsewhere([&] { remove_left_files(folder.path()); });
  EXPECT_EQ(folder.n_files(), 2u);
}

TEST(leftovers, folders_of_killed_processes_go_with_the_next) {
  const TemporaryFolder folder;
  const auto fill = [&] {
    const auto* made = new rholm::TemporaryFolder(folder.path(), "kind-");
    std::filesystem::create_directories(made->path() / "one");
    write_all(made->path() / "one/file", "x");
  };
  elsewhere(fill);
  ASSERT_EQ(folder.n_files(), 1u);
  const Child another(fill);  // another process is filling the folder
  EXPECT_EQ(folder.n_files(), 1u);
  elsewhere([&] { remove_left_folders(folder.path(), "kind-"); });
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(leftovers, folders_that_others_have_called_so_stay) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "kind-shapes");
  write_all(folder / "kind-shapes/file", "x");
  elsewhere([&] { remove_left_folders(folder.path(), "kind-"); });
  EXPECT_TRUE(std::filesystem::exists(folder / "kind-shapes/file"));
}

TEST(temporary_folder, is_for_its_owner_and_goes_with_the_object) {
  const TemporaryFolder folder;
  {
    const rholm::TemporaryFolder made(folder.path(), "kind-");
    EXPECT_EQ(std::filesystem::status(made.path()).permissions(),
              std::filesystem::perms::owner_all);
    write_all(made.path() / "file", "x");
  }
  EXPECT_EQ(folder.n_files(), 0u);
  testing::expect_error([&] { const rholm::TemporaryFolder made(folder / "none", "kind-"); },
                        ErrorCode::kIo, {"none", "No such file"});
}

}  // namespace
}  // namespace rholm
