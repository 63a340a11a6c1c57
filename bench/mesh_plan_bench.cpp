// Window errors of vertices and nodes whose spacing matches the grid, relative to the same rules
// with windows a thousand times as precise. The first unit is the share of the precision that the
// plan allows windows: below 1 if the constants of src/transform/mesh_pass/plan/plan.cpp are right.
// Others are the window's error of the norm (kLatticeShare, kAlignedTimes), the moduli of nodes in
// rows (kRowsInStep) and, in single precision, the moduli of all sources (kSingleInStep).
//
// With the operand `turned`: time and error if the mesh is turned by a generic rotation and the
// coefficients are turned back, on aligned bodies.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harmonic/nonuniform/window_error.h"
#include "rholm/primitives.h"
#include "rholm/rotate.h"
#include "support/adversarial_meshes.h"
#include "support/random_bodies.h"
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

// Returns the l2 norm over 1 <= l <= L.
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
  // A pass repeated with other rules gives no information about windows.
  if (found.report.nodes != exact.report.nodes ||
      found.report.lumped_faces != exact.report.lumped_faces) {
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
              given.name.c_str(), given.mesh.faces.size(), degree, precision, error / norm,
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

// Processor time in milliseconds of one thread, and the coefficients.
struct Timed {
  double time = 0;
  Coefficients found;
};

Timed timed_pass(const Mesh& mesh, int degree, double precision, const Rotation& rotation) {
  const Context one{.threads = 1};
  const std::clock_t start = std::clock();
  const bool still = rotation.w == 1;
  Mesh copy;
  if (!still) copy = mesh;
  for (Vec3& x : copy.vertices) x = rotate(x, rotation);
  const MeshPassOptions options{.degree = degree, .precision = precision};
  Timed result{.found = mesh_pass(view_of(still ? mesh : copy), options, one).coefficients};
  if (!still) result.found = rotate(result.found, inverse(rotation), one);
  result.time = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return result;
}

void compare_turned(const Case& given, int degree, double precision) {
  const Rotation turn = rotation_of(EulerAngles{0.7, 1.1, 2.3});
  const Rotation other = rotation_of(EulerAngles{1.9, 0.8, 0.4});
  Timed plain, turned;
  for (int k = 0; k < 3; ++k) {
    Timed a = timed_pass(given.mesh, degree, precision, {});
    Timed b = timed_pass(given.mesh, degree, precision, turn);
    if (k == 0 || a.time < plain.time) plain = std::move(a);
    if (k == 0 || b.time < turned.time) turned = std::move(b);
  }
  const Coefficients exact = timed_pass(given.mesh, degree, 0.01 * precision, other).found;
  const double wish = precision * norm_of_degrees(exact, 1, degree);
  std::printf("| %s | %zu | %d | %.0e | %.2f | %.2f | %.2f | %.3f | %.3f |\n", given.name.c_str(),
              given.mesh.faces.size(), degree, precision, plain.time, turned.time,
              turned.time / plain.time, distance(plain.found, exact) / wish,
              distance(turned.found, exact) / wish);
  std::fflush(stdout);
}

// Returns bodies with about `faces` faces.
std::vector<Case> aligned_bodies(double faces) {
  using namespace test::adversarial;
  using namespace test::random_bodies;
  const int s = static_cast<int>(std::lround(std::sqrt(faces / 12)));
  const int n = static_cast<int>(std::lround(std::sqrt(faces / 4)));
  const auto turned_body = [&](int around, int layers, const auto& radius) {
    std::vector<std::vector<Vec3>> rings;
    for (int k = 0; k <= layers; ++k) {
      const double z = 1 - 2.0 * k / layers;
      rings.push_back(ring(around, radius(z), 1.5 * z));
    }
    return of_rings(rings, 1.5, -1.5);
  };
  const int teeth = std::clamp(n / 8, 4, 64);
  return {{"box", box({3, 2, 1}, s), {}},
          {"box, long", box({1, 1, 6}, s), {}},
          {"cube-sphere", cube_sphere(s), {}},
          {"ball", latitude_longitude_sphere(n, 2 * n), {}},
          {"planet", planet(n, 2 * n), {}},
          {"lattice", lattice(n, 2 * n), {}},
          {"cylinder", turned_body(4 * n, n / 2, [](double) { return 1.0; }), {}},
          {"vase", turned_body(2 * n, n, [](double z) { return 0.6 + 0.3 * std::cos(3 * z); }), {}},
          {"gear", gear(teeth, std::max(1, n * n / (2 * teeth)), 0.2, 0.3, 0.02), {}}};
}

void compare_all_turned() {
  std::printf(
      "| mesh | faces | L | wish | ms | turned | ratio | left, in wishes | turned |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  for (const double faces : {1e3, 1e4, 1e5, 1e6}) {
    for (const Case& given : aligned_bodies(faces)) {
      for (const int degree : {16, 32, 64, 128, 256, 480}) {
        if (degree > 0.6 * std::sqrt(faces) + 64) continue;
        for (const double precision : {1e-3, 1e-5, 1e-7, 1e-9}) {
          compare_turned(given, degree, precision);
        }
      }
    }
  }
}

}  // namespace
}  // namespace rholm

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "turned") {
    rholm::compare_all_turned();
    return 0;
  }
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
