#include "rholm/point_stream.h"

#include <optional>

#include "named_bytes.h"

namespace rholm::fuzzing {
namespace {

std::optional<std::vector<Vec3>> read_in_pieces(const std::string& name, std::size_t n) {
  std::vector<Vec3> points;
  try {
    PointStream stream(name);
    PointCloud piece;
    while (stream.read(n, piece)) {
      require(!piece.points.empty() && piece.points.size() <= n);
      validate(piece);
      points.insert(points.end(), piece.points.begin(), piece.points.end());
    }
  } catch (const Error&) {
    return std::nullopt;
  }
  return points;
}

// Checks that an Error is thrown, or that the points equal the ones of the whole file, if it can be
// read.
void check(std::span<const char> bytes) {
  const NamedBytes file(bytes);
  const auto found = read_in_pieces(file.name(), 1 + bytes.size() % 50);
  if (!found) return;
  require(found->size() <= bytes.size());
  try {
    const ShapeFile whole = parse_shape(bytes, file.name());
    const ShapeView view = view_of(whole);
    require(*found == all_of(view.points));
  } catch (const Error&) {
    return;  // an error in the bytes after the points
  }
}

}  // namespace
}  // namespace rholm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::fuzzing::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
