// The centre of the kernel on one thread: ns per triangle of a mesh in the layout of a binary PLY
// file (float coordinates, 13 bytes per face). For comparison: the time of one pass, and of a plain
// copy of the same bytes.
#include <benchmark/benchmark.h>

#include <cstring>
#include <memory>
#include <vector>

#include "chart/center/kernel.h"
#include "chart/center/slope_scan.h"
#include "chart/center/view_scan.h"
#include "rholm/primitives.h"
#include "shape/measure.h"

namespace rholm {
namespace {

const Context kOneThread{.threads = 1, .progress = {}};

// A mesh that owns float vertices and faces of 13 bytes.
struct PackedMesh {
  std::vector<std::byte> vertices, faces;
  MeshView view;
};

PackedMesh packed(const Mesh& mesh) {
  constexpr std::size_t kVertex = 12, kFace = 13;
  PackedMesh result;
  result.vertices.resize(kVertex * mesh.vertices.size());
  result.faces.resize(kFace * mesh.faces.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    const float row[3] = {static_cast<float>(v.x), static_cast<float>(v.y),
                          static_cast<float>(v.z)};
    std::memcpy(&result.vertices[kVertex * i], row, kVertex);
  }
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    result.faces[kFace * t] = std::byte{3};
    std::memcpy(&result.faces[kFace * t + 1], mesh.faces[t].data(), 12);
  }
  result.view = {.vertices = result.vertices.data(),
                 .n_vertices = mesh.vertices.size(),
                 .vertex_stride = kVertex,
                 .coordinate = ScalarType::kFloat32,
                 .faces = result.faces.data() + 1,
                 .n_faces = mesh.faces.size(),
                 .face_stride = kFace};
  return result;
}

// Returns 20 * 4^subdivisions triangles, made once for all benchmarks of a size.
const PackedMesh& bumpy(std::int64_t subdivisions) {
  static std::int64_t size = -1;
  static std::unique_ptr<const PackedMesh> mesh;
  if (size != subdivisions) {
    mesh = nullptr;
    mesh = std::make_unique<PackedMesh>(packed(bumpy_sphere(static_cast<int>(subdivisions), 0.3)));
    size = subdivisions;
  }
  return *mesh;
}

// Reports seconds per triangle, printed with a unit: "8.1n".
void report_per_triangle(benchmark::State& state, std::size_t triangles) {
  state.counters["per_triangle"] = benchmark::Counter(
      static_cast<double>(triangles),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void copy(benchmark::State& state) {
  const PackedMesh& mesh = bumpy(state.range(0));
  std::vector<std::byte> vertices = mesh.vertices, triangles = mesh.faces;
  for (auto _ : state) {
    std::memcpy(vertices.data(), mesh.vertices.data(), vertices.size());
    std::memcpy(triangles.data(), mesh.faces.data(), triangles.size());
    benchmark::DoNotOptimize(triangles[triangles.size() / 2]);
  }
  report_per_triangle(state, mesh.view.n_faces);
}

void frame(benchmark::State& state) {
  const MeshView& mesh = bumpy(state.range(0)).view;
  for (auto _ : state) benchmark::DoNotOptimize(local_view(mesh, kOneThread));
  report_per_triangle(state, mesh.n_faces);
}

// Measures a pass that finds nothing.
void pass(benchmark::State& state) {
  const LocalView view = local_view(bumpy(state.range(0)).view, kOneThread);
  for (auto _ : state) {
    ScanLimits limits{.distance = 0};
    scan_below(view, 0, view.mesh.n_faces, {}, limits, [](std::size_t) {});
  }
  report_per_triangle(state, view.mesh.n_faces);
}

// Measures the whole search, from bytes to the point.
void center(benchmark::State& state) {
  const MeshView& mesh = bumpy(state.range(0)).view;
  KernelCenter found;
  for (auto _ : state) {
    found = chebyshev_center(local_view(mesh, kOneThread), kOneThread);
    benchmark::DoNotOptimize(found);
  }
  report_per_triangle(state, mesh.n_faces);
  state.counters["scans"] = found.scans;
}

// Measures the search for the slope centre after the kernel is known.
void slope(benchmark::State& state) {
  const LocalView view = local_view(bumpy(state.range(0)).view, kOneThread);
  const KernelCenter kernel = chebyshev_center(view, kOneThread);
  for (auto _ : state) {
    const Vec3 centroid = volume_centroid(view.mesh, view.frame, kOneThread);
    benchmark::DoNotOptimize(least_slope(view, kernel, view.frame.to_local(centroid), kOneThread));
  }
  report_per_triangle(state, view.mesh.n_faces);
}

// Measures one pass for the derivative at one or four places.
template <std::size_t kPlaces>
void slope_pass(benchmark::State& state) {
  const LocalView view = local_view(bumpy(state.range(0)).view, kOneThread);
  const SlopeLine line = {.middle = {}, .way = {0.1, 0, 0}, .least = 0.1};
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sum_rises(view, 0, view.mesh.n_faces, line, {0, 0.3, 0.6, 1}, kPlaces, [](std::size_t) {}));
  }
  report_per_triangle(state, view.mesh.n_faces);
}

// Measures the centroid of the solid.
void centroid(benchmark::State& state) {
  const LocalView view = local_view(bumpy(state.range(0)).view, kOneThread);
  for (auto _ : state) {
    benchmark::DoNotOptimize(volume_centroid(view.mesh, view.frame, kOneThread));
  }
  report_per_triangle(state, view.mesh.n_faces);
}

#define RHOLM_SIZES ->Arg(5)->Arg(6)->Arg(8)->Arg(9)->Unit(benchmark::kMillisecond)
BENCHMARK(copy) RHOLM_SIZES;
BENCHMARK(frame) RHOLM_SIZES;
BENCHMARK(pass) RHOLM_SIZES;
BENCHMARK(center) RHOLM_SIZES;
BENCHMARK(slope) RHOLM_SIZES->Arg(7);
BENCHMARK(slope_pass<1>) RHOLM_SIZES->Arg(7);
BENCHMARK(slope_pass<kMostPlaces>) RHOLM_SIZES->Arg(7);
BENCHMARK(centroid) RHOLM_SIZES->Arg(7);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
