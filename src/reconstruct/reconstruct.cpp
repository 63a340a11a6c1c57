#include "rholm/reconstruct.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/cancel.h"
#include "base/check_fields.h"
#include "base/refuse.h"
#include "parts/threads.h"
#include "reconstruct/points/mesh_points.h"
#include "reconstruct/shared_tiles.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/point_stream.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

constexpr std::size_t kAtATime = std::size_t{1} << 14;  // points; chosen: they stay in the cache

void check_call(const ReconstructOptions& options) {
  check_fields(options);
  if (shape_format_of(options.output).value_or(ShapeFormat::kPly) != ShapeFormat::kPly) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{}: the surface is a binary PLY: NAME.ply", options.output.string()));
  }
  if (options.resume && options.output.empty()) {
    refuse("what is in memory cannot be resumed: give an output");
  }
}

bool is_once(const std::filesystem::path& path) {
  std::error_code error;
  return path == "-" ||
         (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error));
}

// Reconstructs a mesh, or a file that cannot be read in portions.
Reconstruction of_whole_file(const std::filesystem::path& points, const std::string& columns,
                             const ReconstructOptions& options, const Context& context) {
  ShapeFile file = read_shape(points, {.columns = columns}, context);
  auto* mesh = std::get_if<Mesh>(&file.shape);
  PointCloud cloud = mesh != nullptr ? points_of_mesh(std::move(*mesh))
                                     : std::get<PointCloud>(std::move(file.shape));
  Threads alone;
  Reconstruction made =
      reconstruct_tiles(std::move(cloud), file.dropped, options, {.executor = alone}, context);
  if (file.table.unsure) made.report.warnings.push_back(file.table.note);
  if (file.dropped > 0) {
    made.report.warnings.push_back(
        fmt::format("{} points with a coordinate that is not finite dropped", file.dropped));
  }
  return made;
}

// Returns whether the file is read in portions and has more finite points. Files with fewer points
// are read as a whole, because then any row may change the type of its column.
bool has_more(const std::filesystem::path& points, const std::string& columns, std::uint64_t most,
              const Context& context) {
  try {
    PointStream stream(points, {.columns = columns});
    if (stream.has_faces() || stream.size().value_or(most + 1) <= most) return false;
    PointCloud some;
    while (stream.read_so_far() <= most && stream.read(kAtATime, some, context)) ask_cancel();
    return stream.read_so_far() > most;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return false;  // the reader of the whole file says what is wrong
  }
}

}  // namespace

void add_dropped(std::size_t n, ReconstructReport& report) {
  report.points += n;
  report.dropped_points += n;
}

Reconstruction reconstruct(const PointCloud& cloud, const ReconstructOptions& options,
                           const Context& context) {
  check_call(options);
  Threads alone;
  return reconstruct_tiles(cloud, 0, options, {.executor = alone}, context);
}

Reconstruction reconstruct(PointCloud&& cloud, const ReconstructOptions& options,
                           const Context& context) {
  check_call(options);
  Threads alone;
  return reconstruct_tiles(std::move(cloud), 0, options, {.executor = alone}, context);
}

Reconstruction reconstruct(const std::filesystem::path& points, const ReconstructOptions& options,
                           const Context& context, const std::string& columns) {
  check_call(options);
  if (!is_once(points) && !has_more(points, columns, options.tile_points, context)) {
    return of_whole_file(points, columns, options, context);
  }
  Threads alone;
  return reconstruct_tiles(points, columns, options, {.executor = alone}, context);
}

}  // namespace rholm
