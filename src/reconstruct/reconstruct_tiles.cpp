#include "reconstruct/shared_tiles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/check_fields.h"
#include "base/crc32.h"
#include "base/field_text.h"
#include "base/refuse.h"
#include "io/file/temporary_folder.h"
#include "io/spill/folder_store.h"
#include "parts/memory_store.h"
#include "reconstruct/points/moved_scans.h"
#include "reconstruct/tile_run.h"
#include "rholm/error.h"
#include "rholm/point_stream.h"
#include "rholm/version.h"

namespace rholm {
namespace {

// Bytes for each point of a tile with its halo, on two threads. They are 1019 of a sphere in four
// tiles of 250 000 points (scripts/memory-figures), more of rough bodies and of larger tiles
// (bench/tiles). Bytes for each point of all tiles, where handles are cut: measured on 100 million
// points of a rough body (bench/tiles). Points of smooth bodies take a few bytes.
constexpr std::uint64_t kMemoryOfPoint = 1750, kMemoryOfAny = 22;
// Runs have taken up to 1.21 times the memory that was foreseen (373 MiB of 307). Chosen: several
// tiles get as much again for tables; 1.34 times was not enough for tiles of 16 384 points.
constexpr double kForecastError = 1.25, kSeveralTiles = 2;
// The least limit that is named as enough; most of it does not grow with tiles. For 40 000 points,
// tiles of 2900 were made within 12.3 MiB, and tiles of 1000 needed more than 8.2
// (tests/cli/reconstruct_test.py). Chosen: above what was enough.
constexpr double kLeastMemory = 13 << 20;
// Bytes for each point with its normal: the most that is stored of its part of the surface and of
// itself, and its part in the output (scripts/memory-figures).
constexpr std::uint64_t kStoredOfPoint = 520, kWrittenOfPoint = 290;
// Bytes of the surface and its caps in memory: a vertex with its normal and two triangles has 72
// bytes where the output has 50, and caps have about 80 per point.
constexpr std::uint64_t kKeptOfPoint = kWrittenOfPoint * 72 / 50 + 80;

// Checks the room on the disk for the file of the surface; streams need none.
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

// Describes the file, as far as that is possible without reading it.
std::string text_of(const std::filesystem::path& points) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(points, error)) return points.string();
  const auto size = std::filesystem::file_size(points, error);
  const auto time = std::filesystem::last_write_time(points, error).time_since_epoch();
  return fmt::format("{}, {} bytes, of {}",
                     std::filesystem::weakly_canonical(points, error).string(), size,
                     std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
}

// Describes points in memory.
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

// Returns true if the data between the steps fit into memory with everything else.
bool fits_in_memory(std::uint64_t points, const ReconstructOptions& options) {
  const TileForecast forecast = foresee_tiles(points, options.tile_points);
  const std::uint64_t kept = options.output.empty() ? kKeptOfPoint * points : 0;
  return forecast.memory + forecast.stored + kept < options.max_memory / 2;
}

// Store of the data between the steps. It is a folder that the next run finds again, a folder that
// is removed at the end, or memory, as for one tile.
class TileStore {
 public:
  // There are `n` points, if that is known. `input` describes them in a folder to resume from.
  TileStore(std::optional<std::uint64_t> n, const ReconstructOptions& options, bool is_shared,
            const std::function<std::string()>& input) {
    if (n && *n <= options.tile_points && !is_shared) {
      store_ = std::make_unique<MemoryStore>();
      return;
    }
    const std::filesystem::path base =
        options.work_dir.empty() ? std::filesystem::temp_directory_path() : options.work_dir;
    if (options.resume) {
      folder_ = base / (options.output.filename().string() + ".tiles");
      store_ = std::make_unique<FolderStore>(
          folder_,
          fmt::format("rholm {}\npoints {}\n{}\n", kVersion, input(), text_of_fields(options)));
      store_->keep(true);
    } else if (is_shared || !n || !fits_in_memory(*n, options)) {
      own_.emplace(base, "rholm-tiles-");
      folder_ = own_->path() / "tiles";
      store_ = std::make_unique<FolderStore>(folder_);
    } else {
      store_ = std::make_unique<MemoryStore>();
    }
  }
  const std::filesystem::path& folder() const { return folder_; }  // empty: in memory
  PieceStore& operator*() const { return *store_; }
  PieceStore* operator->() const { return store_.get(); }

 private:
  std::optional<TemporaryFolder> own_;
  std::filesystem::path folder_;
  std::unique_ptr<PieceStore> store_;  // is gone before its folder
};

constexpr double kGibibyte = 0x1p30;

// Rounds up to two digits, so that a limit of this size is enough.
double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return unit * std::ceil(value / unit);
}

// Returns "take smaller tiles (--tile-points 4900)" for tiles that fit into the memory. If none do,
// it says how much memory is enough.
std::string advice_of_tiles(std::uint64_t max_memory) {
  constexpr double kOfPoint = kForecastError * kSeveralTiles * static_cast<double>(kMemoryOfPoint);
  const auto given = static_cast<double>(max_memory);
  const double points = std::max(given, kLeastMemory) / kOfPoint;
  const double unit = std::pow(10, std::floor(std::log10(points)) - 1);
  const double tile = unit * std::floor(points / unit);
  if (given >= kLeastMemory) return fmt::format("take smaller tiles (--tile-points {:.0f})", tile);
  return fmt::format("{:.2g} GiB would do for tiles of {:.0f} points (--tile-points {:.0f})",
                     rounded_up(kLeastMemory / kGibibyte), tile, tile);
}

// Throws if the points of the only tile need too much memory. The grid is checked later.
void check_only(std::uint64_t points, std::uint64_t max_memory) {
  const std::uint64_t least = kMemoryOfOnly * points;
  if (least <= max_memory) return;
  throw Error(ErrorCode::kOutOfMemory,
              fmt::format("{} points in one tile need more than {:.2g} GiB, and {:.2g} are "
                          "allowed: allow more memory",
                          points, static_cast<double>(least) / kGibibyte,
                          static_cast<double>(max_memory) / kGibibyte));
}

// Returns the bytes of ReconstructOptions::max_memory that are enough for the work on tiles, beside
// data stored in memory. They include what runs have taken beyond their forecast.
std::uint64_t enough_for_tiles(std::uint64_t points, std::uint64_t tile_points) {
  const std::uint64_t of_tile = kMemoryOfPoint * std::min(points, tile_points);
  return static_cast<std::uint64_t>(kForecastError * (points > tile_points ? kSeveralTiles : 1) *
                                    static_cast<double>(of_tile));
}

// Checks the memory that is known before the points themselves decide.
void check_memory(std::uint64_t points, const ReconstructOptions& options) {
  const auto allowed = static_cast<double>(options.max_memory) / kGibibyte;
  const std::uint64_t of_tile = kMemoryOfPoint * std::min(points, options.tile_points);
  if (of_tile > options.max_memory) {
    const std::uint64_t enough = enough_for_tiles(points, options.tile_points);
    throw Error(
        ErrorCode::kOutOfMemory,
        fmt::format("tiles of {} points need some {:.2g} GiB, and {:.2g} are allowed: {}",
                    options.tile_points, rounded_up(static_cast<double>(enough) / kGibibyte),
                    allowed, advice_of_tiles(options.max_memory)));
  }
  const std::uint64_t kept = options.output.empty() ? kKeptOfPoint * points : 0;
  if (of_tile + kept > options.max_memory) {
    throw Error(
        ErrorCode::kOutOfMemory,
        fmt::format("the surface of {} points needs some {:.2g} GiB in memory, and {:.2g} "
                    "are allowed: let it be written to a file (output)",
                    points, rounded_up(static_cast<double>(of_tile + kept) / kGibibyte), allowed));
  }
}

// Source of a process that reads no points.
class NoPoints final : public PointSource {
 public:
  void rewind() override {}
  bool next(PointCloud&, const Context&) override { return false; }
  std::optional<std::uint64_t> size() const override { return std::nullopt; }
  double part_read() const override { return 1; }
};

// `open` gives the source of the points, once there is a store.
Reconstruction reconstruct_source(const TileStore& store,
                                  const std::function<std::unique_ptr<PointSource>()>& open,
                                  const ReconstructOptions& options, const SharedRun& run,
                                  const Context& context) {
  if (run.begun) run.begun(store.folder());
  std::unique_ptr<PointSource> source = open();
  ScanAlignment scans;
  std::uint64_t memory = 0;
  bool is_only = false;  // one tile
  const auto foreseen = [&](const Survey& survey, std::size_t n_tiles) {
    is_only = n_tiles == 1;
    if (is_only) {
      check_only(survey.points, options.max_memory);
      return;
    }
    TileForecast forecast = foresee_tiles(survey.points, options.tile_points);
    forecast.tiles = n_tiles;
    memory = forecast.memory;
    check_memory(survey.points, options);
    const std::uint64_t there = store->bytes();
    if (!store->in_memory() && forecast.stored > there) store->check_room(forecast.stored - there);
    if (!options.output.empty()) check_room(options.output, forecast.written);
    if (options.foreseen) options.foreseen(forecast);
  };
  try {
    source = with_moved_scans(std::move(source), *store, options, scans, context);
    Reconstruction made;
    try {
      made = run_tiles(*source, *store, {.reconstruct = options, .foreseen = foreseen},
                       run.executor, context);
    } catch (const Error& error) {
      if (!is_only || error.code() != ErrorCode::kOutOfMemory) throw;
      throw Error(error.code(),
                  fmt::format("{}; or {}", error.what(), advice_of_tiles(options.max_memory)));
    }
    if (!is_only) made.report.memory = memory;
    made.report.scans = scans;
    store->keep(false);
    return made;
  } catch (...) {
    if (run.failed) run.failed(std::current_exception());
    throw;
  }
}

Reconstruction reconstruct_cloud(const PointCloud& points, const ReconstructOptions& options,
                                 const SharedRun& run, const Context& context,
                                 const std::function<std::unique_ptr<PointSource>()>& open) {
  check_fields(options);
  const auto fits = [&](std::size_t n) { return n == points.points.size(); };
  if (!points.normals.empty() && !fits(points.normals.size())) {
    refuse(fmt::format("there are {} normals for {} points", points.normals.size(),
                       points.points.size()));
  }
  for (const Attribute& attribute : points.attributes) {
    if (fits(attribute.values.size())) continue;
    refuse(fmt::format("the attribute {} has {} values for {} points", attribute.name,
                       attribute.values.size(), points.points.size()));
  }
  const TileStore store(points.points.size(), options, run.executor.is_shared(),
                        [&] { return text_of(points); });
  return reconstruct_source(store, open, options, run, context);
}

}  // namespace

TileForecast foresee_tiles(std::uint64_t points, std::uint64_t tile_points) {
  check_fields(ReconstructOptions{.tile_points = tile_points});
  return {.points = points,
          .tiles = (points + tile_points - 1) / tile_points,
          .memory = std::max(kMemoryOfPoint * std::min(points, tile_points), kMemoryOfAny * points),
          .stored = kStoredOfPoint * points,
          .written = kWrittenOfPoint * points};
}

Reconstruction reconstruct_tiles(const std::filesystem::path& points, const std::string& columns,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context) {
  check_fields(options);
  std::error_code error;
  std::optional<std::uint64_t> n;
  if (std::filesystem::is_regular_file(points, error)) {
    n = PointStream(points, {.columns = columns}).size();
  }
  const TileStore store(n, options, run.executor.is_shared(),
                        [&] { return fmt::format("{}, columns '{}'", text_of(points), columns); });
  return reconstruct_source(
      store, [&] { return open_points(points, {.columns = columns}, *store); }, options, run,
      context);
}

Reconstruction reconstruct_tiles(const PointCloud& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context) {
  return reconstruct_cloud(points, options, run, context,
                           [&] { return points_in_memory(points, dropped); });
}

Reconstruction reconstruct_tiles(PointCloud&& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context) {
  return reconstruct_cloud(points, options, run, context,
                           [&] { return points_in_memory(std::move(points), dropped); });
}

void help_reconstruct(const std::filesystem::path& folder, const ReconstructOptions& options,
                      Executor& executor, const Context& context) {
  const std::unique_ptr<PieceStore> store = FolderStore::joined(folder);
  NoPoints none;
  run_tiles(none, *store, {.reconstruct = options}, executor, context);
}

}  // namespace rholm
