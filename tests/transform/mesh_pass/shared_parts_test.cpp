// Parts of a mesh pass handled by several processes. Here they are objects with their own mesh that
// know of the pass only what jobs contain.
#include "transform/mesh_pass/shared_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/executor_by.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/sizes.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {
namespace {

using test::rough_sphere;

// A process that helps the process that runs the pass.
struct Other {
  explicit Other(const Mesh& m) : mesh(m), view(view_of(mesh)), helper(view, hooks) {}
  Mesh mesh;
  MeshView view;
  MeshPassOptions hooks;
  PassHelper helper;
};

// Runs the tasks of all processes one after the other.
class Processes {
 public:
  Processes(const Mesh& mesh, std::size_t n) {
    for (std::size_t i = 1; i < n; ++i) others_.push_back(std::make_unique<Other>(mesh));
  }

  Executor* executor() { return &executor_; }

  std::size_t rounds = 0, bytes = 0;

 private:
  void run(const Parts& parts, const Executor::Work& here, const Executor::Take& take) {
    EXPECT_EQ(parts.job, kPassJob);
    std::vector<Executor::Work> work = {here};
    for (const auto& other : others_) work.push_back(other->helper.work_of(parts.input));
    ++rounds;
    std::vector<std::string> results(parts.count);
    for (std::size_t i = 0; i < parts.count; ++i) {
      const std::size_t part = parts.count - 1 - i;  // any order is allowed
      const std::size_t who = (7 * part + rounds) % work.size();
      results[part] = work[who](part, 1);
      bytes += who == 0 ? 0 : results[part].size();
    }
    for (std::size_t part = 0; part < parts.count; ++part) take(part, results[part]);
  }

  std::vector<std::unique_ptr<Other>> others_;
  test::ExecutorBy executor_{
      [this](const auto& parts, const auto& here, const auto& take) { run(parts, here, take); }};
};

void expect_same_bits(const MeshPassResult& a, const MeshPassResult& b) {
  ASSERT_EQ(a.coefficients.degree(), b.coefficients.degree());
  EXPECT_TRUE(std::ranges::equal(a.coefficients.values(), b.coefficients.values()));
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_EQ(a.min_d, b.min_d);
  EXPECT_EQ(a.min_cos_gamma, b.min_cos_gamma);
  EXPECT_EQ(a.bad_faces, b.bad_faces);
  EXPECT_EQ(a.report.error, b.report.error);
  EXPECT_EQ(a.report.band_error, b.report.band_error);
  EXPECT_EQ(a.report.nodes, b.report.nodes);
  EXPECT_EQ(a.report.lumped_faces, b.report.lumped_faces);
  EXPECT_EQ(a.report.passes, b.report.passes);
}

// Returns vertices in rows; vertices of a part are neighbours.
Mesh rows_of_vertices() {
  Mesh mesh = latitude_longitude_sphere(200, 400);
  for (Vec3& v : mesh.vertices) {
    v = (1 + 0.1 * std::sin(3 * v.x + v.y) + 0.05 * v.z * v.z * v.x) * Vec3{v.x, v.z, -v.y};
  }
  return mesh;
}

// Cases have lumps of both precisions and with Hessians, shared or not. There are as many parts as
// useful, up to eight grids, or one common grid. A mesh of one part is not shared. Without
// `nightly` each mesh meets each precision and each number of parts, and each precision meets each
// number of parts on some mesh.
TEST_OF_TWO_SIZES(shared_parts, give_the_bits_of_one_process) {
  const Mesh fine = bumpy_sphere(7), rough = rough_sphere(5), rows = rows_of_vertices(),
             small = bumpy_sphere(4);
  ASSERT_TRUE(parts_overlap(view_of(fine), divide_triangles(fine.faces.size(), 8)));
  ASSERT_FALSE(parts_overlap(view_of(rows), divide_triangles(rows.faces.size(), 8)));
  const std::array meshes = {&fine, &rough, &rows, &small};
  const std::array precisions = {1e-2, 1e-6, 1e-10};
  const std::array<std::size_t, 3> all_parts = {0, 3, 21};
  std::set<std::size_t> rounds;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Mesh* mesh = meshes[i];
    for (std::size_t j = 0; j < precisions.size(); ++j) {
      const double precision = precisions[j];
      for (std::size_t k = 0; k < all_parts.size(); ++k) {
        if (!nightly && (i + j + k) % 3 != 0) continue;
        MeshPassOptions options{.degree = 12,
                                .precision = precision,
                                .center = {0.05, 0.02, 0.01},
                                .parts = all_parts[k]};
        const MeshPassResult alone = mesh_pass(view_of(*mesh), options, {});
        for (const std::size_t n : {1u, 3u}) {
          Processes processes(*mesh, n);
          options.executor = processes.executor();
          expect_same_bits(mesh_pass(view_of(*mesh), options, {.threads = 2}), alone);
          ASSERT_EQ(processes.rounds % static_cast<std::size_t>(alone.report.passes), 0u);
          rounds.insert(processes.rounds / static_cast<std::size_t>(alone.report.passes));
          EXPECT_EQ(processes.bytes > 0, n > 1 && processes.rounds > 0);
        }
      }
    }
  }
  EXPECT_EQ(rounds, (std::set<std::size_t>{0, 2}));
}

// Other processes do not know the order into which triangles are sorted.
TEST(shared_parts, triangles_in_random_order_are_not_shared) {
  Mesh mesh = bumpy_sphere(6);
  test::shuffle(mesh.faces, 3);
  MeshPassOptions options{.degree = 12, .precision = 1e-6};
  const MeshPassResult alone = mesh_pass(view_of(mesh), options, {});
  Processes processes(mesh, 3);
  options.executor = processes.executor();
  expect_same_bits(mesh_pass(view_of(mesh), options, {}), alone);
  EXPECT_EQ(processes.rounds, 0u);
}

// A part of an ordered mesh covers a small part of the sphere, and of a grid.
TEST(shared_parts, send_what_is_in_a_grid) {
  const Mesh mesh = latitude_longitude_sphere(256, 512);
  MeshPassOptions options{.degree = 100, .precision = 1e-4, .parts = 64};
  Processes processes(mesh, 2);
  options.executor = processes.executor();
  const MeshPassResult result = mesh_pass(view_of(mesh), options, {});
  const auto passes = static_cast<std::size_t>(result.report.passes);
  const std::size_t whole = std::size_t{4} * 100 * 2 * 100 * sizeof(double);  // lower bound
  EXPECT_GT(result.report.oversampling, 2);
  EXPECT_LT(processes.bytes / (32 * passes), whole / 3);
}

TEST(shared_parts, bytes_that_are_no_input_are_refused) {
  Other other(icosphere(2));
  EXPECT_THROW(other.helper.work_of(""), Error);
  EXPECT_THROW(other.helper.work_of("nonsense"), Error);
  EXPECT_THROW(other.helper.work_of(parts_job({}, false)), Error);  // ranges must come first
  const NonuniformPlan transform = plan_nonuniform({.degree = 4});
  const std::string input = ranges_job({}, transform, divide_triangles(other.mesh.faces.size(), 2));
  EXPECT_THROW(other.helper.work_of(input.substr(0, input.size() - 1)), Error);
  EXPECT_EQ(other.helper.work_of(input)(1, 1).size(), sizeof(IndexRange));
}

}  // namespace
}  // namespace rholm
