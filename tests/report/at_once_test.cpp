// A program may call the library from several threads at the same time. Permanent data (plans of
// transforms, quadrature rules, names of unfinished files) is made once and shared. Callbacks are
// called one at a time. Results are compared with the results of a single call; ThreadSanitizer
// checks for races (docs/testing.md).
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "io/shapes/test_support.h"
#include "rholm/rholm.h"
#include "support/bits.h"
#include "support/test_points.h"

namespace rholm {
namespace {

using test::Bits;
using testing::read_all;
using testing::TemporaryFolder;

constexpr int kCallers = 3;

// Counts calls of progress in an unguarded number: two callbacks at the same time would be a race.
struct Listened {
  int calls = 0, inside = 0;
  bool met = false;
  Context context() {
    return {.threads = 2, .progress = [this](std::string_view, double) {
              met = met || inside++ != 0;
              ++calls;
              --inside;
              return true;
            }};
  }
};

// Several callers at the same time must get the same bits as `work` alone. They run first, so that
// no permanent data exists yet.
void expect_same_bits_at_once(const std::function<std::string(int caller)>& work) {
  std::vector<std::string> found(kCallers);
  std::atomic<int> waiting = kCallers;
  std::vector<std::jthread> callers;
  callers.reserve(kCallers);
  for (int k = 0; k < kCallers; ++k) {
    callers.emplace_back([&, k] {
      --waiting;
      while (waiting > 0) std::this_thread::yield();
      found[static_cast<std::size_t>(k)] = work(k);
    });
  }
  callers.clear();  // waits for them
  const std::string alone = work(kCallers);
  EXPECT_FALSE(alone.empty());
  for (const std::string& bits : found) EXPECT_TRUE(bits == alone);
}

TEST(callers_at_once, get_the_same_model_and_file_of_a_mesh) {
  const TemporaryFolder folder;
  const Mesh mesh = bumpy_sphere(2);
  expect_same_bits_at_once([&](int caller) {
    Listened listened;
    const Encoded encoded = encode(mesh, {.analyze = {.degree = 12}}, listened.context());
    EXPECT_GT(listened.calls, 0);
    EXPECT_FALSE(listened.met);
    const std::string name = "model" + std::to_string(caller) + ".h5";
    write_model(encoded.analysis.expansion, folder / name.c_str());
    const std::string file = read_all(folder / name.c_str());
    return file + Bits().add(read_model(folder / name.c_str()).coefficients).bytes();
  });
}

TEST(callers_at_once, get_the_same_surface_of_points) {
  const PointCloud cloud = test::sphere_points(1500);
  expect_same_bits_at_once([&](int) {
    Listened listened;
    const Reconstruction made = reconstruct(cloud, {}, listened.context());
    EXPECT_GT(listened.calls, 0);
    EXPECT_FALSE(listened.met);
    return Bits().add(made.mesh).bytes();
  });
}

TEST(callers_at_once, get_the_same_picture) {
  const Mesh mesh = box({1, 0.7, 0.4});
  expect_same_bits_at_once([&](int) {
    Listened listened;
    const Panel panel{.mesh = &mesh};
    const Image image =
        render(std::span(&panel, 1), {.width = 96, .height = 64, .samples = 2}, listened.context());
    EXPECT_GT(listened.calls, 0);
    EXPECT_FALSE(listened.met);
    const std::vector<char> file = encode_png(image);
    return std::string(file.begin(), file.end());
  });
}

}  // namespace
}  // namespace rholm
