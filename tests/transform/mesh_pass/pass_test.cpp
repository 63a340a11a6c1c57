// The precision of the fast engine on small meshes of all kinds. The oracle is cubature of r dOmega
// by direct sums: it shares neither nodes nor weights nor windows with the mesh pass.
#include "transform/mesh_pass/pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "support/oracle.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/sizes.h"
#include "support/targets.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using test::relative_error;
using test::rough_sphere;

// Adds flat triangles. Each of the first n triangles loses its edge a -> b to a triangle a, b, m.
// The vertex m is in the middle of the edge, except for rounding.
Mesh with_flat_triangles(Mesh mesh, std::size_t n) {
  for (std::size_t t = 0; t < n; ++t) {
    const auto [a, b, c] = mesh.faces[t];
    const auto m = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    mesh.faces[t] = {a, m, c};
    mesh.faces.push_back({m, b, c});
    mesh.faces.push_back({a, b, m});
    mesh.faces.push_back({a, c, a});  // without area, and closed in itself
    mesh.faces.push_back({a, a, c});
  }
  return mesh;
}

// Surfaces need not be star-shaped.
StarChart chart_of(const Mesh& mesh, const Vec3& center) {
  return make_star_chart(mesh, {.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0},
                                .allow_signed = true});
}

Transform oracle_of(const StarChart& chart, int degree) {
  return expand(
      chart,
      {.degree = degree, .method = Method::kArea, .engine = Engine::kDirect, .precision = 1e-13});
}

double norm_without_mean(const Coefficients& c) {
  double sum = -std::pow(c.c(0, 0), 2);
  for (const double value : c.values()) sum += value * value;
  return std::sqrt(sum);
}

struct Case {
  const char* name;
  Mesh mesh;
  Vec3 center;
  int degree;
  double slope;  // smallest d_T / r of a face, at least 1 / (8 L)
};

std::vector<Case> cases() {
  const Mesh octahedron = test::random_octahedron(5);
  const Mesh bumpy = test::rotated(bumpy_sphere(3, 0.25));
  return {{"octahedron, L 1", octahedron, {}, 1, 0.3},
          {"octahedron, L 2", octahedron, {}, 2, 0.3},
          {"octahedron, L 3", octahedron, {}, 3, 0.3},
          {"octahedron", octahedron, {}, 64, 0.3},
          {"tetrahedron", test::tetrahedron(), {0.2, 0.2, 0.2}, 64, 0.2},
          {"box, off centre", box({2, 2, 2}, 4), {0.9, 0.5, -0.3}, 16, 0.05},
          {"bumpy", bumpy, {0.1, 0, -0.1}, 3, 0.5},
          {"bumpy", bumpy, {0.1, 0, -0.1}, 16, 0.5},
          {"bumpy", bumpy, {0.1, 0, -0.1}, 64, 0.5},
          {"bumpy and fine", bumpy_sphere(5, 0.2), {}, 16, 0.5},
          {"rough", rough_sphere(3), {0.1, 0.1, 0}, 40, 0.1},
          {"rough and fine", rough_sphere(4), {0.1, 0.1, 0}, 40, 0.05},
          {"sphere, off centre", icosphere(4), {0.5, 0.2, 0}, 24, 0.3},
          {"needle", ellipsoid({5, 0.3, 0.3}, 3), {0.2, 0.02, 0}, 32, 0.05},
          {"flat triangles", with_flat_triangles(bumpy, 20), {0.1, 0, -0.1}, 16, 0.5},
          {"walls seen edge on", test::l_prism(1), {1, 0.5, 0}, 24, 0},
          {"walls seen from behind", test::l_prism(1), {2, 0.5, 0.1}, 24, 0}};
}

struct Sweep {
  int reports = 0, close = 0;  // estimated errors: all, and within one to five times the true one
};

void sweep(const Case& c, Sweep& totals) {
  const StarChart chart = chart_of(c.mesh, c.center);
  const Coefficients expected = oracle_of(chart, c.degree).expansion.coefficients;
  const double c00 = std::abs(expected.c(0, 0));
  // TransformOptions::precision says "about", which the factor 4 stands for.
  const double steepest = std::max(c.slope, 1.0 / (8 * c.degree));
  const double rounding = 4e-15 * c00 / norm_without_mean(expected) / steepest;
  double logarithm = 0;
  int n = 0;
  for (double wish = 1e-3; wish > 0.5e-12; wish /= 10) {
    SCOPED_TRACE(std::string(c.name) + ", L " + std::to_string(c.degree) + ", wish " +
                 std::to_string(std::log10(wish)));
    const MeshPassResult pass =
        mesh_pass(view_of(chart.mesh), {.degree = c.degree, .precision = wish}, {});
    const Coefficients& found = pass.coefficients;
    const double error = relative_error(found, expected), reported = pass.report.error;
    EXPECT_LT(error, wish + rounding);
    EXPECT_LT(std::abs(found.c(0, 0) - expected.c(0, 0)), (wish + 1e-14) * c00);
    if (wish < 3 * rounding) continue;
    logarithm += std::log(wish / error);
    ++n;
    EXPECT_GT(reported, error / 3);
    EXPECT_LE(reported, wish);
    ++totals.reports;
    totals.close += reported > 0.8 * error && reported < 5 * error;
  }
  // For L < 4 a wave is as long as the body. The estimate ignores that parts of a face differ in
  // phase, which wastes digits but hardly time.
  EXPECT_LT(std::exp(logarithm / n), c.degree < 4 ? 120 : 30) << c.name << ", L " << c.degree;
}

TEST_OF_TWO_SIZES(mesh_pass, keeps_wanted_precisions_and_wastes_no_more_than_a_factor_of_thirty) {
  Sweep totals;
  for (const Case& c : cases()) {
    const auto oracle_takes = static_cast<double>(c.mesh.faces.size()) * c.degree * c.degree;
    if (nightly || oracle_takes < 3e6) sweep(c, totals);
  }
  EXPECT_GT(totals.close, 0.5 * totals.reports);
}

// At creases no errors cancel, so that values and gradients do not suffice. With Hessians and a few
// nodes between vertices, nearly all triangles are lumped.
TEST(mesh_pass, lumps_rough_meshes_with_hessians) {
  const Mesh mesh = rough_sphere(5);
  const StarChart chart = chart_of(mesh, {0.1, 0.1, 0});
  const Transform expected = expand(chart, {.degree = 30, .precision = 1e-11});
  std::size_t nodes = 0;
  for (const double wish : {1e-2, 1e-4}) {
    const Transform found = expand(chart, {.degree = 30, .precision = wish});
    EXPECT_LT(relative_error(found.expansion.coefficients, expected.expansion.coefficients), wish);
    EXPECT_GT(found.fast->lumped_faces, mesh.faces.size() * 9 / 10);
    EXPECT_GT(found.fast->nodes, nodes);
    EXPECT_LT(found.fast->nodes, 8 * mesh.faces.size());
    nodes = found.fast->nodes;
  }
}

// The half-edges of each edge nearly cancel, so that no single triangle has to be precise.
TEST(mesh_pass, lumps_all_of_a_smooth_mesh_where_edges_cancel) {
  const Mesh mesh = bumpy_sphere(6, 0.2);
  const MeshPassResult expected = mesh_pass(view_of(mesh), {.degree = 64, .precision = 1e-11}, {});
  const MeshPassResult found = mesh_pass(view_of(mesh), {.degree = 64, .precision = 1e-6}, {});
  EXPECT_LT(relative_error(found.coefficients, expected.coefficients), 1e-6);
  EXPECT_EQ(found.report.nodes, 0u);
  EXPECT_EQ(found.report.passes, 1);
}

// The sample contains rows of a face, where edges cancel, but no creases between faces.
TEST(mesh_pass, creases_that_no_sample_has_seen_keep_the_precision) {
  const Mesh mesh = box({1, 1, 1}, 65);
  const MeshPassResult expected = mesh_pass(view_of(mesh), {.degree = 64, .precision = 1e-11}, {});
  for (const double wish : {1e-5, 1e-6, 1e-7}) {
    const MeshPassResult found = mesh_pass(view_of(mesh), {.degree = 64, .precision = wish}, {});
    EXPECT_LT(relative_error(found.coefficients, expected.coefficients), wish);
    EXPECT_TRUE(found.report.reached);
  }
}

// A few creased triangles among very many smooth ones are in no sample, neither before the pass nor
// of its edges.
TEST_OF_TWO_SIZES(mesh_pass, lone_spikes_on_a_smooth_mesh_keep_the_precision) {
  const Mesh smooth = bumpy_sphere(7, 0.2);
  for (const double height : nightly ? std::vector{1e-4, 1e-3, 1e-2} : std::vector{1e-3}) {
    Mesh mesh = smooth;
    for (const std::size_t i : {1000U, 50000U, 90000U, 120000U, 160000U}) {
      mesh.vertices[i] *= 1 + height;
    }
    const MeshPassResult expected =
        mesh_pass(view_of(mesh), {.degree = 150, .precision = 1e-11}, {});
    for (const double wish : {1e-5, 1e-6, 1e-7}) {
      const MeshPassResult found = mesh_pass(view_of(mesh), {.degree = 150, .precision = wish}, {});
      EXPECT_LT(relative_error(found.coefficients, expected.coefficients), wish)
          << height << ", " << wish;
    }
  }
}

// A ball has little besides its mean: the sample overestimates the other coefficients.
TEST(mesh_pass, reaches_what_rounding_allows_on_a_ball) {
  for (const int subdivisions : {3, 5}) {
    for (const int degree : {1, 2, 5}) {
      const StarChart chart = chart_of(icosphere(subdivisions), {});
      const Transform transform = expand(chart, {.degree = degree});
      EXPECT_TRUE(transform.fast->reached) << subdivisions << ", L " << degree;
      EXPECT_LT(norm_without_mean(transform.expansion.coefficients), 1.5e-14);
    }
  }
}

// Nodes between vertices carry a part of the weights, so that weights of vertices do not add up to
// zero. This is not an overflow, and no reason to restart in double precision.
TEST_OF_TWO_SIZES(mesh_pass, single_precision_is_enough_where_nodes_take_a_part) {
  const Mesh mesh = bumpy_sphere(nightly ? 7 : 6, 0.2);
  const MeshPassOptions options{.degree = nightly ? 400 : 200, .precision = 1e-6};
  const MeshPassResult found = mesh_pass(view_of(mesh), options, {});
  EXPECT_TRUE(found.report.single);
  EXPECT_EQ(found.report.passes, 1);
  EXPECT_GT(found.report.nodes, mesh.faces.size());
  const MeshPassResult expected =
      mesh_pass(view_of(mesh), {.degree = options.degree, .precision = 1e-10}, {});
  EXPECT_LT(relative_error(found.coefficients, expected.coefficients), 1e-6);
}

// The oracle is compared with another one that shares no integrals with it.
TEST(mesh_pass, agrees_with_the_curl_method) {
  const StarChart chart = chart_of(test::rotated(bumpy_sphere(2, 0.25)), {0.1, 0, -0.1});
  const Transform expected =
      expand(chart, {.degree = 24, .method = Method::kCurl, .precision = 1e-13});
  for (const double wish : {1e-4, 1e-8, 1e-12}) {
    const Transform transform = expand(chart, {.degree = 24, .precision = wish});
    EXPECT_LT(relative_error(transform.expansion.coefficients, expected.expansion.coefficients),
              wish + 1e-14);
  }
}

ErrorCode code_of(const MeshView& mesh, const MeshPassOptions& options,
                  const Context& context = {}) {
  try {
    mesh_pass(mesh, options, context);
  } catch (const Error& error) {
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return error.code();
  }
  ADD_FAILURE() << "not refused";
  return ErrorCode::kIo;
}

void expect_same_bits(const MeshPassResult& a, const MeshPassResult& b) {
  ASSERT_EQ(a.coefficients.degree(), b.coefficients.degree());
  EXPECT_TRUE(std::ranges::equal(a.coefficients.values(), b.coefficients.values()));
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.min_d, b.min_d);
  EXPECT_EQ(a.report.error, b.report.error);
  EXPECT_EQ(a.report.nodes, b.report.nodes);
}

// Vertices have single precision, parts and grids vary, and nodes are kept or spread at once.
TEST(mesh_pass, gives_the_same_bits_for_any_number_of_threads) {
  const Mesh fine = bumpy_sphere(6), rough = rough_sphere(5);
  for (const Mesh* mesh : {&fine, &rough}) {
    for (const double precision : {1e-2, 1e-5, 1e-10}) {
      const MeshPassOptions options{
          .degree = 20, .precision = precision, .center = {0.05, 0.02, 0.01}};
      const MeshPassResult one = mesh_pass(view_of(*mesh), options, {.threads = 1});
      for (const int threads : {2, 4}) {
        expect_same_bits(mesh_pass(view_of(*mesh), options, {.threads = threads}), one);
      }
    }
  }
}

TEST(mesh_pass, takes_float_coordinates_in_a_file_as_the_numbers_they_are) {
  const auto file = test::packed<float>(test::rotated(bumpy_sphere(4)), 9);
  const Mesh same = test::unpacked(file.view);
  for (const double precision : {1e-3, 1e-9}) {
    const MeshPassOptions options{.degree = 20, .precision = precision, .center = {0.1, 0, 0}};
    expect_same_bits(mesh_pass(file.view, options, {}), mesh_pass(view_of(same), options, {}));
  }
}

TEST(mesh_pass, the_order_of_triangles_changes_nothing_but_rounding) {
  Mesh mesh = rough_sphere(5);
  const MeshPassOptions plain{.degree = 30};
  for (const double precision : {1e-2, 1e-6, 1e-10}) {
    MeshPassOptions options = plain;
    options.precision = precision;
    const MeshPassResult in_order = mesh_pass(view_of(mesh), options, {});
    Mesh mixed = mesh;
    test::shuffle(mixed.faces, 11);
    const MeshPassResult random = mesh_pass(view_of(mixed), options, {});
    EXPECT_LT(relative_error(random.coefficients, in_order.coefficients), 2 * precision);
    EXPECT_TRUE(random.closed);
    EXPECT_NEAR(random.volume, in_order.volume, 1e-13 * in_order.volume);
    EXPECT_EQ(random.min_d, in_order.min_d);
  }
}

// After sorting, neighbours cancel again, and no additional triangle needs nodes.
TEST(mesh_pass, a_fine_mesh_in_random_order_is_as_good_as_in_order) {
  const Mesh mesh = test::rotated(bumpy_sphere(6));
  const MeshPassOptions options{.degree = 48, .precision = 1e-5, .center = {0.1, 0, 0}};
  const MeshPassResult in_order = mesh_pass(view_of(mesh), options, {});
  Mesh mixed = mesh;
  test::shuffle(mixed.faces, 11);
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  test::shuffle(order, 12);
  for (const Mesh& disordered : {mixed, test::renumbered(mixed, order)}) {
    const MeshPassResult random = mesh_pass(view_of(disordered), options, {});
    EXPECT_LT(relative_error(random.coefficients, in_order.coefficients), 2 * options.precision);
    EXPECT_LE(random.report.nodes, in_order.report.nodes);
    EXPECT_TRUE(random.report.reached);
    EXPECT_TRUE(random.closed);
    EXPECT_EQ(random.times.count("order"), 1u);
    EXPECT_EQ(in_order.times.count("order"), 0u);
    expect_same_bits(mesh_pass(view_of(disordered), options, {.threads = 2}), random);
  }
}

TEST(mesh_pass, a_disordered_mesh_with_something_wrong_is_refused) {
  Mesh mesh = bumpy_sphere(5);
  test::shuffle(mesh.faces, 11);
  const MeshPassOptions options{.degree = 8, .precision = 1e-3};
  Mesh beyond = mesh;
  beyond.faces[777][1] = static_cast<std::uint32_t>(mesh.vertices.size());
  EXPECT_THROW(mesh_pass(view_of(beyond), options, {}), Error);
  Mesh nowhere = mesh;
  nowhere.vertices[777].y = std::nan("");
  EXPECT_THROW(mesh_pass(view_of(nowhere), options, {}), Error);
  MeshPassOptions checked = options;
  checked.check = [](std::size_t first, std::size_t) { return first < 9000; };
  EXPECT_THROW(mesh_pass(view_of(mesh), checked, {}), Error);
}

TEST(mesh_pass, every_instruction_set_keeps_the_precision) {
  for (const Mesh& mesh : {test::rotated(bumpy_sphere(4)), rough_sphere(4)}) {
    const StarChart chart = chart_of(mesh, {0.1, 0, 0});
    const Coefficients expected = oracle_of(chart, 20).expansion.coefficients;
    test::for_each_target([&](const char* target) {
      for (const double precision : {1e-3, 1e-6, 1e-11}) {
        const Transform transform = expand(chart, {.degree = 20, .precision = precision});
        EXPECT_LT(relative_error(transform.expansion.coefficients, expected), precision) << target;
      }
    });
  }
}

TEST(mesh_pass, tells_whether_the_mesh_is_closed_and_how_it_lies) {
  const Mesh mesh = test::rotated(bumpy_sphere(3));
  const MeshPassOptions options{.degree = 4, .precision = 1e-4, .center = {0.1, 0.1, 0}};
  const MeshPassResult whole = mesh_pass(view_of(mesh), options, {});
  const StarReport star = check_star(mesh, options.center, 0);
  EXPECT_TRUE(whole.closed);
  EXPECT_NEAR(whole.volume, enclosed_volume(mesh), 1e-13);
  EXPECT_NEAR(whole.min_d, star.min_d, 1e-13);
  EXPECT_NEAR(whole.min_cos_gamma, star.min_cos_gamma, 1e-13);
  EXPECT_EQ(whole.bad_faces, 0u);
  EXPECT_TRUE(mesh_pass(view_of(test::exploded(mesh)), options, {}).closed);
  Mesh inward = mesh;
  flip(inward);
  const MeshPassResult inside_out = mesh_pass(view_of(inward), options, {});
  EXPECT_TRUE(inside_out.closed);
  EXPECT_NEAR(inside_out.volume, -whole.volume, 1e-13);
  EXPECT_EQ(inside_out.bad_faces, mesh.faces.size());
  Mesh open = mesh;
  open.faces.pop_back();
  EXPECT_FALSE(mesh_pass(view_of(open), options, {}).closed);
  Mesh misoriented = mesh;
  std::swap(misoriented.faces[9][0], misoriented.faces[9][1]);
  EXPECT_FALSE(mesh_pass(view_of(misoriented), options, {}).closed);
}

TEST(mesh_pass, works_on_a_single_triangle) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.faces = {{0, 1, 2}};
  const MeshPassResult one = mesh_pass(view_of(mesh), {.degree = 8, .precision = 1e-10}, {});
  EXPECT_FALSE(one.closed);
  EXPECT_NEAR(one.volume, 1.0 / 6, 1e-15);
  EXPECT_NEAR(one.min_d, std::sqrt(1.0 / 3), 1e-15);
  for (const double value : one.coefficients.values()) EXPECT_TRUE(std::isfinite(value));
  // The oracle is cubature of d_T int dS/|x|^2.
  const Coefficients expected = test::oracle_coefficients(mesh, 0, RadialFunction::kRadius, 40);
  EXPECT_NEAR(one.coefficients.c(0, 0), expected.c(0, 0), 1e-10);
}

TEST(mesh_pass, refuses_meshes_without_triangles_numbers_or_area) {
  const MeshPassOptions options{.degree = 8};
  EXPECT_EQ(code_of(view_of(Mesh{}), options), ErrorCode::kInvalidInput);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    for (const std::size_t i : {0u, 41u, 161u}) {
      Mesh mesh = icosphere(2);
      mesh.vertices[i].z = bad;
      EXPECT_EQ(code_of(view_of(mesh), options), ErrorCode::kInvalidInput);
    }
  }
  for (const std::uint32_t index : {162u, 0xFFFFFFFFu}) {
    for (const std::size_t t : {0u, 200u, 319u}) {
      Mesh mesh = icosphere(2);
      mesh.faces[t][1] = index;
      EXPECT_EQ(code_of(view_of(mesh), options), ErrorCode::kInvalidInput);
    }
  }
  Mesh flat;
  flat.vertices = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  flat.faces = {{0, 1, 2}, {2, 1, 0}};
  EXPECT_EQ(code_of(view_of(flat), options), ErrorCode::kInvalidInput);
}

TEST(mesh_pass, refuses_a_surface_through_the_centre) {
  const Mesh mesh = box({2, 2, 2}, 2);
  // The centre is at a vertex, on an edge, and on a face.
  for (const Vec3& center : {Vec3{1, 1, 1}, Vec3{1, 0.3, 1}, Vec3{1, 0.3, 0.2}}) {
    EXPECT_EQ(code_of(view_of(mesh), {.degree = 8, .center = center}), ErrorCode::kInvalidInput);
  }
}

TEST(mesh_pass, asks_the_hooks_about_every_triangle_and_stops_when_one_is_none) {
  const Mesh mesh = bumpy_sphere(6);
  std::vector<int> checked(mesh.faces.size(), 0), released(mesh.faces.size(), 0);
  bool in_turn = true;
  const MeshPassOptions options{.degree = 4,
                                .precision = 1e-2,
                                .check =
                                    [&](std::size_t first, std::size_t n) {
                                      for (std::size_t t = first; t < first + n; ++t) ++checked[t];
                                      return true;
                                    },
                                .release =
                                    [&](std::size_t first, std::size_t n) {
                                      for (std::size_t t = first; t < first + n; ++t) {
                                        in_turn = in_turn && checked[t] > released[t];
                                        ++released[t];
                                      }
                                    }};
  const MeshPassResult result = mesh_pass(view_of(mesh), options, {.threads = 1});
  EXPECT_TRUE(in_turn);
  for (const int times : checked) EXPECT_EQ(times, result.report.passes);
  for (const std::size_t last : {0u, 50000u, 81919u}) {
    const MeshPassOptions refusing{.degree = 4, .check = [&](std::size_t first, std::size_t n) {
                                     return last < first || last >= first + n;
                                   }};
    EXPECT_EQ(code_of(view_of(mesh), refusing), ErrorCode::kInvalidInput);
  }
}

TEST(mesh_pass, can_be_cancelled_at_every_report_of_progress) {
  for (const double precision : {1e-2, 1e-8}) {
    // One case is lumped, the other has nodes for all triangles.
    const Mesh mesh = rough_sphere(precision > 1e-5 ? 6 : 5);
    const MeshPassOptions options{.degree = 20, .precision = precision};
    int calls = 0;
    double last = 0;
    bool rises = true;
    const Context counting{.threads = 1, .progress = [&](std::string_view, double fraction) {
                             ++calls;
                             rises = rises && fraction >= last && fraction <= 1;
                             last = fraction;
                             return true;
                           }};
    mesh_pass(view_of(mesh), options, counting);
    EXPECT_GT(calls, 4);
    EXPECT_TRUE(rises);
    const int all = calls;
    for (int stop = 1; stop <= all; stop += std::max(1, all / 8)) {
      calls = 0;
      const Context context{.threads = 2,
                            .progress = [&](std::string_view, double) { return ++calls < stop; }};
      EXPECT_EQ(code_of(view_of(mesh), options, context), ErrorCode::kCancelled) << stop;
    }
  }
}

}  // namespace
}  // namespace rholm
