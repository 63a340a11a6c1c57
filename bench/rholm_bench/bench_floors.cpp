// Lower bounds of the stages: copies, row updates, Legendre sums.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/aligned_array.h"
#include "harmonic/nonuniform/sphere_fourier.h"
#include "harmonic/rings/ring_sums.h"
#include "rholm/error.h"
#include "rholm_bench/bench.h"
#include "rholm_bench/bench_rows.h"
#include "rholm_bench/bench_timing.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

class Descriptor {
 public:
  explicit Descriptor(const std::filesystem::path& path)
      : path_(path), number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (number_ < 0) fail();
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  // Reads the whole file, block by block.
  void read_all(std::span<char> buffer) const {
    off_t at = 0;
    for (ssize_t n = 1; n != 0; at += n) {
      n = ::pread(number_, buffer.data(), buffer.size(), at);
      if (n < 0) fail();
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(ErrorCode::kIo, path_.string() + " cannot be read: " + std::strerror(errno));
  }
  std::filesystem::path path_;
  int number_;
};

Timing time_file_read(const std::filesystem::path& path, int repeat, const Context& context) {
  const Descriptor file(path);
  AlignedArray<char> buffer(std::size_t{1} << 18);  // chosen: stays in the second-level cache
  const auto read = [&] { file.read_all({buffer.data(), buffer.size()}); };
  read();
  return time_repeated(repeat, context, read);
}

Timing time_copy(std::size_t bytes, int repeat, const Context& context) {
  AlignedArray<char> from(bytes), to(bytes);
  std::memset(from.data(), 1, bytes);
  std::memset(to.data(), 2, bytes);
  return time_repeated(repeat, context, [&] { std::memcpy(to.data(), from.data(), bytes); });
}

// Returns the first cell of every vertex's window.
std::vector<std::uint32_t> first_cells(const GridLayout& layout, const Mesh& mesh,
                                       const Vec3& center) {
  std::vector<std::uint32_t> cells;
  cells.reserve(mesh.vertices.size());
  for (const Vec3& vertex : mesh.vertices) {
    const Vec3 x = vertex - center;
    const double theta = std::atan2(std::hypot(x.x, x.y), x.z), phi = std::atan2(x.y, x.x) + kPi;
    const auto index = [](double angle, std::size_t n) {
      return static_cast<std::size_t>(angle / (2 * kPi) * static_cast<double>(n));
    };
    const std::size_t row = std::min(index(theta, layout.n_theta), layout.n_theta / 2);
    const std::size_t column = std::min(index(phi, layout.n_phi), layout.n_phi - 1);
    cells.push_back(static_cast<std::uint32_t>(row * layout.stride + column));
  }
  return cells;
}

Timing time_rows(const GridLayout& layout, const Mesh& mesh, const Vec3& center, int repeat,
                 const Context& context) {
  const std::vector<std::uint32_t> cells = first_cells(layout, mesh, center);
  AlignedArray<double> grid(layout.cells()), taps(3 * 16);
  std::fill(grid.begin(), grid.end(), 0.0);
  std::fill(taps.begin(), taps.end(), 0.001);
  const auto update = [&] { update_rows(layout, cells, taps.data(), grid.data()); };
  update();
  return time_repeated(repeat, context, update);
}

Timing time_legendre(const SphereFourier& fourier, int repeat, const Context& context) {
  const int degree = fourier.degree;
  std::vector<double> colatitudes;
  for (std::size_t q = 0; 2 * q < fourier.n_rings; ++q) {
    colatitudes.push_back((static_cast<double>(q) + 0.5) * kPi /
                          static_cast<double>(fourier.n_rings));
  }
  const HalfRings rings(colatitudes);
  const RingTables tables(degree);
  AlignedArray<double> rows(4 * rings.padded), sums(2 * (degree + std::size_t{1}));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i % rings.padded < rings.size ? 0.5 : 0;
  std::fill(sums.begin(), sums.end(), 0.0);
  RingOrder order;
  return time_repeated(repeat, context, [&] {
    for (int m = 0; m <= degree; ++m) {
      set_ring_order(tables, m, order);
      const auto part = [&](std::size_t i) { return rows.data() + i * rings.padded; };
      ring_adjoint(order, rings, part(0), part(1), part(2), part(3), sums.data(),
                   sums.data() + degree + 1);
    }
  });
}

// Returns the transform on the grid that `fast` reports.
SphereFourier fourier_of(const FastReport& fast, int degree) {
  const double points = fast.oversampling * 2 * std::max(degree, 1);
  const auto n = static_cast<std::size_t>(std::lround(points));
  return sphere_fourier(degree, grid_layout(fast.width, n, n));
}

}  // namespace

FloorsBench bench_floors(const std::filesystem::path& path, const Mesh& mesh,
                         const Expansion& expansion, const FastReport& fast,
                         const BenchOptions& options, const Context& context) {
  check(options);
  const SphereFourier fourier = fourier_of(fast, expansion.coefficients.degree());
  const GridLayout& layout = fourier.layout;
  FloorsBench floors;
  floors.grid_bytes = layout.cells() * sizeof(double);
  floors.file_read = time_file_read(path, options.repeat, context);
  floors.copy = time_copy(std::filesystem::file_size(path), options.repeat, context);
  floors.row_updates = time_rows(layout, mesh, expansion.center, options.repeat, context);
  floors.legendre = time_legendre(fourier, options.repeat, context);
  return floors;
}

std::string vector_instructions() { return vector_target(); }

}  // namespace rholm
