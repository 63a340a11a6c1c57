// Measures the constants of src/harmonic/nonuniform/cost_model.cpp on one thread. Prints a table of
// the constants in use, the measured ones, and their ratio. Only ratios of the constants matter: on
// a machine that is twice as fast all ratios are 0.5.
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "base/stopwatch.h"
#include "harmonic/legendre/direct_sums.h"
#include "harmonic/nonuniform/cost_model.h"
#include "harmonic/rings/ring_sums.h"
#include "mesh_sources.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"
#include "transform/error/error_points.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {
namespace {

const Context kOneThread{.threads = 1, .progress = {}};

// Returns the smallest processor time, in ns, of several runs that together take a tenth of a
// second.
double least_time(const std::function<void()>& run) {
  double least = std::numeric_limits<double>::infinity();
  const double until = cpu_seconds() + 0.1;
  for (int i = 0; i < 3 || cpu_seconds() < until; ++i) {
    const double start = cpu_seconds();
    run();
    least = std::min(least, cpu_seconds() - start);
  }
  return 1e9 * least;
}

void row(const std::string& what, double used, double measured) {
  std::printf("| %s | %.3g | %.3g | %.2f |\n", what.c_str(), used, measured, measured / used);
  std::fflush(stdout);
}

// Fits y = a u + b v by least squares of relative errors.
struct Fit {
  double uu = 0, uv = 0, vv = 0, uy = 0, vy = 0;
  void add(double u, double v, double y) {
    u /= y, v /= y;
    uu += u * u, uv += u * v, vv += v * v, uy += u, vy += v;
  }
  std::array<double, 2> solved() const {
    const double determinant = uu * vv - uv * uv;
    return {(uy * vv - vy * uv) / determinant, (uu * vy - uv * uy) / determinant};
  }
};

template <typename T>
double spread_time(int width, int derivatives) {
  const SphereFourier fourier = fourier_of<T>(width, kDegree, 1.5);
  const GridKernel<T> kernel = grid_kernel<T>(fourier);
  AlignedArray<double> grid(fourier.layout.cells());
  std::fill(grid.begin(), grid.end(), 0.0);
  auto batches = some_batches<T>();
  PolarSources polar;
  const double time = least_time([&] {
    for (SourceBatch<T>& batch : batches) {
      spread(kernel, batch, batch.kSize, derivatives, 0.0, grid.data(), polar);
    }
  });
  return time / static_cast<double>(batches.size() * SourceBatch<T>::kSize);
}

template <typename T>
void sources(const char* name) {
  constexpr bool kIsSingle = std::is_same_v<T, float>;
  for (const int derivatives : {0, 1, 2}) {
    for (const int width : {4, 6, 8, 9, 12, 16}) {
      row("source, " + std::string(name) + ", derivatives " + std::to_string(derivatives) +
              ", width " + std::to_string(width),
          source_cost(width, kIsSingle, derivatives), spread_time<T>(width, derivatives));
    }
  }
}

template <typename T>
double row_time(std::size_t n) {
  const ComplexFft<T> fft(n);
  AlignedArray<std::complex<T>> in(n), out(n);
  std::fill(in.begin(), in.end(), std::complex<T>(0.5));
  constexpr int kRows = 100;
  return least_time([&] {
           for (int i = 0; i < kRows; ++i) fft.forward(in.data(), out.data());
         }) /
         kRows;
}

void rows() {
  for (const std::size_t n : {256, 640, 1024, 800, 1600}) {
    row("row of " + std::to_string(n) + ", single", row_cost(n, true), row_time<float>(n));
    row("row of " + std::to_string(n) + ", double", row_cost(n, false), row_time<double>(n));
  }
}

double legendre_time(int degree, std::size_t n_rings) {
  std::vector<double> north;
  north.reserve(n_rings / 2);
  for (std::size_t q = 0; q < n_rings / 2; ++q) {
    north.push_back((static_cast<double>(q) + 0.5) * std::numbers::pi /
                    static_cast<double>(n_rings));
  }
  const HalfRings rings(north);
  const std::vector<double> values(rings.padded, 0.5);
  std::vector<double> c(static_cast<std::size_t>(degree) + 1), s(c);
  RingOrder order;
  return least_time([&] {
    const RingTables tables(degree);
    for (int m = 0; m <= degree; ++m) {
      set_ring_order(tables, m, order);
      ring_adjoint(order, rings, values.data(), values.data(), values.data(), values.data(),
                   c.data(), s.data());
    }
  });
}

constexpr std::array kDegrees = {64, 128, 256, 480, 1000};

void legendre() {
  for (const int degree : kDegrees) {
    const std::size_t n = fourier_of<double>(6, degree, 1.4).n_rings;
    row("Legendre sums, degree " + std::to_string(degree) + ", us", 1e-3 * legendre_cost(degree, n),
        1e-3 * legendre_time(degree, n));
  }
}

Coefficients some_coefficients(int degree) {
  Coefficients f(degree);
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) f.c(l, m) = 1.0 / (1 + l + m);
  }
  return f;
}

// Allocation of memory is part of the time of a grid.
double adjoint_time(const SphereFourier& stage, std::size_t n_grids) {
  Coefficients sum = some_coefficients(stage.degree);
  return least_time([&] {
    std::vector<AlignedArray<double>> grids;
    std::vector<double*> pointers;
    for (std::size_t i = 0; i < n_grids; ++i) {
      AlignedArray<double>& grid = grids.emplace_back(stage.layout.cells());
      std::fill(grid.begin(), grid.end(), 0.0);
      pointers.push_back(grid.data());
    }
    grid_to_coefficients(stage, pointers, sum, kOneThread, {});
  });
}

template <typename T>
double forward_time(const SphereFourier& stage) {
  const Coefficients f = some_coefficients(stage.degree);
  return least_time([&] {
    AlignedArray<T> grid(stage.layout.cells());
    coefficients_to_grid(stage, f, grid.data(), kOneThread, {});
  });
}

void grids() {
  for (const int degree : kDegrees) {
    const SphereFourier stage = fourier_of<double>(6, degree, 1.4);
    const std::string name = ", degree " + std::to_string(degree) + ", us";
    const double one = adjoint_time(stage, 1), cells = static_cast<double>(stage.layout.cells());
    row("grid, single" + name, 1e-3 * grid_cost(stage, true, 1), 1e-3 * forward_time<float>(stage));
    row("grid, double" + name, 1e-3 * grid_cost(stage, false, 1),
        1e-3 * forward_time<double>(stage));
    row("grid, adjoint" + name, 1e-3 * grid_cost(stage, false, 1), 1e-3 * one);
    row("cell of a second grid, degree " + std::to_string(degree),
        cell_cost(false, 2) - cell_cost(false, 1), (adjoint_time(stage, 2) - one) / cells);
  }
}

void direct() {
  constexpr std::size_t kSources = 64;
  const std::vector<Vec3>& all = directions_of(kMedium);
  const std::vector<Vec3> some(all.begin(), all.begin() + kSources);
  const std::vector<double> weights(kSources, 1.0);
  const std::vector<Vec3> gradients(kSources, {0.01, 0.02, 0.03});
  for (const int derivatives : {0, 1}) {
    Coefficients sum(kDegree);
    const ScatteredSources sources{
        some, weights, derivatives > 0 ? std::span(gradients) : std::span<const Vec3>(), {}};
    row("direct sums, 64 sources, derivatives " + std::to_string(derivatives) + ", us",
        1e-3 * direct_cost(kSources, kDegree, derivatives),
        1e-3 * least_time([&] { direct_add_adjoint(sources, sum, kOneThread); }));
  }
}

// Additional cost of a face, compared with a mesh whose faces are all lumped.
struct Faces {
  double beyond = 0, nodes = 0;  // nanoseconds; number
  bool all_lumped = false, none_lumped = false;
};
Faces faces_of(const Mesh& mesh, int degree, double precision, double plain) {
  MeshPassResult result;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    result = mesh_pass(view_of(mesh), {.degree = degree, .precision = precision}, kOneThread);
    least = std::min(least, result.times["faces"].cpu + result.times["spread"].cpu);
  }
  const double n = static_cast<double>(mesh.faces.size());
  return {.beyond = 1e9 * least / n - plain,
          .nodes = static_cast<double>(result.report.nodes) / n,
          .all_lumped = result.report.lumped_faces == mesh.faces.size(),
          .none_lumped = result.report.lumped_faces == 0};
}

void faces() {
  Fit hessians;
  double own = 0;
  int with_own = 0;
  const Mesh mesh = bumpy_sphere(6);
  const Faces plain = faces_of(mesh, 60, 1e-4, 0);
  for (const int degree : {60, 120, 250}) {
    for (const double precision : {1e-6, 1e-7, 1e-8, 1e-10}) {
      const Faces found = faces_of(mesh, degree, precision, plain.beyond);
      if (found.none_lumped) {
        std::printf("| - nodes of its own: %.1f of a face | | %.0f | |\n", found.nodes,
                    found.beyond);
        own += found.beyond / found.nodes;
        ++with_own;
      } else if (found.all_lumped && found.nodes > 0) {
        std::printf("| - nodes in common: %.2f of a face | | %.0f | |\n", found.nodes,
                    found.beyond);
        hessians.add(1, found.nodes, found.beyond);
      }
    }
  }
  const auto [fixed, node] = hessians.solved();
  row("second derivatives, per face", hessians_cost(), fixed);
  row("node in common", common_node_cost(), node);
  row("node of its own", own_node_cost(), own / with_own);
}

void error_points() {
  Fit fit;
  const Mesh mesh = bumpy_sphere(6);
  Expansion expansion;
  expansion.coefficients = some_coefficients(1000);
  for (const int degree : {50, 100, 200, 400}) {
    for (const std::size_t n : {20'000u, 200'000u}) {
      const ErrorPoints points =
          area_points(view_of(mesh), {}, scan_faces(view_of(mesh), Vec3{}, {}), n);
      const double time =
          least_time([&] { point_errors(points, expansion, degree, true, 1e-4, kOneThread); });
      fit.add(static_cast<double>(points.size()), static_cast<double>(degree * degree), time);
    }
  }
  const auto [point, grid] = fit.solved();
  row("point of error", error_point_cost(), point);
  row("grid of such points, per L^2", error_grid_cost(1), grid);
}

}  // namespace
}  // namespace rholm

int main() {
  std::printf("| nanoseconds | in use | measured | ratio |\n|---|---:|---:|---:|\n");
  rholm::sources<float>("single");
  rholm::sources<double>("double");
  rholm::rows();
  rholm::legendre();
  rholm::grids();
  rholm::direct();
  rholm::faces();
  rholm::error_points();
}
