#include "rholm/point_stream.h"

#include <sys/mman.h>
#include <unistd.h>

#include <optional>

#include "shape_fuzzing.h"

namespace rholm::fuzzing {
namespace {

// A file in memory that has a name.
class NamedBytes {
 public:
  explicit NamedBytes(std::span<const char> bytes) : file_(::memfd_create("fuzz", 0)) {
    require(file_ >= 0);
    require(::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  }
  ~NamedBytes() { ::close(file_); }
  NamedBytes(const NamedBytes&) = delete;
  NamedBytes& operator=(const NamedBytes&) = delete;
  std::string name() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

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

// Either an Error is thrown, or the points are those of the whole file, if that can be read.
void check(std::span<const char> bytes) {
  const NamedBytes file(bytes);
  const auto found = read_in_pieces(file.name(), 1 + bytes.size() % 50);
  if (!found) return;
  require(found->size() <= bytes.size());
  try {
    const ShapeFile whole = parse_shape(bytes, file.name());
    const ShapeView view = view_of(whole);
    require(std::equal(found->begin(), found->end(), view.points.begin(), view.points.end()));
  } catch (const Error&) {
    return;  // of what lies behind the points
  }
}

}  // namespace
}  // namespace rholm::fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rholm::fuzzing::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
