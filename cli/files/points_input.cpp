#include "cli/files/points_input.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/terminal/interrupt.h"
#include "reconstruct/points/mesh_points.h"
#include "rholm/error.h"
#include "rholm/point_stream.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

// Bytes of a line with three one-digit numbers.
constexpr std::uintmax_t kShortestLine = 6;
constexpr std::size_t kAtATime = std::size_t{1} << 14;

PointCloud points_of(ShapeFile file, const std::string& path, Session& session) {
  say_what_was_read(file, path, session);
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) return std::move(*cloud);
  Mesh& mesh = std::get<Mesh>(file.shape);
  session.note(fmt::format("{} is a mesh; its {} vertices are used as points", display_name(path),
                           mesh.vertices.size()));
  return points_of_mesh(std::move(mesh));
}

// Returns true if a file has more points than `most` and can be read in portions. Sets `n` if the
// file states the number.
bool has_more(const std::string& path, const std::string& columns, std::uint64_t most,
              std::optional<std::uint64_t>& n, Session& session) {
  if (file_size_of(path).value_or(0) / kShortestLine <= most) return false;
  try {
    PointStream stream(path, {.columns = columns});
    if (stream.has_faces()) return false;
    n = stream.size();
    PointCloud some;
    if (n && *n <= most) return false;
    // Only finite points count.
    while (stream.read_so_far() <= most && stream.read(kAtATime, some, session.context())) {
      stop_if_interrupted();
    }
    const bool more = stream.read_so_far() > most;
    if (more) say_what_was_read(stream.table(), {}, path, session);
    return more;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return false;  // the reader of the whole file reports the error
  }
}

}  // namespace

PointsInput read_points_input(const std::string& path, std::uint64_t most,
                              const std::string& columns, const MemoryOptions& memory,
                              Session& session) {
  PointsInput input{.columns = columns};
  const auto take = [&](ShapeFile file) {
    input.dropped = file.dropped;
    input.cloud = points_of(std::move(file), path, session);
  };
  if (is_stream(path)) {
    input.spooled = std::make_unique<SpooledInput>(path, memory.limit() / 4, memory.folder());
    if (!input.spooled->is_in_file()) {
      take(read_shape_of(input.spooled->bytes(), path, session, columns));
      input.n = input.cloud->points.size();
      input.spooled.reset();
      return input;
    }
  }
  input.file = input.spooled ? input.spooled->path_of_file() : path;
  if (!has_more(input.file, columns, most, input.n, session)) {
    take(read_shape_input(input.file, session, columns));
  }
  if (input.cloud) input.n = input.cloud->points.size();
  return input;
}

Bounds bounds_of_points(const std::string& file, const std::string& columns, Session& session) {
  PointStream stream(file, {.columns = columns});
  PointCloud some;
  Bounds box;
  bool none = true;
  while (stream.read(kAtATime, some, session.context())) {
    stop_if_interrupted();
    if (!none) some.points.insert(some.points.end(), {box.min, box.max});
    box = bounds(some.points);
    none = false;
  }
  return box;
}

}  // namespace rholm::cli
