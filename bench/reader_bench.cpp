// Throughput of the readers of shapes, compared with a plain copy of the same file, on one thread
// from the page cache. The counter bytes_per_second is the size of the file over the time.
//
// The copy is a lower bound for the time of a reader. It consists of read() into new memory, then
// memcpy to other new memory, because a reader must fill its own arrays, too.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "io/file/atomic_file.h"
#include "io/file/output_buffer.h"
#include "io/file/scalar_bytes.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

namespace fs = std::filesystem;

// A bumpy sphere as a grid of 1000 x 1200 vertices: 1.2 million vertices and twice as many
// triangles, which give files of 40 ... 350 MB.
constexpr std::uint32_t kRings = 1000;
constexpr std::uint32_t kColumns = 1200;

// If `step` > 0, coordinates are multiples of it: most text files have six decimals.
Mesh grid_sphere(double step) {
  Mesh mesh;
  const auto round = [step](double x) { return step > 0 ? std::round(x / step) * step : x; };
  for (std::uint32_t i = 0; i < kRings; ++i) {
    const double theta = std::numbers::pi * (i + 0.5) / kRings;
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const double phi = 2 * std::numbers::pi * k / kColumns;
      const double r = 1 + 0.1 * std::sin(5 * theta) * std::cos(7 * phi);
      mesh.vertices.push_back({round(r * std::sin(theta) * std::cos(phi)),
                               round(r * std::sin(theta) * std::sin(phi)),
                               round(r * std::cos(theta))});
    }
  }
  // Converts to text and back, so that 0.1234560000000001 becomes 0.123456.
  if (step > 0) {
    char digits[32];
    for (Vec3& v : mesh.vertices) {
      for (double* x : {&v.x, &v.y, &v.z}) {
        std::snprintf(digits, sizeof(digits), "%.6f", *x);
        *x = std::strtod(digits, nullptr);
      }
    }
  }
  for (std::uint32_t i = 0; i + 1 < kRings; ++i) {
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const std::uint32_t a = i * kColumns + k;
      const std::uint32_t b = i * kColumns + (k + 1) % kColumns;
      mesh.faces.push_back({a, a + kColumns, b});
      mesh.faces.push_back({b, a + kColumns, b + kColumns});
    }
  }
  return mesh;
}

template <class T>
void put(OutputBuffer& out, T value, bool big_endian) {
  char* to = out.room(sizeof(T));
  store_little_endian(to, value);
  if (big_endian) std::reverse(to, to + sizeof(T));
  out.advance(to + sizeof(T));
}

// Writes the layout of most files: float x y z, lists of three ints.
void write_float_ply(const Mesh& mesh, const fs::path& path, bool big_endian) {
  AtomicFile file(path);
  OutputBuffer out(&file);
  out.text(big_endian ? "ply\nformat binary_big_endian 1.0\n"
                      : "ply\nformat binary_little_endian 1.0\n");
  out.text("element vertex " + std::to_string(mesh.vertices.size()) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(mesh.faces.size()) +
           "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Vec3& v : mesh.vertices) {
    for (const double x : {v.x, v.y, v.z}) put(out, static_cast<float>(x), big_endian);
  }
  for (const Triangle& t : mesh.faces) {
    out.text("\3");
    for (const std::uint32_t corner : t) put(out, corner, big_endian);
  }
  out.flush();
  file.commit();
}

// The files of all benchmarks, removed at the end.
class Files {
 public:
  Files() : folder_(fs::temp_directory_path() / ("rholm-bench-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    const Mesh fine = grid_sphere(0);
    write_float_ply(fine, add("ply_float"), false);
    write_float_ply(fine, add("ply_float_big_endian"), true);
    const ShapeWriteOptions ply{.format = ShapeFormat::kPly};
    write_shape(fine, add("ply_double"), ply);
    write_shape(fine, add("ply_text_17_digits"), {.format = ShapeFormat::kPly, .ascii = true});
    write_shape(fine, add("stl_binary"), {.format = ShapeFormat::kStl});
    const Mesh coarse = grid_sphere(1e-6);
    write_shape(coarse, add("ply_text"), {.format = ShapeFormat::kPly, .ascii = true});
    write_shape(coarse, add("obj"), {.format = ShapeFormat::kObj});
    write_shape(coarse, add("off"), {.format = ShapeFormat::kOff});
    write_shape(coarse, add("stl_text"), {.format = ShapeFormat::kStl, .ascii = true});
    PointCloud points{.points = coarse.vertices, .normals = coarse.vertices, .attributes = {}};
    write_shape(points, add("xyz"), {.format = ShapeFormat::kXyz});
    const std::vector<double> red(coarse.vertices.size(), 17);
    Mesh with_attributes = coarse;
    for (const char* name : {"red", "green", "blue"}) {
      with_attributes.attributes.push_back({name, ScalarType::kUint8, red});
    }
    write_shape(with_attributes, add("ply_double_with_colours"), ply);
  }
  ~Files() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  fs::path path(const std::string& name) const { return folder_ / name; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  fs::path add(const std::string& name) {
    names_.push_back(name);
    return path(name);
  }
  fs::path folder_;
  std::vector<std::string> names_;
};

void copy_file(benchmark::State& state, const fs::path& path) {
  const std::size_t size = fs::file_size(path);
  for (auto _ : state) {
    char* first = static_cast<char*>(std::malloc(size));
    char* second = static_cast<char*>(std::malloc(size));
    const int file = ::open(path.c_str(), O_RDONLY);
    for (std::size_t done = 0; done < size;) {
      const ssize_t n = ::read(file, first + done, size - done);
      if (n <= 0) state.SkipWithError("cannot read the file");
      if (n <= 0) break;
      done += static_cast<std::size_t>(n);
    }
    ::close(file);
    std::memcpy(second, first, size);
    benchmark::DoNotOptimize(second[size / 2]);
    std::free(first);
    std::free(second);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(size) * state.iterations());
}

void read_file(benchmark::State& state, const fs::path& path) {
  for (auto _ : state) {
    ShapeFile file = read_shape(path, {}, {.threads = 1});
    benchmark::DoNotOptimize(file);
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(fs::file_size(path)) * state.iterations());
}

void register_all(const Files& files) {
  for (const std::string& name : files.names()) {
    const fs::path path = files.path(name);
    for (const bool copy : {true, false}) {
      auto* bench = benchmark::RegisterBenchmark(
          ((copy ? "copy/" : "read/") + name).c_str(),
          [path, copy](benchmark::State& state) { (copy ? copy_file : read_file)(state, path); });
      bench->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace
}  // namespace rholm

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const rholm::Files files;
  rholm::register_all(files);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
