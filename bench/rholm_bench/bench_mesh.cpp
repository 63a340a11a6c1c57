#include "rholm_bench/bench_mesh.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "cli/terminal/interrupt.h"
#include "rholm/error.h"
#include "rholm/primitives.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kFlush = std::size_t{1} << 20;  // chosen: makes system calls cheap

// Returns 1 and four waves of 0.05 each, with wave numbers that the coarsest meshes resolve.
double smooth_radius(const Vec3& u) {
  return 1 + 0.05 * (std::sin(3 * u.x + 1 * u.y + 1) + std::cos(4 * u.y - 2 * u.z) +
                     std::sin(5 * u.z + 3 * u.x + 2) + std::cos(6 * u.x - 2 * u.y + 1));
}

[[noreturn]] void fail(const std::filesystem::path& folder) {
  throw Error(ErrorCode::kIo,
              fmt::format("no temporary file can be written in {}: {}; TMPDIR names another folder",
                          folder.string(), std::strerror(errno)));
}

template <typename T>
void append(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

bool is_float(const Vec3& x) {
  const auto fits = [](double value) { return static_cast<float>(value) == value; };
  return fits(x.x) && fits(x.y) && fits(x.z);
}

std::string header(const Mesh& mesh, const char* type) {
  const char* order = std::endian::native == std::endian::little ? "little" : "big";
  return fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\n"
      "property {} z\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      order, mesh.vertices.size(), type, type, type, mesh.faces.size());
}

}  // namespace

Mesh smooth_mesh(int triangles) {
  const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 12.0))));
  Mesh mesh = box({2, 2, 2}, n);
  for (Vec3& x : mesh.vertices) {
    // Squares have about the same solid angle.
    const auto at = [](double t) { return std::tan(std::numbers::pi / 4 * t); };
    const Vec3 u = normalized({at(x.x), at(x.y), at(x.z)});
    const Vec3 at_u = smooth_radius(u) * u;
    // Coordinates are rounded as in the file.
    x = {static_cast<float>(at_u.x), static_cast<float>(at_u.y), static_cast<float>(at_u.z)};
  }
  return mesh;
}

void shuffle(Mesh& mesh) {
  std::mt19937_64 random(1);
  for (std::size_t i = mesh.faces.size(); i > 1; --i) {
    std::swap(mesh.faces[i - 1], mesh.faces[random() % i]);
  }
}

TemporaryMesh::TemporaryMesh(const std::filesystem::path& folder) : folder_(folder) {
  std::string name = (folder / "rholm-bench-XXXXXX").string();
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ < 0) fail(folder);
  ::unlink(name.c_str());
}

TemporaryMesh::TemporaryMesh(const Mesh& mesh, const std::filesystem::path& folder)
    : TemporaryMesh(folder) {
  const bool narrow = std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_float);
  std::string bytes = header(mesh, narrow ? "float" : "double");
  const auto flush = [&](std::size_t limit) {
    if (bytes.size() < limit) return;
    stop_if_interrupted();
    write(bytes);
    bytes.clear();
  };
  for (const Vec3& x : mesh.vertices) {
    for (const double value : {x.x, x.y, x.z}) {
      narrow ? append(bytes, static_cast<float>(value)) : append(bytes, value);
    }
    flush(kFlush);
  }
  for (const Triangle& t : mesh.faces) {
    append(bytes, std::uint8_t{3});
    for (const std::uint32_t index : t) append(bytes, index);
    flush(kFlush);
  }
  flush(1);
}

TemporaryMesh::~TemporaryMesh() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::filesystem::path TemporaryMesh::path() const {
  return fmt::format("/proc/self/fd/{}", descriptor_);
}

void TemporaryMesh::write(const std::string& bytes) const {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(descriptor_, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno != EINTR) fail(folder_);
    if (n > 0) at += static_cast<std::size_t>(n);
  }
}

}  // namespace rholm::cli
