#include "model/bricks/brick_seen.h"

#include <cstdint>
#include <string>
#include <vector>

#include "model/bricks/brick_points.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

std::string name_of(std::size_t brick) { return "seen/" + std::to_string(brick); }

}  // namespace

bool BrickSeen::has(std::size_t brick) const { return store_.has(name_of(brick)); }

void BrickSeen::find(std::size_t brick, const Context& context) {
  const PointCloud cloud = read_points(store_, brick);
  const std::vector<Vec3> sensors =
      sight_.sensor ? std::vector<Vec3>(cloud.points.size(), *sight_.sensor) : sensors_of(cloud);
  std::vector<std::uint64_t> cubes;  // none: unknown
  if (cloud.points.empty() || !sensors.empty()) {
    SeenSpace seen(sight_.box, sight_.edge);
    seen.add_lines(cloud.points, sensors, sight_.margin, context);
    cubes = seen.cubes();
  }
  const std::span<const std::byte> sections[] = {bytes_of(cubes)};
  store_.write(name_of(brick), sections);
}

std::optional<SeenSpace> BrickSeen::join(const Context& context) const {
  SeenSpace all(sight_.box, sight_.edge);
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    const auto cubes = vector_of<std::uint64_t>(store_.open(name_of(brick)).read(0));
    if (cubes.empty()) return std::nullopt;
    all.add_cubes(cubes);
  }
  all.smooth(context);
  return all;
}

}  // namespace rholm
