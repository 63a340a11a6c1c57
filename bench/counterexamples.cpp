// A search for meshes on which the fast engine exceeds the requested error, or reports a wrong one.
//
//   build/release/bench/counterexamples [SECONDS] [SEED] [FILE.off]
//
// Half of the bodies are random; the others are variations of the bodies with the largest error so
// far. Prints a line for each body that is worse than all before. At the end, prints how the
// reported errors compare with the true ones. Exits with 1 at the first error above the request,
// and writes the body to the file, with its centre at the origin.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/random_bodies.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/verify.h"

namespace {

using namespace rholm;

struct Tried {
  test::BodyGenes genes;
  double true_error = 0;  // both in units of the requested precision
  double reported = 0;
  bool reached = true;
};

Tried try_body(const test::BodyGenes& genes) {
  const test::RandomBody body = test::random_body(genes);
  Mesh moved = body.mesh;
  for (Vec3& v : moved.vertices) v -= body.center;
  const Context one{.threads = 1};
  const MeshPassOptions wanted{.degree = body.degree, .precision = body.precision};
  MeshPassResult found = mesh_pass(view_of(moved), wanted, one);
  verify_pass(view_of(moved), wanted, one, found);
  const StarChart chart{.mesh = moved, .edges = pair_edges(moved), .report = {}};
  // Returns the relative error by direct sums.
  const auto error_by = [&](Method method) {
    const Coefficients exact = expand(chart,
                                      {.degree = body.degree,
                                       .method = method,
                                       .engine = Engine::kDirect,
                                       .precision = 1e-3 * body.precision},
                                      one)
                                   .expansion.coefficients;
    Coefficients error = found.coefficients;
    for (std::size_t i = 0; i < error.values().size(); ++i) error.values()[i] -= exact.values()[i];
    const double norm = norm_of_degrees(exact, 1, body.degree);
    return norm > 0 ? norm_of_degrees(error, 1, body.degree) / norm : 0;
  };
  double error = error_by(Method::kEdge);
  // Sums over edges have terms that cancel where the surface is near. Cubature of the faces has no
  // terms that cancel.
  if (error > body.precision) error = error_by(Method::kArea);
  return {.genes = genes,
          .true_error = error / body.precision,
          .reported = found.report.error / body.precision,
          .reached = found.report.reached};
}

void write(const test::RandomBody& body, const char* path) {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return;
  std::fprintf(file, "OFF\n%zu %zu 0\n", body.mesh.vertices.size(), body.mesh.faces.size());
  for (const Vec3& vertex : body.mesh.vertices) {
    const Vec3 x = vertex - body.center;
    std::fprintf(file, "%.17g %.17g %.17g\n", x.x, x.y, x.z);
  }
  for (const Triangle& t : body.mesh.faces) {
    std::fprintf(file, "3 %u %u %u\n", t[0], t[1], t[2]);
  }
  std::fclose(file);
}

double percentile(const std::vector<double>& sorted, double share) {
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds = argc > 1 ? std::strtod(argv[1], nullptr) : 60;
  const auto seed = std::uint64_t{argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1};
  constexpr std::size_t kParents = 16;
  const auto begin = std::chrono::steady_clock::now();
  std::vector<Tried> worst;
  std::vector<double> ratios;
  std::printf("%8s  %-13s %7s %4s  %6s  %8s  %8s\n", "body", "family", "faces", "L", "wish", "true",
              "reported");
  std::uint64_t n = 0;
  std::size_t missed = 0;
  for (;; ++n) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (passed.count() > seconds) break;
    const std::uint64_t stream = seed + n * 1000003;
    const bool random = worst.size() < kParents || n % 2 == 0;
    const Tried tried = try_body(random ? test::random_genes(stream)
                                        : test::mutated(worst[n / 2 % kParents].genes, stream));
    if (tried.reached && tried.true_error > 1e-3)
      ratios.push_back(tried.reported / tried.true_error);
    missed += !tried.reached;
    if (!tried.reached) continue;
    const bool is_worst = worst.empty() || tried.true_error > worst[0].true_error;
    const bool beyond = tried.true_error > 1;
    if (is_worst || beyond || tried.reported < 0.5 * tried.true_error) {
      const test::RandomBody body = test::random_body(tried.genes);
      std::printf("%8llu  %-13s %7zu %4d  %6.0e  %8.3f  %8.3f\n",
                  static_cast<unsigned long long>(n), body.family.c_str(), body.mesh.faces.size(),
                  body.degree, body.precision, tried.true_error, tried.reported);
      std::fflush(stdout);
    }
    const auto place = std::upper_bound(
        worst.begin(), worst.end(), tried,
        [](const Tried& a, const Tried& b) { return a.true_error > b.true_error; });
    worst.insert(place, tried);
    if (worst.size() > kParents) worst.pop_back();
    if (beyond) {
      if (argc > 3) write(test::random_body(tried.genes), argv[3]);
      return 1;
    }
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("%llu bodies, %zu not reached; reported / true:", static_cast<unsigned long long>(n),
              missed);
  if (!ratios.empty()) {
    std::printf(" 1 %% %.3f, median %.3f, 99 %% %.3f", percentile(ratios, 0.01),
                percentile(ratios, 0.5), percentile(ratios, 0.99));
  }
  std::printf("\n");
  return 0;
}
