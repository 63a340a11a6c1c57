#include "rholm_bench/bench.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/aligned_array.h"
#include "io/shapes/test_support.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"
#include "rholm_bench/bench_rows.h"
#include "rholm_bench/bench_timing.h"
#include "rholm_bench/peak_memory.h"
#include "support/random_data.h"
#include "support/targets.h"

namespace rholm {
namespace {

using testing::TemporaryFolder;

struct BumpyFile {
  TemporaryFolder folder;
  Mesh mesh = bumpy_sphere(3);
  std::filesystem::path path = folder.path() / "bumpy.ply";
  BumpyFile() { write_shape(mesh, path); }
};

// The loop that measures the lower bound of spreading adds what spreading adds: windows of any
// width, 1 ... 33 sources.
TEST(bench_rows, add_the_products_of_the_taps) {
  test::for_each_target([](const char* target) {
    for (int width = 2; width <= kMaxSpreadWidth; ++width) {
      const GridLayout layout = grid_layout(width, 32, 32);
      const auto columns = static_cast<std::size_t>(padded_width(width));
      const auto w = static_cast<std::size_t>(width);
      const std::vector<double> numbers = test::random_values(columns + 2 * w, 1);
      AlignedArray<double> taps(numbers.size()), grid = AlignedArray<double>::zeros(layout.cells());
      std::copy(numbers.begin(), numbers.end(), taps.begin());
      std::vector<double> expected(layout.cells(), 0.0);
      for (std::uint32_t n = 1; n <= 33; ++n) {
        const std::uint32_t first[] = {n % 16};
        update_rows(layout, first, taps.data(), grid.data());
        for (std::size_t i = 0; i < w; ++i) {
          for (std::size_t k = 0; k < columns; ++k) {
            expected[i * layout.stride + first[0] + k] +=
                (numbers[columns + i] + numbers[columns + w + i]) * numbers[k];
          }
        }
      }
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_NEAR(grid[i], expected[i], 1e-13) << target << " " << width;
      }
    }
  });
}

BenchOptions quick() { return {.degree = 16, .precision = 1e-6, .repeat = 3}; }

ErrorCode refusal(const BenchOptions& options) {
  const BumpyFile bumpy;
  try {
    bench_file(bumpy.path, options);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "not refused";
  return ErrorCode::kIo;
}

TEST(bench_timing, median_is_the_middle_or_the_mean_of_the_two_in_the_middle) {
  EXPECT_EQ(median({5, 1, 3}), 3);
  EXPECT_EQ(median({4, 1, 3, 9}), 3.5);
  const Timing timing = timing_of({{4, 1}, {2, 3}, {3, 2}});
  EXPECT_EQ(timing.median.wall, 3);
  EXPECT_EQ(timing.median.cpu, 2);
  EXPECT_EQ(timing.minimum.wall, 2);
  EXPECT_EQ(timing.minimum.cpu, 1);
}

TEST(bench_file, parts_take_no_longer_than_the_whole) {
  const BumpyFile bumpy;
  BenchOptions options = quick();
  options.repeat = 1;
  options.threads = {1, 2};
  const FileBench bench = bench_file(bumpy.path, options);
  ASSERT_EQ(bench.runs.size(), 2u);
  for (const BenchRuns& runs : bench.runs) {
    double parts = 0;
    for (const char* part : {"read", "faces", "spread", "fourier"}) {
      parts += runs.stages.at(part).median.wall;
    }
    EXPECT_GT(parts, 0);
    EXPECT_LE(parts, runs.stages.at("coefficients").median.wall);
    EXPECT_GT(runs.speedup, 0);
    EXPECT_FALSE(runs.stages.contains("write"));  // no folder was given
  }
  EXPECT_EQ(bench.runs[0].speedup, 1);
  EXPECT_EQ(bench.file_bytes, std::filesystem::file_size(bumpy.path));
}

TEST(bench_file, leaves_nothing_in_the_folder_it_writes_to) {
  const BumpyFile bumpy;
  BenchOptions options = quick();
  options.folder = bumpy.folder / "models";
  std::filesystem::create_directory(options.folder);
  EXPECT_GT(bench_file(bumpy.path, options).runs[0].stages.at("write").minimum.wall, 0);
  EXPECT_TRUE(std::filesystem::is_empty(options.folder));
}

TEST(bench_file, options_out_of_range_are_refused) {
  BenchOptions options = quick();
  options.repeat = 0;
  EXPECT_EQ(refusal(options), ErrorCode::kInvalidInput);
  options = quick();
  options.threads = {};
  EXPECT_EQ(refusal(options), ErrorCode::kInvalidInput);
  options.threads = {1, 0};
  EXPECT_EQ(refusal(options), ErrorCode::kInvalidInput);
  options = quick();
  options.degree = -1;
  EXPECT_EQ(refusal(options), ErrorCode::kInvalidInput);
}

TEST(bench_file, stops_when_it_is_told_to) {
  const BumpyFile bumpy;
  Context context;
  context.progress = [](std::string_view, double) { return false; };
  try {
    bench_file(bumpy.path, quick(), context);
    ADD_FAILURE() << "not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

TEST(bench_sums, direct_sums_of_few_directions_are_not_sampled) {
  const BumpyFile bumpy;
  const Expanded expanded = expand(bumpy.mesh, {.degree = 16});
  const SumsBench sums = bench_sums(bumpy.mesh, expanded.transform.expansion, quick());
  EXPECT_EQ(sums.directions, bumpy.mesh.vertices.size());
  EXPECT_EQ(sums.sampled, sums.directions);
  for (const Timing& timing :
       {sums.adjoint, sums.adjoint_with_gradient, sums.forward_with_gradient, sums.direct}) {
    EXPECT_GT(timing.minimum.wall, 0);
    EXPECT_LE(timing.minimum.wall, timing.median.wall);
  }
}

TEST(bench_floors, all_take_time_and_the_grid_is_that_of_the_report) {
  const BumpyFile bumpy;
  const Expanded expanded = expand(bumpy.mesh, {.degree = 16, .precision = 1e-6});
  const FastReport& fast = *expanded.transform.fast;
  const FloorsBench floors =
      bench_floors(bumpy.path, bumpy.mesh, expanded.transform.expansion, fast, quick());
  for (const Timing& timing :
       {floors.file_read, floors.copy, floors.row_updates, floors.legendre}) {
    EXPECT_GT(timing.minimum.wall, 0);
  }
  // The grid has n longitudes, n / 2 colatitudes, and margins.
  const double n = fast.oversampling * 2 * 16;
  EXPECT_GE(static_cast<double>(floors.grid_bytes), n * n / 2 * sizeof(double));
}

TEST(bench_rows, each_source_adds_both_products_to_each_of_its_cells) {
  const GridLayout layout = grid_layout(6, 40, 40);
  AlignedArray<double> grid(layout.cells()), taps(8 + 2 * 6);
  std::fill(grid.begin(), grid.end(), 0.0);
  for (std::size_t k = 0; k < 8; ++k) taps[k] = static_cast<double>(k + 1);  // columns, with sum 36
  for (std::size_t i = 0; i < 6; ++i) {
    taps[8 + i] = 2;   // factors of the value
    taps[14 + i] = 3;  // factors of the slope
  }
  const std::vector<std::uint32_t> cells = {0, static_cast<std::uint32_t>(layout.stride + 5)};
  update_rows(layout, cells, taps.data(), grid.data());
  double sum = 0;
  for (const double value : grid) sum += value;
  EXPECT_EQ(sum, 2 * 6 * 36 * (2 + 3));
  EXPECT_EQ(grid[0], 5);
  EXPECT_EQ(grid[layout.stride * 6 + 5 + 7], 40);  // last row and column of the second source
}

TEST(compare_coefficients, is_relative_to_the_reference_without_its_mean) {
  Coefficients reference(2), found(2);
  reference.c(0, 0) = found.c(0, 0) = 100;
  reference.c(1, 0) = found.c(1, 0) = 3;
  reference.s(2, 1) = 4;
  found.s(2, 1) = 4.05;
  found.c(0, 0) *= 1 + 1e-6;
  const CoefficientsError error = compare_coefficients(found, reference);
  EXPECT_NEAR(error.error, 0.01, 1e-15);        // 0.05 / |(3, 4)|
  EXPECT_NEAR(error.top_error, 0.0125, 1e-15);  // 0.05 / 4: only degree 2 is above 3L/4
  EXPECT_NEAR(error.mean, 1e-6, 1e-15);
  EXPECT_THROW(compare_coefficients(found, Coefficients(3)), Error);
}

TEST(bench_reference, is_direct_for_a_small_mesh_and_close_to_the_fast_engine) {
  const BumpyFile bumpy;
  const Expanded expanded = expand_file(bumpy.path, {.degree = 16, .precision = 1e-6});
  const Reference reference = bench_reference(bumpy.path, expanded.star.center, quick());
  EXPECT_EQ(reference.engine, Engine::kDirect);
  EXPECT_LE(reference.precision, 1e-7);
  EXPECT_LE(
      compare_coefficients(expanded.transform.expansion.coefficients, reference.coefficients).error,
      1e-6);
}

TEST(bench_reference, a_fast_one_is_far_better_than_any_wish_it_serves) {
  EXPECT_LE(bench_reference_error().error, 1e-11);
}

TEST(peak_memory, is_that_of_what_follows_its_restart) {
  if (!restart_peak_memory() || !peak_memory()) GTEST_SKIP() << "the system does not tell";
  constexpr std::size_t kBytes = std::size_t{1} << 26;
  const std::size_t before = *peak_memory();
  // Memory is not taken from the heap, which may keep freed memory.
  void* const block =
      ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  std::memset(block, 1, kBytes);
  ::munmap(block, kBytes);
  EXPECT_GE(*peak_memory(), before + kBytes * 9 / 10);
  ASSERT_TRUE(restart_peak_memory());
  EXPECT_LE(*peak_memory(), before + kBytes / 2);
}

}  // namespace
}  // namespace rholm
