#include "reconstruct/points/tile_points.h"

#include "parts/memory_store.h"
#include "rholm/error.h"

// Reads a sorted tile. The first byte says where the index ends; then follow rows of one chunk.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto* const bytes = reinterpret_cast<const std::byte*>(data) + 1;
  const std::size_t index = std::min<std::size_t>(data[0], size - 1);
  const std::vector<std::span<const std::byte>> sections = {{bytes, index},
                                                            {bytes + index, size - 1 - index}};
  rholm::MemoryStore store;
  store.write(rholm::sorted_name(0), sections);
  try {
    const rholm::TilePoints points = rholm::read_points(store, 0);
    if (points.points.size() > size) __builtin_trap();
    if (!points.normals.empty() && points.normals.size() != points.points.size()) __builtin_trap();
    const rholm::TilePoints part = rholm::read_points_within(store, 0, {{-1, -1, -1}, {1, 1, 1}});
    if (part.points.size() > points.points.size()) __builtin_trap();
  } catch (const rholm::Error&) {
    return 0;
  }
  return 0;
}
