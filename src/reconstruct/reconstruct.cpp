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
#include "reconstruct/points/point_rows.h"
#include "reconstruct/reconstruct_piece.h"
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

bool are_more(const PointCloud& cloud, std::uint64_t most) {
  if (cloud.points.size() <= most) return false;
  const auto finite = std::count_if(cloud.points.begin(), cloud.points.end(),
                                    [](const Vec3& p) { return is_finite(p); });
  return static_cast<std::uint64_t>(finite) > most;
}

void write(const ReconstructOptions& options, Reconstruction& made, const Context& context) {
  if (!options.output.empty()) {
    for (std::string& warning :
         write_shape(made.mesh, options.output, {.format = ShapeFormat::kPly}, context)) {
      made.report.warnings.push_back(std::move(warning));
    }
  }
  if (!options.model.empty()) write_atlas(made.model, options.model);
  if (!options.output.empty()) made.mesh = {}, made.model = {};
}

Reconstruction in_one_piece(PointCloud cloud, std::uint64_t dropped,
                            const ReconstructOptions& options, const Context& context) {
  Reconstruction made;
  try {
    made = reconstruct_piece(std::move(cloud), options, context);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kOutOfMemory) throw;
    throw Error(error.code(),
                fmt::format("{}; or {}", error.what(), advice_of_tiles(options.max_memory)));
  }
  add_dropped(dropped, made.report);
  made.model.input_numbers = 3 * made.report.points;
  write(options, made, context);
  return made;
}

Reconstruction in_tiles(const PointCloud& cloud, std::uint64_t dropped,
                        const ReconstructOptions& options, const Context& context) {
  Threads alone;
  return reconstruct_tiles(cloud, dropped, options, {.executor = alone}, context);
}

// A mesh, and what cannot be read in portions.
Reconstruction of_whole_file(const std::filesystem::path& points, const std::string& columns,
                             const ReconstructOptions& options, const Context& context) {
  ShapeFile file = read_shape(points, {.columns = columns}, context);
  auto* mesh = std::get_if<Mesh>(&file.shape);
  PointCloud cloud = mesh != nullptr ? points_of_mesh(std::move(*mesh))
                                     : std::get<PointCloud>(std::move(file.shape));
  Reconstruction made = are_more(cloud, options.tile_points)
                            ? in_tiles(cloud, file.dropped, options, context)
                            : in_one_piece(std::move(cloud), file.dropped, options, context);
  if (file.table.unsure) made.report.warnings.push_back(file.table.note);
  if (file.dropped > 0) {
    made.report.warnings.push_back(
        fmt::format("{} points with a coordinate that is not finite dropped", file.dropped));
  }
  return made;
}

// Whether the file has more points that are finite, and is read in portions.
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

// All points of the source, if they are no more.
std::optional<PointCloud> those_of(PointSource& source, std::uint64_t most,
                                   const Context& context) {
  PointCloud all, piece;
  PointLayout layout;
  while (source.next(piece, context)) {
    if (all.points.empty()) {
      layout = layout_of(piece);
      all = piece;
    } else {
      widen(layout, layout_of(piece));
      all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
      all.normals.insert(all.normals.end(), piece.normals.begin(), piece.normals.end());
      for (std::size_t k = 0; k < all.attributes.size(); ++k) {
        const std::vector<double>& more = piece.attributes[k].values;
        std::vector<double>& values = all.attributes[k].values;
        values.insert(values.end(), more.begin(), more.end());
      }
    }
    if (all.points.size() > most) return std::nullopt;
    ask_cancel();
  }
  for (Attribute& attribute : all.attributes) {
    for (const ColumnLayout& column : layout.columns) {
      if (column.name == attribute.name) attribute.type = column.type;
    }
  }
  return all;
}

}  // namespace

void add_dropped(std::size_t n, ReconstructReport& report) {
  report.points += n;
  report.dropped_points += n;
}

Reconstruction reconstruct(const PointCloud& cloud, const ReconstructOptions& options,
                           const Context& context) {
  check_call(options);
  if (are_more(cloud, options.tile_points)) return in_tiles(cloud, 0, options, context);
  return in_one_piece(cloud, 0, options, context);
}

Reconstruction reconstruct(PointCloud&& cloud, const ReconstructOptions& options,
                           const Context& context) {
  check_call(options);
  if (are_more(cloud, options.tile_points)) return in_tiles(cloud, 0, options, context);
  return in_one_piece(std::move(cloud), 0, options, context);
}

Reconstruction reconstruct(const std::filesystem::path& points, const ReconstructOptions& options,
                           const Context& context, const std::string& columns) {
  check_call(options);
  Threads alone;
  SharedRun run{.executor = alone};
  if (is_once(points)) {
    run.instead = [&](PointSource& source) -> std::optional<Reconstruction> {
      std::optional<PointCloud> few = those_of(source, options.tile_points, context);
      if (!few) return std::nullopt;
      Reconstruction made = in_one_piece(std::move(*few), source.dropped(), options, context);
      made.report.warnings = source.warnings();
      return made;
    };
  } else if (!has_more(points, columns, options.tile_points, context)) {
    return of_whole_file(points, columns, options, context);
  }
  return reconstruct_tiles(points, columns, options, run, context);
}

}  // namespace rholm
