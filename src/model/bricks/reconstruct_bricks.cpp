#include "rholm/reconstruct_bricks.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/check_fields.h"
#include "base/crc32.h"
#include "base/field_text.h"
#include "model/bricks/brick_run.h"
#include "model/bricks/shared_bricks.h"
#include "rholm/error.h"
#include "rholm/version.h"

namespace rholm {
namespace {

// Bytes for each point of a brick with its halo, on two threads: 1019 of a sphere in four bricks of
// 250 000 points (scripts/memory-figures), more of rough bodies and of larger bricks
// (bench/bricks). And for each point of all bricks, where handles are cut: measured on 100 million
// points of a rough body (bench/bricks). Smooth ones take a few bytes.
constexpr std::uint64_t kMemoryOfPoint = 1750, kMemoryOfAny = 22;
// Runs have taken up to 1.21 times the memory that was foreseen (373 MiB of 307). Chosen: several
// bricks have as much again for tables; those of 16 384 points did not do with 1.34 times.
constexpr double kForecastError = 1.25, kSeveralBricks = 2;
// For each point with its normal: what is stored of it and of its part of the surface, most at a
// time, and that part in the output (scripts/memory-figures).
constexpr std::uint64_t kStoredOfPoint = 520, kWrittenOfPoint = 290;

// Of the disk where the surface will be; streams have none.
void check_room(const std::filesystem::path& mesh, std::uint64_t bytes) {
  const std::filesystem::path folder = mesh.has_parent_path() ? mesh.parent_path() : ".";
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  const bool is_file = mesh != "-" && (!std::filesystem::exists(mesh, error) ||
                                       std::filesystem::is_regular_file(mesh, error));
  if (!is_file || error || space.available >= bytes) return;
  constexpr double kGigabyte = 1e9;
  throw Error(
      ErrorCode::kIo,
      fmt::format("{} will have {:.1f} GB, and there is room for {:.1f} GB: give a place on "
                  "another disk",
                  mesh.string(), static_cast<double>(bytes) / kGigabyte,
                  static_cast<double>(space.available) / kGigabyte));
}

// What the file is, as far as that can be told without reading it.
std::string text_of(const std::filesystem::path& points) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(points, error)) return points.string();
  const auto size = std::filesystem::file_size(points, error);
  const auto time = std::filesystem::last_write_time(points, error).time_since_epoch();
  return fmt::format("{}, {} bytes, of {}",
                     std::filesystem::weakly_canonical(points, error).string(), size,
                     std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
}

// What points in memory are.
std::string text_of(const PointCloud& cloud) {
  std::uint32_t sum = 0;
  const auto add = [&sum](const auto& values) {
    const auto bytes = std::as_bytes(std::span(values));
    sum = crc32({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, sum);
  };
  add(cloud.points);
  add(cloud.normals);
  std::string names;
  for (const Attribute& attribute : cloud.attributes) {
    names += fmt::format(" {} ({})", attribute.name, static_cast<int>(attribute.type));
    add(attribute.values);
  }
  return fmt::format("{} in memory, {} normals, attributes{}, CRC-32 {:08x}", cloud.points.size(),
                     cloud.normals.size(), names.empty() ? " none" : names, sum);
}

std::string manifest(const std::string& input, const ReconstructOptions& options,
                     const BrickOptions& bricks) {
  return fmt::format("rholm {}\npoints {}\n{}\n{}\n", kVersion, input, text_of_fields(bricks),
                     text_of_fields(options));
}

std::unique_ptr<PieceStore> open_store(const std::string& input, const ReconstructOptions& options,
                                       const BrickOptions& bricks) {
  if (bricks.work_dir.empty()) return std::make_unique<PieceStore>();
  auto store = std::make_unique<PieceStore>(bricks.work_dir, manifest(input, options, bricks));
  if (!bricks.resume && store->was_there()) {
    store->keep(true);
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the folder {} has what an earlier run has left: resume that "
                            "(--resume), or delete it",
                            bricks.work_dir.string()));
  }
  store->keep(bricks.resume);
  return store;
}

constexpr double kGibibyte = 0x1p30;

// To two digits, so that a limit of so much is enough.
double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return unit * std::ceil(value / unit);
}

// What the points themselves decide is not known before.
void check_memory(std::uint64_t points, const ReconstructOptions& options,
                  const BrickOptions& bricks) {
  const std::uint64_t needed = kMemoryOfPoint * std::min(points, bricks.points_per_brick);
  if (needed <= options.max_memory) return;
  const std::uint64_t enough = enough_for_bricks(points, bricks.points_per_brick);
  throw Error(
      ErrorCode::kOutOfMemory,
      fmt::format("tiles of {} points need some {:.2g} GiB, and {:.2g} are allowed: take "
                  "smaller tiles (--tile-points)",
                  bricks.points_per_brick, rounded_up(static_cast<double>(enough) / kGibibyte),
                  static_cast<double>(options.max_memory) / kGibibyte));
}

BrickRunOptions run_options(const ReconstructOptions& options, const BrickOptions& bricks) {
  return {
      .reconstruct = options, .points_per_brick = bricks.points_per_brick, .model = bricks.model};
}

// Of a process that reads none.
class NoPoints final : public PointSource {
 public:
  void rewind() override {}
  bool next(PointCloud&, const Context&) override { return false; }
  std::optional<std::uint64_t> size() const override { return std::nullopt; }
  double part_read() const override { return 1; }
};

// `open` gives the source of the points, once there is a store.
template <class Open>
BrickReconstruction reconstruct_source(const std::string& input, const Open& open,
                                       const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const SharedRun& run,
                                       const Context& context) {
  check_fields(bricks);
  const std::unique_ptr<PieceStore> store = open_store(input, options, bricks);
  if (run.begun) run.begun();
  const std::unique_ptr<PointSource> source = open(*store);
  std::uint64_t memory = 0;
  const auto foreseen = [&](const Survey& survey, std::size_t n_bricks) {
    BrickForecast forecast = foresee_bricks(survey.points, bricks.points_per_brick);
    forecast.bricks = n_bricks;
    memory = forecast.memory;
    check_memory(survey.points, options, bricks);
    const std::uint64_t there = store->bytes();
    if (!store->in_memory() && forecast.stored > there) store->check_room(forecast.stored - there);
    check_room(mesh, forecast.written);
    if (bricks.foreseen) bricks.foreseen(forecast);
  };
  BrickRunOptions wanted = run_options(options, bricks);
  wanted.foreseen = foreseen;
  try {
    BrickReconstruction made = run_bricks(*source, *store, mesh, wanted, run.crew, context);
    store->keep(false);
    made.report.memory = memory;
    return made;
  } catch (...) {
    if (run.failed) run.failed(std::current_exception());
    throw;
  }
}

}  // namespace

BrickForecast foresee_bricks(std::uint64_t points, std::uint64_t points_per_brick) {
  check_fields(BrickOptions{.points_per_brick = points_per_brick});
  return {.points = points,
          .bricks = (points + points_per_brick - 1) / points_per_brick,
          .memory =
              std::max(kMemoryOfPoint * std::min(points, points_per_brick), kMemoryOfAny * points),
          .stored = kStoredOfPoint * points,
          .written = kWrittenOfPoint * points};
}

std::uint64_t enough_for_bricks(std::uint64_t points, std::uint64_t points_per_brick) {
  check_fields(BrickOptions{.points_per_brick = points_per_brick});
  const std::uint64_t of_brick = kMemoryOfPoint * std::min(points, points_per_brick);
  return static_cast<std::uint64_t>(kForecastError *
                                    (points > points_per_brick ? kSeveralBricks : 1) *
                                    static_cast<double>(of_brick));
}

BrickReconstruction reconstruct_shared(const std::filesystem::path& points,
                                       const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const SharedRun& run,
                                       const Context& context) {
  return reconstruct_source(
      text_of(points),
      [&](PieceStore& store) { return open_points(points, {.columns = bricks.columns}, store); },
      mesh, options, bricks, run, context);
}

BrickReconstruction reconstruct_shared(const PointCloud& points, const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const SharedRun& run,
                                       const Context& context) {
  validate(points);
  return reconstruct_source(
      bricks.work_dir.empty() ? std::string() : text_of(points),
      [&](PieceStore&) { return points_in_memory(points); }, mesh, options, bricks, run, context);
}

void help_reconstruct(const std::filesystem::path& mesh, const ReconstructOptions& options,
                      const BrickOptions& bricks, BrickCrew& crew, const Context& context) {
  const std::unique_ptr<PieceStore> store = PieceStore::joined(bricks.work_dir);
  NoPoints none;
  run_bricks(none, *store, mesh, run_options(options, bricks), crew, context);
}

BrickReconstruction reconstruct_bricks(const std::filesystem::path& points,
                                       const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const Context& context) {
  OneProcess alone;
  return reconstruct_shared(points, mesh, options, bricks, {.crew = alone}, context);
}

BrickReconstruction reconstruct_bricks(const PointCloud& points, const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const Context& context) {
  OneProcess alone;
  return reconstruct_shared(points, mesh, options, bricks, {.crew = alone}, context);
}

}  // namespace rholm
