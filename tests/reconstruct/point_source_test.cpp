// Files, pipes and memory give the same points, and files larger than memory can be read.
#include "reconstruct/points/point_source.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <new>
#include <thread>

#include "io/spill/folder_store.h"
#include "parts/memory_store.h"
#include "reconstruct/test_support.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using testing::append;
using testing::expect_error;
using testing::read_all;
using testing::sphere_points;
using testing::TemporaryFolder;

PointCloud all_of(PointSource& source) {
  PointCloud all, piece;
  while (source.next(piece, {})) {
    EXPECT_FALSE(piece.points.empty());
    append(piece, all);
  }
  EXPECT_DOUBLE_EQ(source.part_read(), 1);
  return all;
}

void expect_same(const PointCloud& found, const PointCloud& wanted) {
  EXPECT_EQ(found.points, wanted.points);
  EXPECT_EQ(found.normals, wanted.normals);
  ASSERT_EQ(found.attributes.size(), wanted.attributes.size());
  for (std::size_t k = 0; k < wanted.attributes.size(); ++k) {
    EXPECT_EQ(found.attributes[k].name, wanted.attributes[k].name);
    EXPECT_EQ(found.attributes[k].type, wanted.attributes[k].type);
    EXPECT_EQ(found.attributes[k].values, wanted.attributes[k].values);
  }
}

TEST(PointSource, of_memory_is_gone_through_again) {
  const PointCloud cloud = sphere_points(40000);
  const auto source = points_in_memory(cloud);
  EXPECT_EQ(source->size(), 40000u);
  for (int pass = 0; pass < 2; ++pass) {
    expect_same(all_of(*source), cloud);
    source->rewind();
  }
  PointCloud piece;
  source->next(piece, {});
  source->rewind();
  expect_same(all_of(*source), cloud);
}

TEST(PointSource, of_a_file_is_gone_through_again) {
  const TemporaryFolder folder;
  const PointCloud cloud = sphere_points(40000);
  write_shape(cloud, folder / "points.ply");
  MemoryStore store;
  const auto source = open_points(folder / "points.ply", {}, store);
  EXPECT_EQ(source->size(), 40000u);
  for (int pass = 0; pass < 2; ++pass) {
    expect_same(all_of(*source), cloud);
    source->rewind();
  }
  EXPECT_EQ(store.bytes(), 0u);
  expect_error([&] { open_points(folder / "none.ply", {}, store); }, ErrorCode::kIo, {"none.ply"});
}

// A named pipe with a thread that writes to it.
class Pipe {
 public:
  Pipe(const std::filesystem::path& path, std::string bytes) : path_(path) {
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    writer_ = std::thread(
        [this, all = std::move(bytes)] { std::ofstream(path_, std::ios::binary) << all; });
  }
  ~Pipe() { writer_.join(); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

 private:
  std::filesystem::path path_;
  std::thread writer_;
};

TEST(PointSource, of_a_pipe_is_kept) {
  const TemporaryFolder folder;
  PointCloud cloud = sphere_points(40000);
  cloud.points[39999].x = 0.1;  // a value that single precision cannot hold
  write_shape(cloud, folder / "points.ply");
  FolderStore store(folder / "store");
  store.keep(true);
  {
    const Pipe pipe(folder / "pipe.ply", read_all(folder / "points.ply"));
    const auto source = open_points(folder / "pipe.ply", {}, store);
    PointCloud piece;
    source->rewind();
    ASSERT_TRUE(source->next(piece, {}));
    source->rewind();  // first reads all points
    for (int pass = 0; pass < 3; ++pass) {
      expect_same(all_of(*source), cloud);
      source->rewind();
    }
  }
  // A run is resumed.
  const auto again = open_points(folder / "pipe.ply", {}, store);
  expect_same(all_of(*again), cloud);
}

TEST(PointSource, of_a_pipe_goes_to_tiles) {
  const TemporaryFolder folder;
  const PointCloud cloud = sphere_points(30000);
  write_shape(cloud, folder / "points.ply");
  MemoryStore wanted;
  FolderStore store(folder / "store");
  const testing::Tiles from_memory(*points_in_memory(cloud), wanted, 4000);
  const Pipe pipe(folder / "pipe.ply", read_all(folder / "points.ply"));
  const testing::Tiles tiles(*open_points(folder / "pipe.ply", {}, store), store, 4000);
  ASSERT_EQ(tiles.plan.n_tiles(), from_memory.plan.n_tiles());
  for (std::size_t k = 0; k < tiles.plan.n_tiles(); ++k) {
    EXPECT_EQ(testing::bytes_of_piece(store, sorted_name(k)),
              testing::bytes_of_piece(wanted, sorted_name(k)));
  }
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

std::size_t address_space() {
  std::ifstream in("/proc/self/statm");
  std::size_t pages = 0;
  in >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Returns 0 if the action succeeds with `bytes` more memory than the process has, 1 if memory runs
// out. A child process has the limit.
template <class Action>
int exit_code_within(std::size_t bytes, Action&& action) {
  const pid_t child = fork();
  if (child == 0) {
    const rlim_t most = address_space() + bytes;
    const rlimit limit = {most, most};
    setrlimit(RLIMIT_AS, &limit);
    try {
      action();
    } catch (const std::bad_alloc&) {
      _exit(1);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(2);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(PointSource, larger_than_memory_goes_to_tiles) {
  if (kSanitized) GTEST_SKIP() << "sanitizers take address space of their own";
  constexpr std::size_t kPoints = 3000000, kPiece = 100000;
  const TemporaryFolder folder;
  {
    std::ofstream out(folder / "large.ply", std::ios::binary);
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << kPoints
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
           "property float ny\nproperty float nz\nend_header\n";
    for (std::size_t from = 0; from < kPoints; from += kPiece) {
      std::vector<float> values;
      for (std::size_t i = from; i < from + kPiece; ++i) {
        const std::uint64_t bits = random_bits(1, i);
        const float x = static_cast<float>(bits % 100003), y = static_cast<float>(i % 1013);
        const float z = static_cast<float>(bits % 907);
        values.insert(values.end(), {x, y, z, 0, 0, 1});
      }
      out.write(reinterpret_cast<const char*>(values.data()),
                static_cast<std::streamsize>(values.size() * sizeof(float)));
    }
  }
  constexpr std::size_t kMemory = std::size_t{60} << 20;  // the points take 144 MB, the file 72
  EXPECT_EQ(exit_code_within(kMemory, [&] { read_shape(folder / "large.ply"); }), 1);
  EXPECT_EQ(exit_code_within(kMemory,
                             [&] {
                               FolderStore store(folder / "store");
                               const auto source = open_points(folder / "large.ply", {}, store);
                               const testing::Tiles tiles(*source, store, 100000);
                               const SortedTile& n = tiles.counts;
                               if (tiles.plan.n_tiles() < 30) throw std::bad_exception();
                               if (n.points + n.duplicates != kPoints) throw std::bad_exception();
                             }),
            0);
}

}  // namespace
}  // namespace rholm
