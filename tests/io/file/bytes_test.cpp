#include "io/file/bytes.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::TemporaryFolder;
using testing::write_all;

std::string text_of(const Bytes& bytes) { return {bytes.view().data(), bytes.view().size()}; }

// Makes standard input a pipe until the object is destroyed.
class PipedInput {
 public:
  PipedInput() : saved_(dup(STDIN_FILENO)) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    write_end_ = ends[1];
  }
  ~PipedInput() {
    finish();
    dup2(saved_, STDIN_FILENO);
    close(saved_);
  }
  int write_end() const { return write_end_; }
  void finish() {
    if (write_end_ >= 0) close(write_end_);
    write_end_ = -1;
  }

 private:
  int saved_;
  int write_end_ = -1;
};

TEST(read_bytes, gives_every_byte_of_a_file) {
  const TemporaryFolder folder;
  // Sizes are around the sizes at which the buffer grows.
  for (const std::size_t n : {0u, 1u, 65535u, 65536u, 65537u, 3000000u}) {
    std::string content(n, '\0');
    for (std::size_t i = 0; i < n; ++i) content[i] = static_cast<char>(i * 7 + i / 256);
    write_all(folder / "a", content);
    EXPECT_EQ(text_of(read_bytes(folder / "a")), content) << n;
  }
}

TEST(read_bytes, dash_is_standard_input) {
  std::string content;
  for (int i = 0; i < 100000; ++i) content += std::to_string(i) + "\n";
  PipedInput input;
  std::thread writer([&] {
    for (std::size_t done = 0; done < content.size();) {
      const ssize_t n = write(input.write_end(), content.data() + done, content.size() - done);
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    input.finish();
  });
  EXPECT_EQ(text_of(read_bytes("-")), content);
  writer.join();
}

TEST(read_bytes, shapes_are_read_from_standard_input) {
  PipedInput input;
  const std::string_view text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  ASSERT_EQ(write(input.write_end(), text.data(), text.size()), ssize_t(text.size()));
  input.finish();
  const ShapeFile file = read_shape("-");
  EXPECT_EQ(file.format, ShapeFormat::kOff);
  EXPECT_EQ(std::get<Mesh>(file.shape).faces.size(), 1u);
}

TEST(read_bytes, errors_of_standard_input_name_it) {
  PipedInput input;
  input.finish();
  expect_error([] { read_shape("-"); }, ErrorCode::kInvalidInput, {"standard input", "empty"});
}

TEST(read_bytes, signal_during_a_blocking_read_asks_whether_to_cancel) {
  struct sigaction action = {};
  struct sigaction before = {};
  action.sa_handler = [](int) {};
  sigaction(SIGUSR1, &action, &before);
  PipedInput input;
  const pthread_t reader = pthread_self();
  std::atomic<bool> done = false;
  std::atomic<int> signals = 0;
  std::thread sender([&] {
    while (!done) {
      ++signals;
      pthread_kill(reader, SIGUSR1);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  Context context;
  int questions = 0;
  context.progress = [&](std::string_view, double) { return ++questions < 3; };
  expect_error([&] { read_bytes("-", context); }, ErrorCode::kCancelled);
  done = true;
  sender.join();
  sigaction(SIGUSR1, &before, nullptr);
  EXPECT_EQ(questions, 3);
}

TEST(read_bytes, a_named_pipe_is_waited_for_until_it_is_cancelled) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  Context context;
  int questions = 0;
  context.progress = [&](std::string_view, double) { return ++questions < 3; };
  expect_error([&] { read_bytes(pipe, context); }, ErrorCode::kCancelled);
  EXPECT_EQ(questions, 3);
  std::thread writer([&] { std::ofstream(pipe) << "some bytes"; });
  const Bytes bytes = read_bytes(pipe);
  writer.join();
  EXPECT_EQ(text_of(bytes), "some bytes");
}

TEST(read_bytes, places_that_cannot_be_read_are_named) {
  const TemporaryFolder folder;
  expect_error([&] { read_bytes(folder / "missing"); }, ErrorCode::kIo,
               {"missing", "No such file or directory"});
  expect_error([&] { read_bytes(folder.path()); }, ErrorCode::kIo, {"Is a directory"});
  if (geteuid() == 0) return;  // root may read everything
  write_all(folder / "secret", "x");
  chmod((folder / "secret").c_str(), 0);
  expect_error([&] { read_bytes(folder / "secret"); }, ErrorCode::kIo, {"Permission denied"});
}

TEST(read_bytes, files_without_a_size_are_read_to_their_end) {
  EXPECT_FALSE(text_of(read_bytes("/proc/self/status")).empty());
  EXPECT_TRUE(text_of(read_bytes("/dev/null")).empty());
}

}  // namespace
}  // namespace rholm
