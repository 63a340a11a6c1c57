// What windows leave of vertices and nodes in step with the grid, against the same rules with
// windows a thousand times as good: in units of the share of the wish that the plan gives windows
// (below 1 wherever the constants of src/transform/mesh_pass/plan/plan.cpp are right), of the
// window's error of the norm (kLatticeShare, kAlignedTimes) and of the moduli of nodes in rows
// (kRowsInStep), and, in single precision, of the moduli of all sources (kSingleInStep).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "harmonic/nonuniform/window_error.h"
#include "rholm/primitives.h"
#include "support/adversarial_meshes.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {
namespace {

struct Case {
  std::string name;
  Mesh mesh;
  std::vector<int> degrees;
};

// l2 over 1 <= l <= L.
double distance(const Coefficients& a, const Coefficients& b) {
  Coefficients difference = a;
  for (std::size_t i = 0; i < a.values().size(); ++i) difference.values()[i] -= b.values()[i];
  return norm_of_degrees(difference, 1, a.degree());
}

MeshPassResult pass(const Mesh& mesh, int degree, double precision, double window_share) {
  return mesh_pass(view_of(mesh),
                   {.degree = degree, .precision = precision, .window_share = window_share},
                   Context{});
}

void measure(const Case& given, int degree, double precision) {
  const MeshView mesh = view_of(given.mesh);
  const MeshPassResult found = pass(given.mesh, degree, precision, 1);
  const MeshPassResult exact = pass(given.mesh, degree, precision, 1e-3);
  // A pass that was repeated with other rules says nothing about windows.
  if (found.report.nodes != exact.report.nodes ||
      found.report.lumped_triangles != exact.report.lumped_triangles) {
    return;
  }
  const double error = distance(found.coefficients, exact.coefficients);
  const double window = window_error(found.report.width, found.report.oversampling);
  const MeshSample sample = sample_mesh(mesh, {}, degree);
  const MeshPlan plan = plan_mesh(mesh, sample, {}, degree, precision, {});
  const double norm = norm_of_degrees(exact.coefficients, 1, degree);
  const double moduli = sample.modulus / sample.scale;
  const double rows =
      plan.aligned * plan.node_modulus / (sample.scale * std::sqrt(4 * std::numbers::pi));
  std::printf("| %-22s | %8zu | %3d | %.0e | %.1e | %.3f | %.2f | %2d%s | %.3g | %.3g | %.1e |\n",
              given.name.c_str(), given.mesh.triangles.size(), degree, precision, error / norm,
              error / (plan.allowed.window / sample.scale), plan.aligned, found.report.width,
              found.report.single ? " single" : "", error / (window * norm),
              rows > 0 ? error / (window * rows) : 0.0, found.report.single ? error / moduli : 0.0);
  std::fflush(stdout);
}

std::vector<Case> cases() {
  using namespace test::adversarial;
  std::vector<Case> all;
  all.push_back({"cube-sphere", cube_sphere(290), {64, 128}});
  all.push_back({"box", box({3, 2, 1}, 290), {64, 128}});
  all.push_back({"prism, long", box({1, 1, 6}, 200), {48, 64}});
  for (const auto& [n, m] : std::vector<std::pair<int, int>>{{64, 128}, {80, 160}, {96, 192}}) {
    const std::string size = " " + std::to_string(n) + " x " + std::to_string(m);
    all.push_back({"ball" + size, latitude_longitude_sphere(n, m), {16, 32, 48, 64}});
    all.push_back({"planet" + size, planet(n, m), {32, 48, 64}});
    all.push_back({"lattice" + size, lattice(n, m), {32, 48, 64}});
  }
  all.push_back({"lattice 500 x 1000", lattice(500, 1000), {64, 128}});
  return all;
}

}  // namespace
}  // namespace rholm

int main() {
  std::printf(
      "| mesh | faces | L | wish | left | / share | aligned | width | / norm | / rows | / moduli "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const rholm::Case& given : rholm::cases()) {
    for (const int degree : given.degrees) {
      for (const double precision : {1e-3, 1e-4, 1e-5, 1e-6}) {
        rholm::measure(given, degree, precision);
      }
    }
  }
  return 0;
}
