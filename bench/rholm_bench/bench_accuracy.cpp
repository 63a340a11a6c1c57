// Errors of coefficients, measured with more precise ones.
#include <algorithm>
#include <cmath>

#include "harmonic/nonuniform/cost_model.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm_bench/bench.h"
#include "rholm_bench/bench_timing.h"

namespace rholm {
namespace {

// Rounding of directions and sums allows hardly smaller errors.
constexpr double kFastReference = 1e-12, kLeastPrecision = 1e-14;
constexpr double kDirectReference = 1e-13;

// Largest cost of direct sums, in nanoseconds by the cost model: some 4 s.
constexpr double kMostDirect = 3.5e9;
// Nodes per triangle, with its share of edges, for a precision of 1e-13 on a mesh that resolves its
// degrees.
constexpr double kNodesPerTriangle = 12;

struct Energy {
  double whole = 0, top = 0;
  void add(int l, int degree, double value) {
    whole += value * value;
    if (4 * l > 3 * degree) top += value * value;
  }
};

double ratio(double error2, double norm2) { return norm2 > 0 ? std::sqrt(error2 / norm2) : 0; }

}  // namespace

CoefficientsError compare_coefficients(const Coefficients& found, const Coefficients& reference) {
  const int degree = reference.degree();
  if (found.degree() != degree) {
    throw Error(ErrorCode::kInvalidInput,
                "coefficients to degree " + std::to_string(found.degree()) +
                    " cannot be compared with such to degree " + std::to_string(degree));
  }
  Energy error, norm;
  for (int l = 1; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      error.add(l, degree, found.c(l, m) - reference.c(l, m));
      error.add(l, degree, found.s(l, m) - reference.s(l, m));
      norm.add(l, degree, reference.c(l, m));
      norm.add(l, degree, reference.s(l, m));
    }
  }
  const double mean = reference.c(0, 0);
  return {.error = ratio(error.whole, norm.whole),
          .top_error = ratio(error.top, norm.top),
          .mean = mean != 0 ? std::abs(found.c(0, 0) / mean - 1) : 0};
}

Reference bench_reference(const std::filesystem::path& path, const Vec3& center,
                          const BenchOptions& options, const Context& context) {
  check(options);
  // Mapping counts triangles where it matters, in large files; small files may be read twice.
  const auto mapped = map_mesh(path, context);
  const double triangles =
      mapped ? static_cast<double>(mapped->view().n_faces)
             : static_cast<double>(std::filesystem::file_size(path)) / 13;  // the least per face
  Reference reference;
  const auto nodes = static_cast<std::size_t>(kNodesPerTriangle * triangles);
  const bool direct = direct_cost(nodes, options.degree, 0) <= kMostDirect;
  reference.engine = direct ? Engine::kDirect : Engine::kFast;
  reference.precision =
      direct ? kDirectReference
             : std::max(kLeastPrecision, std::min(kFastReference, options.precision / 10));
  ExpandOptions wanted;
  wanted.degree = options.degree;
  wanted.engine = reference.engine;
  wanted.precision = reference.precision;
  wanted.chart.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0};
  wanted.chart.allow_signed = options.allow_signed;
  wanted.errors = false;
  reference.coefficients = expand_file(path, wanted, context).transform.expansion.coefficients;
  return reference;
}

CoefficientsError bench_reference_error(const Context& context) {
  const Mesh mesh = bumpy_sphere(4);
  const auto coefficients = [&](Engine engine, double precision) {
    ExpandOptions wanted;
    wanted.degree = 64;
    wanted.engine = engine;
    wanted.precision = precision;
    wanted.chart.center.kind = CenterKind::kNone;
    wanted.errors = false;
    return expand(mesh, wanted, context).transform.expansion.coefficients;
  };
  return compare_coefficients(coefficients(Engine::kFast, kFastReference),
                              coefficients(Engine::kDirect, kDirectReference));
}

}  // namespace rholm
