// Exact norms and error measures on one thread: ns per triangle of a mesh in the layout of a binary
// PLY file (float coordinates, 13 bytes per face). For comparison: the time of one pass over the
// triangles, and of the closed form for one triangle at a time.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "chart/center/view_scan.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"
#include "transform/norms/exact_norms.h"

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
const MeshView& bumpy(std::int64_t subdivisions) {
  static std::int64_t size = -1;
  static std::unique_ptr<const PackedMesh> mesh;
  if (size != subdivisions) {
    mesh = nullptr;
    mesh = std::make_unique<PackedMesh>(packed(bumpy_sphere(static_cast<int>(subdivisions), 0.3)));
    size = subdivisions;
  }
  return mesh->view;
}

// Reports seconds per triangle, printed with a unit: "8.1n".
template <typename Run>
void per_triangle(benchmark::State& state, const Run& run) {
  const MeshView& mesh = bumpy(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(run(mesh));
  state.counters["per_triangle"] = benchmark::Counter(
      static_cast<double>(mesh.n_faces),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void scan(benchmark::State& state) {
  const LocalView view = local_view(bumpy(state.range(0)), kOneThread);
  per_triangle(state, [&](const MeshView& mesh) {
    ScanLimits limits{.distance = 0};
    scan_below(view, 0, mesh.n_faces, {}, limits, [](std::size_t) {});
    return limits.distance;
  });
}

void norms(benchmark::State& state) {
  per_triangle(state, [](const MeshView& mesh) { return exact_norms(mesh, {}, kOneThread); });
}

// Evaluates d_T Phi_T by (M7), one triangle at a time.
double closed_form(const std::array<Vec3, 3>& p) {
  const Vec3 twice_area = cross(p[1] - p[0], p[2] - p[0]), n = normalized(twice_area);
  const double d = dot(n, p[0]), r[3] = {norm(p[0]), norm(p[1]), norm(p[2])};
  double potential =
      -2 * d *
      std::atan2(dot(twice_area, p[0]), r[0] * r[1] * r[2] + dot(p[0], p[1]) * r[2] +
                                            dot(p[1], p[2]) * r[0] + dot(p[2], p[0]) * r[1]);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec3 e = p[j] - p[i];
    const double length = norm(e), ends = r[i] + r[j];
    potential += dot(n, cross(p[i], e)) / length * std::log1p(2 * length / (ends - length));
  }
  return d * potential;
}

void norms_one_by_one(benchmark::State& state) {
  per_triangle(state, [](const MeshView& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.n_faces; ++t) {
      const Triangle v = mesh.triangle(t);
      sum += closed_form({mesh.vertex(v[0]), mesh.vertex(v[1]), mesh.vertex(v[2])});
    }
    return sum;
  });
}

void tail(benchmark::State& state) {
  per_triangle(state, [](const MeshView& mesh) { return tail_strength(mesh, {}); });
}

void vertices(benchmark::State& state) {
  per_triangle(state, [](const MeshView& mesh) { return vertex_error_strengths(mesh, {}); });
}

#define RHOLM_SIZES ->Arg(4)->Arg(5)->Arg(6)->Arg(8)->Arg(9)->Unit(benchmark::kMillisecond)
BENCHMARK(scan) RHOLM_SIZES;
BENCHMARK(norms) RHOLM_SIZES;
BENCHMARK(norms_one_by_one)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(tail)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);
BENCHMARK(vertices)->Arg(4)->Arg(6)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
