// Parts of a mesh pass, and their sum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/oracle.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/targets.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"
#include "transform/mesh_pass/border_lumps.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/mesh_part.h"
#include "transform/mesh_pass/part_mesh.h"
#include "transform/mesh_pass/part_worker.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/pass_sums.h"
#include "transform/mesh_pass/plan/sample.h"

namespace rholm {
namespace {

using test::relative_error;
using test::rough_sphere;

TEST(division, parts_are_whole_blocks_that_cover_all_triangles) {
  for (const std::size_t n : {1u, 127u, 128u, 129u, 1000u, 100000u}) {
    for (const std::size_t wanted : {1u, 2u, 3u, 8u, 50u}) {
      const Division division = divide_triangles(n, wanted);
      EXPECT_LE(division.count, wanted);
      EXPECT_EQ(division.size % kTrianglesPerBlock, 0u);
      std::size_t next = 0;
      for (std::size_t p = 0; p < division.count; ++p) {
        EXPECT_EQ(division.first(p), next);
        EXPECT_GT(division.n(p), 0u);
        next += division.n(p);
      }
      EXPECT_EQ(next, n);
    }
  }
}

TEST(division, the_range_of_indices_is_that_of_the_corners) {
  Mesh mesh = icosphere(3);
  test::shuffle(mesh.triangles, 3);
  const auto file = test::packed<float>(mesh);
  for (const std::size_t first : {0u, 7u, 1000u}) {
    for (const std::size_t n : {1u, 2u, 3u, 280u}) {
      std::set<std::uint32_t> corners;
      for (std::size_t t = first; t < first + n; ++t) {
        corners.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
      }
      const IndexRange range = index_range(file.view, first, n);
      EXPECT_EQ(range.low, *corners.begin());
      EXPECT_EQ(range.high, *corners.rbegin());
    }
  }
  EXPECT_EQ(index_range(file.view, 0, 0).size(), 0u);
}

TEST(division, shared_ranges_hold_what_others_have_and_nothing_else) {
  const std::vector<IndexRange> ranges = {{0, 9}, {8, 20}, {30, 40}, {15, 33}, {9, 9}};
  for (std::size_t p = 0; p < ranges.size(); ++p) {
    const std::vector<IndexRange> shared = shared_ranges(ranges, p);
    for (std::uint32_t v = 0; v < 50; ++v) {
      bool wanted = false;
      for (std::size_t q = 0; q < ranges.size(); ++q) {
        wanted = wanted || (q != p && v >= ranges[q].low && v <= ranges[q].high);
      }
      wanted = wanted && v >= ranges[p].low && v <= ranges[p].high;
      const auto times = std::count_if(shared.begin(), shared.end(), [&](const IndexRange& r) {
        return v >= r.low && v <= r.high;
      });
      EXPECT_EQ(times, wanted ? 1 : 0) << p << " " << v;
    }
  }
}

TEST(division, ranges_from_a_part_on_hold_its_indices_and_those_behind_it) {
  const std::vector<IndexRange> ranges = {{0, 9}, {8, 20}, {30, 40}, {15, 33}, {}, {50, 50}};
  for (std::size_t p = 0; p <= ranges.size(); ++p) {
    const std::vector<IndexRange> later = ranges_from(ranges, p);
    for (std::uint32_t v = 0; v < 60; ++v) {
      bool wanted = false;
      for (std::size_t q = p; q < ranges.size(); ++q) {
        wanted = wanted || (v >= ranges[q].low && v <= ranges[q].high);
      }
      EXPECT_EQ(contains(later, v), wanted) << p << " " << v;
    }
  }
}

TEST(border_sums, that_are_complete_can_be_taken) {
  BorderSums<double> sums(false);
  BorderLumps<double> border;
  for (const std::uint32_t vertex : {7u, 3u, 9u, 3u}) {
    const VertexLump<double> lump{{1.0 * vertex, 1, 2, 3}};
    border.add(vertex, &lump);
  }
  sums.add(border);
  const BorderLumps<double> low = sums.take([](std::uint32_t vertex) { return vertex < 8; });
  EXPECT_EQ(low.vertices, (std::vector<std::uint32_t>{3, 7}));
  EXPECT_EQ(low.lumps[0].value[0], 6);
  sums.add(border);
  EXPECT_EQ(sums.finish().vertices, (std::vector<std::uint32_t>{3, 7, 9}));
  EXPECT_EQ(sums.finish().lumps[2].value[0], 18);
}

TEST(part_mesh, knows_where_scattered_corners_are_among_its_own) {
  Mesh mesh = icosphere(4);
  test::shuffle(mesh.triangles, 5);
  const auto file = test::packed<double>(mesh, 5);
  const std::size_t first = 256, n = 300;
  std::size_t checked = 0;
  const PartMesh part = part_mesh(file.view, first, n, index_range(file.view, first, n),
                                  [&](std::size_t, std::size_t count) { checked += count; });
  ASSERT_FALSE(part.names.empty());
  EXPECT_EQ(checked, n);
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    for (std::size_t t = 0; t < n; t += 100) {
      BlockPlaces room;
      const CornerPlaces places = part.corners(file.view, first + t, 100, room);
      EXPECT_EQ(places.first, 0u);
      for (std::size_t i = 0; i < 300; ++i) {
        std::uint32_t place;
        std::memcpy(&place, places.record + i / 3 * places.stride + i % 3 * 4, sizeof place);
        ASSERT_LT(place, part.n_vertices);
        EXPECT_EQ(part.name(place), mesh.triangles[first + t + i / 3][i % 3]);
      }
    }
  });
  EXPECT_TRUE(std::is_sorted(part.names.begin(), part.names.end()));
  const PartMesh::Places places = part.places({part.names[3], part.names[7]});
  EXPECT_EQ(places.begin, 3u);
  EXPECT_EQ(places.end, 8u);
}

TEST(part_mesh, vertices_side_by_side_stay_where_they_are) {
  const Mesh mesh = latitude_longitude_sphere(40, 40);
  const std::size_t first = 1024, n = 1024;
  const IndexRange range = index_range(view_of(mesh), first, n);
  const PartMesh part =
      part_mesh(view_of(mesh), first, n, range, [](std::size_t, std::size_t) { FAIL(); });
  EXPECT_TRUE(part.names.empty());
  EXPECT_EQ(part.first_triangle, first);
  EXPECT_EQ(part.first_vertex, range.low);
  EXPECT_EQ(part.n_vertices, range.size());
  const PartMesh::Places places = part.places({range.low + 2, range.high + 9});
  EXPECT_EQ(places.begin, 2u);
  EXPECT_EQ(places.end, part.n_vertices);
}

TEST(border_sums, are_exact_and_in_the_order_of_vertices) {
  for (const bool hessians : {false, true}) {
    BorderSums<std::int32_t> sums(hessians);
    std::map<std::uint32_t, std::int64_t> expected;
    for (std::uint64_t part = 0; part < 5; ++part) {
      BorderLumps<std::int32_t> border;
      border.per_vertex = lumps_per_vertex(hessians);
      for (std::uint64_t i = 0; i < 100; ++i) {
        const auto vertex = static_cast<std::uint32_t>(test::random_in(0, 200, part, 2 * i));
        std::vector<VertexLump<std::int32_t>> lumps(border.per_vertex);
        for (auto& lump : lumps) {
          for (auto& v : lump.value) {
            v = static_cast<std::int32_t>(test::random_in(-1000, 1000, part, 2 * i + 1));
          }
        }
        expected[vertex] += lumps.back().value[3];
        border.add(vertex, lumps.data());
      }
      sums.add(border);
    }
    const BorderLumps<std::int32_t>& all = sums.finish();
    ASSERT_EQ(all.vertices.size(), expected.size());
    std::size_t i = 0;
    for (const auto& [vertex, sum] : expected) {
      EXPECT_EQ(all.vertices[i], vertex);
      EXPECT_EQ(all.lumps[all.per_vertex * (i + 1) - 1].value[3], sum);
      ++i;
    }
  }
}

// In one way, in many parts, and with the indices so scattered that each part is copied.
TEST(mesh_parts, their_sum_is_the_whole_whatever_their_number) {
  const Mesh fine = test::rotated(bumpy_sphere(6)), rough = rough_sphere(5);
  for (const Mesh* mesh : {&fine, &rough}) {
    for (const double precision : {1e-2, 1e-6, 1e-10}) {
      MeshPassOptions options{.degree = 20, .precision = precision, .center = {0.05, 0.02, 0.01}};
      const MeshPassResult whole = mesh_pass(view_of(*mesh), options, {});
      options.most_held = 100;
      for (const std::size_t parts : {1u, 3u, 8u, 21u}) {
        options.streamed_parts = parts;
        const MeshPassResult sum = mesh_pass(view_of(*mesh), options, {});
        EXPECT_LT(relative_error(sum.coefficients, whole.coefficients), 2 * precision) << parts;
        EXPECT_TRUE(sum.report.reached);
        EXPECT_TRUE(sum.closed);
        // Whole vertices are spread, as ever: no more is left of them.
        EXPECT_LT(sum.report.error, 2 * whole.report.error + precision / 10);
        EXPECT_EQ(sum.report.lumped_triangles, whole.report.lumped_triangles);
        EXPECT_EQ(sum.min_d, whole.min_d);
      }
    }
  }
}

TEST(mesh_parts, give_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = rough_sphere(5);
  for (const double precision : {1e-2, 1e-6, 1e-10}) {
    const MeshPassOptions options{
        .degree = 20, .precision = precision, .most_held = 100, .streamed_parts = 19};
    const MeshPassResult one = mesh_pass(view_of(mesh), options, {.threads = 1});
    const MeshPassResult four = mesh_pass(view_of(mesh), options, {.threads = 4});
    const auto a = one.coefficients.values(), b = four.coefficients.values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    EXPECT_EQ(one.report.error, four.report.error);
  }
}

TEST(mesh_parts, triangles_without_common_vertices_have_no_border_and_are_closed) {
  const Mesh mesh = bumpy_sphere(4);
  Mesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : t) soup.vertices.push_back(mesh.vertices[corner]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const MeshPassOptions whole{.degree = 12, .precision = 1e-8};
  MeshPassOptions parts = whole;
  parts.most_held = 100;
  parts.streamed_parts = 7;
  const MeshPassResult a = mesh_pass(view_of(mesh), whole, {});
  const MeshPassResult b = mesh_pass(view_of(soup), parts, {});
  EXPECT_TRUE(b.closed);
  EXPECT_LT(relative_error(b.coefficients, a.coefficients), 2e-8);
}

TEST(mesh_parts, release_the_vertices_they_are_done_with) {
  const Mesh mesh = latitude_longitude_sphere(64, 64);
  std::vector<int> released(mesh.vertices.size(), 0);
  const MeshPassOptions options{.degree = 8,
                                .release_vertices =
                                    [&](std::size_t first, std::size_t n) {
                                      for (std::size_t v = first; v < first + n; ++v) ++released[v];
                                    },
                                .most_held = 100,
                                .streamed_parts = 10};
  mesh_pass(view_of(mesh), options, {.threads = 1});
  EXPECT_GT(*std::min_element(released.begin(), released.end()), 0);
}

// As several processes do: each works some of the parts, which travel as bytes.
template <typename T>
std::string bytes_of(const MeshPart<T>& part) {
  ByteWriter writer;
  write(part, writer);
  return writer.take();
}

template <typename T>
MeshPart<T> part_from(std::string_view bytes) {
  ByteReader reader(bytes);
  MeshPart<T> part = read_part<T>(reader);
  reader.finish();
  return part;
}

template <typename T>
void expect_same_through_bytes(const Mesh& mesh, const MeshPlan& plan) {
  const MeshView view = view_of(mesh);
  const MeshPassOptions options;
  const Division division = divide_triangles(view.n_triangles, 5);
  const Context silent;
  SharedProgress progress(silent, "", 0, 1, 1);
  std::vector<IndexRange> ranges;
  ranges.reserve(division.count);
  for (std::size_t p = 0; p < division.count; ++p) {
    ranges.push_back(index_range(view, division.first(p), division.n(p)));
  }
  PassSums<T> near(plan), far(plan);
  PartWorker<T> one(view, options, plan, division);
  one.set_ranges(ranges);
  for (std::size_t p = 0; p < division.count; ++p) {
    PartWorker<T> other(view, options, plan, division);
    other.set_ranges(ranges);
    near.add(one.work(p, nullptr, progress).part);
    const std::string bytes = bytes_of(other.work(p, nullptr, progress).part);
    far.add(part_from<T>(bytes));
    EXPECT_THROW(part_from<T>(std::string_view(bytes).substr(1)), Error);
  }
  EXPECT_EQ(near.finish(one), Outcome::kDone);
  EXPECT_EQ(far.finish(one), Outcome::kDone);
  EXPECT_GT(near.border().vertices.size(), 0u);
  EXPECT_EQ(near.border().vertices, far.border().vertices);
  EXPECT_EQ(near.n_kept(), far.n_kept());
  EXPECT_EQ(near.source2(), far.source2());
  EXPECT_EQ(near.hessian2(), far.hessian2());
}

TEST(mesh_parts, are_the_same_when_they_have_travelled_as_bytes) {
  for (const Mesh& mesh : {bumpy_sphere(5), rough_sphere(4)}) {
    const int degree = 10;
    const MeshSample sample = sample_mesh(view_of(mesh), {}, degree);
    MeshPlan plan = plan_mesh(view_of(mesh), sample, {}, degree, 1e-4, {});
    plan.single ? expect_same_through_bytes<float>(mesh, plan)
                : expect_same_through_bytes<double>(mesh, plan);
    plan = plan_mesh(view_of(mesh), sample, {}, degree, 1e-10, {.forbid_single = true});
    expect_same_through_bytes<double>(mesh, plan);
  }
}

TEST(mesh_parts, bytes_of_something_else_are_refused) {
  std::string bytes = bytes_of(MeshPart<float>{});
  EXPECT_EQ(part_from<float>(bytes).undivided.degree(), 0);
  bytes.push_back(0);
  EXPECT_THROW(part_from<float>(bytes), Error);
  EXPECT_THROW(part_from<float>({}), Error);
}

}  // namespace
}  // namespace rholm
