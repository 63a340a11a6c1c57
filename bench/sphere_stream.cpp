// Writes a displaced sphere of any number of triangles as binary PLY to standard output, ring by
// ring: for meshes larger than memory.
//
//   build/release/bench/sphere_stream 11180 | rholm analyze - --degree 480 -o large.h5
//
// The mesh is an octahedron with each edge cut into n: 8 n^2 triangles, 4 n^2 + 2 vertices, in
// rings from the north pole. The radius is 1 + a sum of waves whose lengths go down to 1/30.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

class Output {
 public:
  explicit Output(std::size_t room) { bytes_.reserve(room + 64); }
  template <typename T>
  void add(const T& value) {
    const auto* from = reinterpret_cast<const char*>(&value);
    bytes_.insert(bytes_.end(), from, from + sizeof value);
    if (bytes_.size() >= kChunk) flush();
  }
  void flush() {
    if (std::fwrite(bytes_.data(), 1, bytes_.size(), stdout) != bytes_.size()) {
      std::perror("sphere_stream");
      std::exit(1);
    }
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::vector<char> bytes_;
};

struct Wave {
  double x, y, z, phase, height;
};

// Directions of waves follow the golden angle.
std::array<Wave, 8> waves() {
  std::array<Wave, 8> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double z = (2 * static_cast<double>(i) + 1) / 8 - 1, ring = std::sqrt(1 - z * z);
    const double angle = 2.399963 * static_cast<double>(i);
    const double length = 3 * std::pow(1.9, static_cast<double>(i));
    all[i] = {length * ring * std::cos(angle), length * ring * std::sin(angle), length * z,
              static_cast<double>(i), 0.3 / length};
  }
  return all;
}

void put_vertex(double x, double y, double z, Output& out) {
  static const std::array<Wave, 8> all = waves();
  const double over = 1 / std::sqrt(x * x + y * y + z * z);
  x *= over, y *= over, z *= over;
  double r = 1;
  for (const Wave& w : all) r += w.height * std::sin(w.x * x + w.y * y + w.z * z + w.phase);
  out.add(static_cast<float>(r * x));
  out.add(static_cast<float>(r * y));
  out.add(static_cast<float>(r * z));
}

// Rings k = 0 ... 2n; each quarter of ring k has `size` edges.
struct Rings {
  std::uint32_t n;
  std::uint32_t size(std::uint32_t k) const { return k <= n ? k : 2 * n - k; }
  std::uint64_t first(std::uint32_t k) const {
    if (k == 0) return 0;
    const std::uint64_t all = 4 * std::uint64_t{n} * n + 2;
    const std::uint64_t m = size(k);
    return k <= n ? 1 + 2 * m * (m - 1) : all - 1 - 2 * m * (m + 1);
  }
  // Returns the vertex at the beginning of edge i of quarter q.
  std::uint32_t vertex(std::uint32_t k, std::uint32_t q, std::uint32_t i) const {
    const std::uint64_t m = size(k);
    return static_cast<std::uint32_t>(first(k) + (m == 0 ? 0 : (q * m + i) % (4 * m)));
  }
};

void put_vertices(const Rings& rings, Output& out) {
  const double n = rings.n;
  for (std::uint32_t k = 0; k <= 2 * rings.n; ++k) {
    const double m = rings.size(k), z = n - k;
    if (m == 0) put_vertex(0, 0, z, out);
    for (int q = 0; q < 4 && m > 0; ++q) {
      for (double i = 0; i < m; ++i) {
        const double x = m - i, y = i;
        const double turned[4][2] = {{x, y}, {-y, x}, {-x, -y}, {y, -x}};
        put_vertex(turned[q][0], turned[q][1], z, out);
      }
    }
  }
}

void put_face(std::uint32_t a, std::uint32_t b, std::uint32_t c, Output& out) {
  out.add(std::uint8_t{3});
  out.add(a);
  out.add(b);
  out.add(c);
}

void put_faces(const Rings& rings, Output& out) {
  for (std::uint32_t k = 0; k < 2 * rings.n; ++k) {
    const bool widens = k < rings.n;
    const std::uint32_t wide = widens ? k + 1 : k, narrow = widens ? k : k + 1;
    const std::uint32_t m = rings.size(wide);
    for (std::uint32_t q = 0; q < 4; ++q) {
      for (std::uint32_t i = 0; i < m; ++i) {
        const std::uint32_t a = rings.vertex(wide, q, i), b = rings.vertex(wide, q, i + 1);
        const std::uint32_t c = rings.vertex(narrow, q, i);
        widens ? put_face(a, b, c, out) : put_face(b, a, c, out);
        if (i + 1 == m) continue;
        const std::uint32_t d = rings.vertex(narrow, q, i + 1);
        widens ? put_face(b, d, c, out) : put_face(b, c, d, out);
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  char* end = nullptr;
  const long n = argc == 2 ? std::strtol(argv[1], &end, 10) : 0;
  if (n < 1 || *end != 0 || n > 23000) {  // vertices are numbered by 32 bits
    std::fputs("usage: sphere_stream N > FILE.ply, with 8 N^2 triangles, N up to 23000\n", stderr);
    return 2;
  }
  const Rings rings{static_cast<std::uint32_t>(n)};
  std::printf(
      "ply\nformat binary_little_endian 1.0\nelement vertex %ld\nproperty float x\n"
      "property float y\nproperty float z\nelement face %ld\n"
      "property list uchar uint vertex_indices\nend_header\n",
      4 * n * n + 2, 8 * n * n);
  Output out(std::size_t{1} << 20);
  put_vertices(rings, out);
  put_faces(rings, out);
  out.flush();
  return 0;
}
