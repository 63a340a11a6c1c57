#include "reconstruct/points/tile_seen.h"

#include <cstdint>
#include <string>
#include <vector>

#include "reconstruct/points/tile_points.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

std::string name_of(std::size_t tile) { return "seen/" + std::to_string(tile); }

}  // namespace

bool TileSeen::has(std::size_t tile) const { return store_.has(name_of(tile)); }

void TileSeen::find(std::size_t tile, const Context& context) {
  const PointCloud cloud = read_points(store_, tile);
  const std::vector<Vec3> sensors =
      sight_.sensor ? std::vector<Vec3>(cloud.points.size(), *sight_.sensor) : sensors_of(cloud);
  std::vector<std::uint64_t> cubes;  // none: unknown
  if (cloud.points.empty() || !sensors.empty()) {
    SeenSpace seen(sight_.box, sight_.edge);
    seen.add_lines(cloud.points, sensors, sight_.margin, context);
    cubes = seen.cubes();
  }
  const std::span<const std::byte> sections[] = {bytes_of(cubes)};
  store_.write(name_of(tile), sections);
}

std::optional<SeenSpace> TileSeen::join(const Context& context) const {
  SeenSpace all(sight_.box, sight_.edge);
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    const auto cubes = vector_of<std::uint64_t>(store_.open(name_of(tile)).read(0));
    if (cubes.empty()) return std::nullopt;
    all.add_cubes(cubes);
  }
  all.smooth(context);
  return all;
}

}  // namespace rholm
