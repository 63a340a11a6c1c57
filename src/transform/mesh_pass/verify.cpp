// The model of a plan takes errors of faces for random where nothing else is known. Needles about
// an axis, walls aligned with the grid, and unknown cases have larger errors, which no model
// predicts. A second reading measures them. The mesh is turned by a rotation that fits no shape,
// read with less error allowed, and turned back. The difference of both readings is the error of
// the first, to within the smaller error of the second. Rules, windows, quanta and rounding are all
// in it.
//
// If this error is above the precision, or far above the model's error, the second reading replaces
// the first. A third reading then replaces the second.
#include "transform/mesh_pass/verify.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "rholm/rotate.h"
#include "transform/mesh_pass/plan/error_budget.h"

namespace rholm {
namespace {

// Number of vertices that a thread turns at a time, some 50 us (chosen).
constexpr std::size_t kVertexGrain = 4096;
// Precision of a reading, relative to the reading before. Elements that both readings integrate by
// the same rule do not show in the difference. By the model their errors are below the second
// reading's limit. An error is missed only if the model is wrong by more than the inverse of this
// factor. Small meshes can afford a larger step (chosen).
constexpr double kFiner = 0.1, kFinerOfSmall = 0.03;
constexpr std::size_t kSmall = 10'000;  // faces (chosen)
constexpr double kLeastPrecision = 1e-14;
// Two readings may have a part of their errors in common. So this many times the measured error
// must be within the precision (chosen; bench/counterexamples looks for bodies on which that is too
// little).
constexpr double kMargin = 2;
// A difference of two readings is accepted if it is at most this many times the model's error of
// the first. It is also accepted if it is less than the difference before by this factor (chosen).
constexpr double kBelieved = 3;
// Where rounding is this large a part of the norm, degrees above 0 consist of rounding alone: they
// are zero by symmetry. Each reading differs from zero by the rounding, both differ by twice that,
// which counts kMargin-fold; the same again is uncertainty (chosen: 8 for 6).
constexpr double kMostlyRounding = 0.1, kOfTwoReadings = 8;
constexpr int kMostReadings = 4;  // chosen: the last is 10 000 times finer than wanted

// Rounding coordinates once more turns the planes of needles, by more than this on prisms of 200
// sides as wide as a hundredth of their length. Below, axes change places, which is exact.
constexpr double kLeastTurned = 1e-12;
constexpr Rotation kAxesOnward = {.w = 0.5, .x = 0.5, .y = 0.5, .z = 0.5};

// Returns a random rotation, uniform over all rotations (Shoemake 1992), another one for each
// reading.
Rotation rotation_of_reading(int reading, double precision) {
  if (precision < kLeastTurned) return reading % 2 == 1 ? kAxesOnward : inverse(kAxesOnward);
  const auto random = [&](int k) { return random_uniform(0x726f74, 3 * reading + k); };
  const double half = std::sqrt(random(0)), other = std::sqrt(1 - random(0));
  const double a = 2 * std::numbers::pi * random(1), b = 2 * std::numbers::pi * random(2);
  return {.w = other * std::sin(a),
          .x = other * std::cos(a),
          .y = half * std::sin(b),
          .z = half * std::cos(b)};
}

MeshPassResult turned_reading(const MeshView& mesh, const MeshPassOptions& options,
                              double precision, int reading, const Context& context) {
  const Rotation rotation = rotation_of_reading(reading, precision);
  const RotationMatrix rows = matrix_of(rotation);
  std::vector<Vec3> vertices(mesh.n_vertices);
  parallel_for(vertices.size(), kVertexGrain, {.threads = context.threads}, {},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const Vec3 x = mesh.vertex(i) - options.center;
                   vertices[i] = {dot(rows[0], x), dot(rows[1], x), dot(rows[2], x)};
                 }
               });
  MeshView turned = mesh;
  turned.vertices = reinterpret_cast<const std::byte*>(vertices.data());
  turned.vertex_stride = sizeof(Vec3);
  turned.coordinate = ScalarType::kFloat64;
  MeshPassOptions wanted{.degree = options.degree, .precision = precision, .parts = options.parts};
  MeshPassResult result = mesh_pass(turned, wanted, context);
  result.coefficients = rotate(result.coefficients, inverse(rotation), context);
  return result;
}

Coefficients difference(const Coefficients& a, const Coefficients& b) {
  Coefficients d = a;
  for (std::size_t i = 0; i < d.values().size(); ++i) d.values()[i] -= b.values()[i];
  return d;
}

// Sets the measured error of a reading by a finer one. Returns its ratio to the model's error.
double measure(const MeshPassResult& finer, double precision, MeshPassResult& result) {
  const Coefficients error = difference(result.coefficients, finer.coefficients);
  const int degree = result.coefficients.degree();
  const auto relative = [&](int first) {
    const double norm = norm_of_degrees(result.coefficients, first, degree);
    return norm > 0 ? norm_of_degrees(error, first, degree) / norm : 0.0;
  };
  FastReport& report = result.report;
  const double modelled = std::max(report.error, result.least_error);
  report.measured_share = 1;
  report.error = relative(1);
  // Where faces are small against the waves, both readings lump the same faces, with the same error
  // in the highest degrees. So the finer reading's error in the band is added.
  report.band_error = std::hypot(relative(3 * degree / 4 + 1), finer.report.band_error);
  // The model of the finer reading may be wrong by the same factor as the coarser one's.
  const double wrong = modelled > 0 ? report.error / modelled : 1.0;
  report.error_uncertainty = finer.report.error * std::max(1.0, wrong);
  const double mean = std::abs(result.coefficients.c(0, 0));
  const double least =
      result.least_error * (result.least_error > kMostlyRounding ? kOfTwoReadings : 1.0);
  report.reached =
      kMargin * report.error + report.error_uncertainty <= std::max(precision, least) &&
      std::abs(error.c(0, 0)) <= std::max(precision, kLumpRounding) * mean;
  return wrong;
}

void read_again(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                MeshPassResult& result) {
  const Context silent{.threads = context.threads};
  const double finer_by = mesh.n_faces <= kSmall ? kFinerOfSmall : kFiner;
  double precision = options.precision, before = 0;
  for (int reading = 1;; ++reading) {
    ask_cancel();
    precision = std::max(kLeastPrecision, finer_by * precision);
    MeshPassResult finer = turned_reading(mesh, options, precision, reading, silent);
    const double wrong = measure(finer, options.precision, result);
    // Rules that fail on a mesh may fail alike in both readings, which then differ by less than
    // their errors.
    if (wrong > kBelieved && !(result.report.error < before / kBelieved)) {
      result.report.reached = false;
    }
    if (result.report.reached || reading == kMostReadings) return;
    before = result.report.error;
    finer.report.passes += result.report.passes;
    result.coefficients = std::move(finer.coefficients);
    result.report = finer.report;
    result.least_error = finer.least_error;
  }
}

}  // namespace

void verify_pass(const MeshView& mesh, const MeshPassOptions& options, const Context& context,
                 MeshPassResult& result) {
  if (mesh.n_faces > kMostVerified || options.degree == 0) return;
  StageTimes times = std::move(result.times);
  timed(times, "verify", [&] { read_again(mesh, options, context, result); });
  result.times = std::move(times);
}

}  // namespace rholm
