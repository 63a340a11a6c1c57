#include "shape/fingerprint.h"

#include <algorithm>
#include <cstddef>

namespace rholm {
namespace {

constexpr std::size_t kSome = 1024;  // chosen: a few pages of a large file for each list

// The hash FNV-1a.
class Hash {
 public:
  void add(const void* data, std::size_t n) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < n; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
  }
  // Adds up to kSome rows, evenly spread and including the last one.
  void add_some(const std::byte* first, std::size_t n, std::size_t stride, std::size_t size) {
    add(&n, sizeof n);
    const std::size_t some = std::min(n, kSome);
    for (std::size_t i = 1; i <= some; ++i) add(first + (i * n / some - 1) * stride, size);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint64_t fingerprint(const MeshView& mesh) {
  Hash hash;
  const std::size_t row = mesh.coordinate == ScalarType::kFloat32 ? 12 : 24;
  hash.add_some(mesh.vertices, mesh.n_vertices, mesh.vertex_stride, row);
  hash.add_some(mesh.faces, mesh.n_faces, mesh.face_stride, sizeof(Triangle));
  return hash.value();
}

}  // namespace rholm
