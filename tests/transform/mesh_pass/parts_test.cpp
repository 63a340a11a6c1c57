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
#include "transform/mesh_pass/common_lumps.h"
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
  test::shuffle(mesh.faces, 3);
  const auto file = test::packed<float>(mesh);
  for (const std::size_t first : {0u, 7u, 1000u}) {
    for (const std::size_t n : {1u, 2u, 3u, 280u}) {
      std::set<std::uint32_t> corners;
      for (std::size_t t = first; t < first + n; ++t) {
        corners.insert(mesh.faces[t].begin(), mesh.faces[t].end());
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

// Subdivided bodies have the vertices of each level all over the sphere; rows are consecutive.
TEST(division, parts_overlap_where_their_vertices_lie_among_those_of_others) {
  const auto overlap = [](const Mesh& mesh, std::size_t parts) {
    const MeshView view = view_of(mesh);
    return parts_overlap(view, divide_triangles(view.n_faces, parts));
  };
  for (const std::size_t parts : {2u, 3u, 8u}) {
    EXPECT_TRUE(overlap(icosphere(6), parts)) << parts;
    EXPECT_FALSE(overlap(latitude_longitude_sphere(200, 200), parts)) << parts;
  }
  EXPECT_FALSE(overlap(icosphere(6), 1));
  Mesh few_used = icosphere(4);
  few_used.vertices.resize(10 * few_used.vertices.size(), {0, 0, 2});
  for (std::size_t i = 0; i < few_used.faces.size(); i += 7) {
    few_used.faces[i] = {static_cast<std::uint32_t>(few_used.vertices.size() - 1 - i), 0, 1};
  }
  EXPECT_FALSE(overlap(few_used, 8));
}

TEST(common_lumps, are_the_sum_of_what_was_added_to_any_loan) {
  constexpr std::size_t kVertices = 1000;
  for (const std::size_t per_vertex : {lumps_per_vertex(false), lumps_per_vertex(true)}) {
    CommonLumps<std::int32_t> common(kVertices, per_vertex);
    EXPECT_GT(common.most_borrowed(), 8u);
    const auto add = [&](VertexLump<std::int32_t>* lumps, std::int32_t value) {
      for (std::size_t i = 0; i < per_vertex * kVertices; ++i) {
        lumps[i].value[i % 4] += value + static_cast<std::int32_t>(i);
      }
    };
    {
      const CommonLumps<std::int32_t>::Loan one(common), two(common);
      EXPECT_NE(one.lumps(), two.lumps());
      add(one.lumps(), 1);
      add(two.lumps(), 10);
    }
    {
      const CommonLumps<std::int32_t>::Loan again(common);
      add(again.lumps(), 100);
    }
    for (const std::size_t first : {0u, 600u}) {
      common.add_up(first, std::min<std::size_t>(600, kVertices - first));
    }
    for (std::size_t i = 0; i < per_vertex * kVertices; ++i) {
      const VertexLump<std::int32_t>& lump = common.lumps(i / per_vertex)[i % per_vertex];
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_EQ(lump.value[k], k == i % 4 ? 111 + 3 * static_cast<std::int32_t>(i) : 0);
      }
    }
  }
}

// Memory is not touched before it is borrowed.
TEST(common_lumps, are_borrowed_by_no_more_than_a_gigabyte_holds_or_two) {
  const auto most = [](std::size_t n) { return CommonLumps<double>(n, 1).most_borrowed(); };
  EXPECT_EQ(most(std::size_t{1} << 22), 8u);
  EXPECT_EQ(most(std::size_t{1} << 25), 2u);
}

TEST(common_lumps, that_were_written_are_added_to_others) {
  constexpr std::size_t kVertices = 300;
  const std::size_t per_vertex = lumps_per_vertex(true), n = per_vertex * kVertices;
  CommonLumps<double> far(kVertices, per_vertex), near(kVertices, per_vertex);
  const auto value = [](std::size_t i) {
    return i / 500 % 2 == 0 ? 0.0 : 1.0 + static_cast<double>(i);
  };
  {
    const CommonLumps<double>::Loan there(far), here(near);
    for (std::size_t i = 0; i < n; ++i) {
      there.lumps()[i].value[1] = value(i);
      here.lumps()[i].value[1] = 5;
    }
  }
  ByteWriter writer;
  far.write(writer);
  const std::string bytes = writer.take();
  EXPECT_LT(bytes.size(), n * sizeof(VertexLump<double>));
  ByteReader reader(bytes);
  near.add_written(reader);
  reader.finish();
  near.add_up(0, kVertices);
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_EQ(near.lumps(i / per_vertex)[i % per_vertex].value[1], value(i) + 5);
  }
  ByteReader cut(std::string_view(bytes).substr(0, bytes.size() - 1));
  EXPECT_THROW(near.add_written(cut), Error);
  CommonLumps<double> other(kVertices + 1, per_vertex);
  ByteReader again(bytes);
  EXPECT_THROW(other.add_written(again), Error);
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
  test::shuffle(mesh.faces, 5);
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
        EXPECT_EQ(part.name(place), mesh.faces[first + t + i / 3][i % 3]);
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

// Processes a mesh in one part, in many parts, and with indices so scattered that parts are copied.
TEST(mesh_parts, their_sum_is_the_whole_whatever_their_number) {
  const Mesh fine = test::rotated(bumpy_sphere(6)), rough = rough_sphere(5);
  for (const Mesh* mesh : {&fine, &rough}) {
    for (const double precision : {1e-2, 1e-6, 1e-10}) {
      MeshPassOptions options{.degree = 20, .precision = precision, .center = {0.05, 0.02, 0.01}};
      const MeshPassResult whole = mesh_pass(view_of(*mesh), options, {});
      for (const std::size_t parts : {1u, 3u, 8u, 21u}) {
        options.parts = parts;
        const MeshPassResult sum = mesh_pass(view_of(*mesh), options, {});
        EXPECT_LT(relative_error(sum.coefficients, whole.coefficients), 2 * precision) << parts;
        EXPECT_TRUE(sum.report.reached);
        EXPECT_TRUE(sum.closed);
        // Whole vertices are spread as before, so that the error does not grow.
        EXPECT_LT(sum.report.error, 2 * whole.report.error + precision / 10);
        EXPECT_EQ(sum.report.lumped_faces, whole.report.lumped_faces);
        EXPECT_EQ(sum.min_d, whole.min_d);
      }
    }
  }
}

TEST(mesh_parts, give_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = rough_sphere(5);
  for (const double precision : {1e-2, 1e-6, 1e-10}) {
    const MeshPassOptions options{.degree = 20, .precision = precision, .parts = 19};
    const MeshPassResult one = mesh_pass(view_of(mesh), options, {.threads = 1});
    const MeshPassResult four = mesh_pass(view_of(mesh), options, {.threads = 4});
    const auto a = one.coefficients.values(), b = four.coefficients.values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    EXPECT_EQ(one.report.error, four.report.error);
  }
}

// Lumps are shared, and several threads have some of their own. Cases have few and many nodes, with
// and without Hessians, in both precisions.
TEST(mesh_parts, whose_vertices_lie_scattered_are_the_same_on_any_number_of_threads) {
  const Mesh mesh = test::rotated(bumpy_sphere(6, 0.2));
  const MeshView view = view_of(mesh);
  ASSERT_TRUE(parts_overlap(view, divide_triangles(view.n_faces, 4)));
  std::set<bool> single;
  for (const auto& [degree, precision] :
       {std::pair{20, 1e-3}, {40, 1e-6}, {100, 1e-4}, {100, 1e-7}, {60, 1e-11}}) {
    MeshPassOptions options{.degree = degree, .precision = precision, .parts = 4};
    const MeshPassResult one = mesh_pass(view, options, {.threads = 1});
    single.insert(one.report.single);
    for (const int threads : {2, 3, 8}) {
      const MeshPassResult many = mesh_pass(view, options, {.threads = threads});
      const auto a = one.coefficients.values(), b = many.coefficients.values();
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << degree << " " << threads;
      EXPECT_EQ(one.report.error, many.report.error);
    }
    // The parts have borders.
    options.parts = 9;
    const MeshPassResult parts = mesh_pass(view, options, {});
    EXPECT_LT(relative_error(one.coefficients, parts.coefficients), 1.5 * precision);
    EXPECT_EQ(one.report.lumped_faces, parts.report.lumped_faces);
  }
  EXPECT_EQ(single.size(), 2u);
}

TEST(mesh_parts, whose_vertices_lie_scattered_refuse_an_index_out_of_range) {
  for (const std::size_t at : {0u, 40000u, 81919u}) {
    Mesh mesh = bumpy_sphere(6, 0.2);
    mesh.faces[at][1] = static_cast<std::uint32_t>(mesh.vertices.size());
    EXPECT_THROW(mesh_pass(view_of(mesh), {.degree = 20, .precision = 1e-3}, {}), Error) << at;
  }
}

TEST(mesh_parts, whose_vertices_lie_scattered_release_all_of_them) {
  const Mesh mesh = bumpy_sphere(6, 0.2);
  std::vector<int> released(mesh.vertices.size(), 0);
  const MeshPassOptions options{.degree = 8,
                                .release_vertices = [&](std::size_t first, std::size_t n) {
                                  for (std::size_t v = first; v < first + n; ++v) ++released[v];
                                }};
  mesh_pass(view_of(mesh), options, {.threads = 1});
  EXPECT_EQ(*std::min_element(released.begin(), released.end()), 1);
}

TEST(mesh_parts, triangles_without_common_vertices_have_no_border_and_are_closed) {
  const Mesh mesh = bumpy_sphere(4);
  Mesh soup;
  for (const Triangle& t : mesh.faces) {
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t corner : t) soup.vertices.push_back(mesh.vertices[corner]);
    soup.faces.push_back({n, n + 1, n + 2});
  }
  const MeshPassOptions whole{.degree = 12, .precision = 1e-8};
  MeshPassOptions parts = whole;
  parts.parts = 7;
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
                                .parts = 10};
  mesh_pass(view_of(mesh), options, {.threads = 1});
  EXPECT_GT(*std::min_element(released.begin(), released.end()), 0);
}

// Simulates several processes: each handles some of the parts, which are sent as bytes.
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
  const Division division = divide_triangles(view.n_faces, 5);
  const Context silent;
  SharedProgress progress(silent, "", 0, 1, 1);
  std::vector<IndexRange> ranges;
  ranges.reserve(division.count);
  for (std::size_t p = 0; p < division.count; ++p) {
    ranges.push_back(index_range(view, division.first(p), division.n(p)));
  }
  const NonuniformPlan transform = plan_nonuniform({.degree = plan.divided.degree});
  PassSums<T> near(plan), far(plan);
  PartWorker<T> one(view, options, plan, division, transform);
  one.set_ranges(ranges);
  for (std::size_t p = 0; p < division.count; ++p) {
    PartWorker<T> other(view, options, plan, division, transform);
    other.set_ranges(ranges);
    near.add(one.work(p, *one.new_grid(), progress));
    const std::string bytes = bytes_of(other.work(p, *other.new_grid(), progress));
    far.add(part_from<T>(bytes));
    EXPECT_THROW(part_from<T>(std::string_view(bytes).substr(1)), Error);
  }
  EXPECT_EQ(near.finish(one), Outcome::kDone);
  EXPECT_EQ(far.finish(one), Outcome::kDone);
  EXPECT_GT(near.border().vertices.size(), 0u);
  EXPECT_EQ(near.border().vertices, far.border().vertices);
  MeshPassResult a, b;
  Coefficients sum(plan.divided.degree);
  sum.c(1, 0) = 1;
  near.set_result(view, sum, 1, 1, transform, a);
  far.set_result(view, sum, 1, 1, transform, b);
  EXPECT_GT(a.report.error, 0);
  EXPECT_EQ(a.report.error, b.report.error);
  EXPECT_EQ(a.report.nodes, b.report.nodes);
  EXPECT_EQ(a.coefficients.c(0, 0), b.coefficients.c(0, 0));
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.block_errors, b.block_errors);
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
