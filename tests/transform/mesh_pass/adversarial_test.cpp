// The mesh pass on difficult meshes. The true error is within the requested precision, and the
// reported error is at least half of it, over all degrees and over the degrees above 3L/4. The
// reference is direct sums with their own quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/adversarial_meshes.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/verify.h"

namespace rholm {
namespace {

Coefficients by_direct_sums(const test::AdversarialMesh& made) {
  const StarChart chart{.mesh = made.mesh, .edges = pair_edges(made.mesh), .report = {}};
  TransformOptions options;
  options.degree = made.degree;
  options.engine = Engine::kDirect;
  options.precision = 1e-4 * made.precision;
  return expand(chart, options, {}).expansion.coefficients;
}

void judge(const test::AdversarialMesh& made) {
  const MeshPassOptions options{.degree = made.degree, .precision = made.precision};
  MeshPassResult found = mesh_pass(view_of(made.mesh), options, {});
  verify_pass(view_of(made.mesh), options, {}, found);
  const Coefficients expected = by_direct_sums(made);
  Coefficients difference = found.coefficients;
  for (std::size_t i = 0; i < difference.values().size(); ++i) {
    difference.values()[i] -= expected.values()[i];
  }
  const auto relative = [&](int first) {
    return norm_of_degrees(difference, first, made.degree) /
           norm_of_degrees(expected, first, made.degree);
  };
  const double error = relative(1), band_error = relative(3 * made.degree / 4 + 1);
  std::printf("%-28s %6zu %4d  %.0e  %.1e  %.1e  %.1e  %.1e\n", made.name.c_str(),
              made.mesh.faces.size(), made.degree, made.precision, error, found.report.error,
              band_error, found.report.band_error);
  EXPECT_LE(error, made.precision) << made.name << ", degree " << made.degree;
  EXPECT_GE(found.report.error, error / 2) << made.name << ", degree " << made.degree;
  EXPECT_GE(found.report.band_error, band_error / 2) << made.name << ", degree " << made.degree;
  EXPECT_TRUE(found.report.reached) << made.name;
  const double mean = expected.c(0, 0);
  EXPECT_NEAR(found.coefficients.c(0, 0), mean, made.precision * std::abs(mean)) << made.name;
}

TEST(adversarial_meshes, true_errors_are_within_the_wish_and_twice_the_report) {
  std::printf("%-28s  faces    L  wish   true     reported above 3L/4 reported\n", "mesh");
  for (const test::AdversarialMesh& made :
       test::adversarial_meshes(test::Adversaries::RHOLM_ADVERSARIES)) {
    judge(made);
  }
}

}  // namespace
}  // namespace rholm
