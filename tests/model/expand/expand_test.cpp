#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"
#include "rholm/synthesize.h"
#include "support/oracle.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

ErrorCode code_of(const Mesh& mesh, const ExpandOptions& options = {}) {
  try {
    expand(mesh, options);
  } catch (const Error& error) {
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return error.code();
  }
  ADD_FAILURE() << "not refused";
  return ErrorCode::kIo;
}

// Returns triangles with their own vertices, as in an STL file.
Mesh soup_of(const Mesh& mesh) {
  Mesh soup;
  for (const Triangle& t : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t i : t) soup.vertices.push_back(mesh.vertices[i]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(expand, a_soup_of_triangles_gives_the_coefficients_of_the_welded_mesh) {
  const Mesh mesh = bumpy_sphere(2);
  // The fast engine treats identical vertices as one in place; the direct engine joins them.
  for (const Engine engine : {Engine::kFast, Engine::kDirect}) {
    const ExpandOptions options{.degree = 12, .engine = engine, .precision = 1e-13};
    const Expanded whole = expand(mesh, options), soup = expand(soup_of(mesh), options);
    EXPECT_EQ(soup.edges, 3 * mesh.faces.size() / 2);
    if (engine == Engine::kDirect) {
      EXPECT_EQ(soup.vertices, mesh.vertices.size());
      EXPECT_EQ(soup.merged_vertices, 3 * mesh.faces.size() - mesh.vertices.size());
    }
    const auto a = whole.transform.expansion.coefficients.values();
    const auto b = soup.transform.expansion.coefficients.values();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
    EXPECT_NEAR(*whole.transform.expansion.tail_strength, *soup.transform.expansion.tail_strength,
                1e-12 * *whole.transform.expansion.tail_strength);
  }
}

// Arrays of floats with other data between the rows, as other programs have them.
struct Records {
  struct Vertex {
    float x, y, z, quality;
  };
  struct Face {
    std::uint8_t flags[5];
    Triangle corners;
  };
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
  explicit Records(const Mesh& mesh) {
    for (const Vec3& v : mesh.vertices) {
      vertices.push_back({float(v.x), float(v.y), float(v.z), NAN});
    }
    for (const Triangle& t : mesh.faces) faces.push_back({{}, t});
  }
  MeshView view() const {
    return {.vertices = reinterpret_cast<const std::byte*>(vertices.data()),
            .n_vertices = vertices.size(),
            .vertex_stride = sizeof(Vertex),
            .coordinate = ScalarType::kFloat32,
            .faces = reinterpret_cast<const std::byte*>(faces.data()) + offsetof(Face, corners),
            .n_faces = faces.size(),
            .face_stride = sizeof(Face)};
  }
};

TEST(expand, arrays_of_another_program_give_the_bits_of_the_mesh_they_hold) {
  Mesh upside_down = bumpy_sphere(2);
  flip(upside_down);  // must be copied and flipped
  for (const Mesh& mesh : {bumpy_sphere(2), upside_down}) {
    const Records records(mesh);
    const Mesh same = mesh_of(records.view());
    EXPECT_EQ(same.faces, mesh.faces);
    EXPECT_EQ(same.vertices[5].x, float(mesh.vertices[5].x));
    const Expanded a = expand(same, {.degree = 12});
    const Expanded b = expand(records.view(), {.degree = 12});
    EXPECT_EQ(a.flipped, b.flipped);
    const auto x = a.transform.expansion.coefficients.values();
    const auto y = b.transform.expansion.coefficients.values();
    EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end()));
  }
}

TEST(expand, refuses_a_view_with_an_index_out_of_range) {
  Records records(bumpy_sphere(1));
  records.faces[3].corners[1] = 1u << 31;
  EXPECT_THROW(expand(records.view()), Error);
}

// The fast engine uses the mesh in place; the direct engine uses a chart.
TEST(expand, finds_the_same_degree_for_a_tolerance_on_both_ways) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    ExpandOptions options;
    options.tolerance = Tolerance{.error = 1e-2, .norm = norm};
    const Expanded fast = expand(mesh, options);
    options.engine = Engine::kDirect;
    const Expanded direct = expand(mesh, options);
    ASSERT_TRUE(fast.tolerance && direct.tolerance);
    EXPECT_TRUE(fast.tolerance->met);
    EXPECT_EQ(fast.transform.expansion.coefficients.degree(),
              direct.transform.expansion.coefficients.degree());
    EXPECT_NEAR(fast.tolerance->reached, direct.tolerance->reached,
                1e-4 * direct.tolerance->reached);
    EXPECT_LE(norm == ErrorNorm::kRms ? *fast.transform.expansion.errors->rms
                                      : *fast.transform.expansion.errors->measured_max,
              fast.tolerance->allowed);
  }
}

// A search for a degree returns the same model as this degree given directly.
TEST(expand, a_tolerance_gives_the_bits_of_the_degree_it_finds) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.3));
  for (const Tolerance& tolerance :
       {Tolerance{.error = 0.02, .norm = ErrorNorm::kMax},
        Tolerance{.error = 5e-3, .measure = ErrorMeasure::kDistance},
        Tolerance{.error = 0.02, .norm = ErrorNorm::kMax, .measure = ErrorMeasure::kDistance}}) {
    const Expanded found = expand(mesh, {.tolerance = tolerance});
    const Expansion& expansion = found.transform.expansion;
    const Expanded same = expand(mesh, {.degree = expansion.coefficients.degree()});
    const auto a = expansion.coefficients.values();
    const auto b = same.transform.expansion.coefficients.values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    ASSERT_TRUE(expansion.errors && same.transform.expansion.errors);
    EXPECT_EQ(expansion.errors->rms, same.transform.expansion.errors->rms);
    EXPECT_EQ(expansion.errors->measured_max, same.transform.expansion.errors->measured_max);
    EXPECT_EQ(expansion.errors->distance_rms, same.transform.expansion.errors->distance_rms);
    EXPECT_EQ(expansion.errors->predicted_max, same.transform.expansion.errors->predicted_max);
    EXPECT_EQ(expansion.errors->points, same.transform.expansion.errors->points);
    EXPECT_EQ(expansion.errors->diagonal, same.transform.expansion.errors->diagonal);
  }
}

// The search itself uses the fast sums.
TEST(expand, a_tolerance_ends_with_the_method_that_was_asked_for) {
  const Mesh mesh = test::rotated(bumpy_sphere(2, 0.3));
  ExpandOptions options{.method = Method::kArea, .precision = 1e-6};
  options.tolerance = Tolerance{.error = 0.03, .norm = ErrorNorm::kMax};
  const Expanded found = expand(mesh, options);
  ASSERT_TRUE(found.tolerance->met);
  options.degree = found.transform.expansion.coefficients.degree();
  options.tolerance.reset();
  const Expanded same = expand(mesh, options);
  EXPECT_EQ(found.transform.expansion.method, "area");
  const auto a = found.transform.expansion.coefficients.values();
  const auto b = same.transform.expansion.coefficients.values();
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(expand, without_errors_a_tolerance_leaves_none) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  const Tolerance tolerance{.error = 0.02, .norm = ErrorNorm::kMax};
  const Expanded expanded = expand(mesh, {.tolerance = tolerance, .errors = false});
  EXPECT_TRUE(expanded.tolerance->met);
  EXPECT_FALSE(expanded.transform.expansion.errors);
}

// Compares first-order distances with exact closest points.
TEST(expand, distances_in_a_model_are_those_of_an_independent_comparison) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.3));
  const Expanded expanded = expand(mesh, {.degree = 12});
  const Mesh surface = synthesize(expanded.transform.expansion, icosphere(6));
  const Comparison comparison = compare(mesh, surface, {.samples = 100000});
  const TruncationErrors& errors = *expanded.transform.expansion.errors;
  const double rms = std::max(comparison.a_to_b.rms, comparison.b_to_a.rms);
  EXPECT_NEAR(*errors.distance_rms, rms, 0.03 * rms);
  // The largest distance of random samples is a lower bound.
  EXPECT_LT(comparison.hausdorff, 1.02 * *errors.measured_max_distance);
  EXPECT_GT(comparison.hausdorff, 0.8 * *errors.measured_max_distance);
}

TEST(expand, leaves_errors_out_when_told_and_where_they_mean_nothing) {
  EXPECT_FALSE(expand(bumpy_sphere(2), {.degree = 4, .errors = false})
                   .transform.expansion.errors.has_value());
  ExpandOptions folded{.degree = 4};
  folded.chart.allow_signed = true;
  folded.chart.center = {.kind = CenterKind::kGiven, .point = {2, 0.5, 0.1}};
  const Expanded prism = expand(test::l_prism(1), folded);
  EXPECT_FALSE(prism.transform.expansion.errors.has_value());
}

// The direct engine uses a chart.
TEST(expand, surfaces_that_fold_are_the_same_as_by_a_chart) {
  ExpandOptions folded{.degree = 12, .precision = 1e-8};
  folded.chart.allow_signed = true;
  folded.chart.center = {.kind = CenterKind::kGiven, .point = {2, 0.5, 0.1}, .rays = 2000};
  const Expanded fast = expand(test::l_prism(1), folded);
  folded.engine = Engine::kDirect;
  const Expanded slow = expand(test::l_prism(1), folded);
  EXPECT_LT(test::relative_error(fast.transform.expansion.coefficients,
                                 slow.transform.expansion.coefficients),
            2e-8);
  EXPECT_FALSE(fast.star.star_shaped);
  EXPECT_EQ(fast.star.bad_faces, slow.star.bad_faces);
  EXPECT_EQ(fast.star.multiple_share, slow.star.multiple_share);
  EXPECT_GT(fast.star.multiple_share, 0);
  EXPECT_NEAR(fast.star.min_d, slow.star.min_d, 1e-14);
  EXPECT_FALSE(fast.transform.expansion.norm_squared.has_value());
  EXPECT_TRUE(fast.times.contains("rays"));
  EXPECT_FALSE(fast.times.contains("topology"));
  EXPECT_EQ(fast.edges, slow.edges);
}

// The better of two centres is used; neither sees the whole surface.
TEST(expand, surfaces_without_a_kernel_are_the_same_as_by_a_chart) {
  ExpandOptions folded{.degree = 12, .precision = 1e-8};
  folded.chart.allow_signed = true;
  folded.chart.center.rays = 2000;
  for (const Mesh& mesh : {test::l_prism(1), test::rotated(torus(2, 0.5, 40, 20))}) {
    folded.engine = Engine::kFast;
    const Expanded fast = expand(mesh, folded);
    folded.engine = Engine::kDirect;
    const Expanded slow = expand(mesh, folded);
    EXPECT_LT(test::relative_error(fast.transform.expansion.coefficients,
                                   slow.transform.expansion.coefficients),
              2e-8);
    EXPECT_EQ(fast.star.once_share, slow.star.once_share);
    EXPECT_EQ(fast.star.bad_faces, slow.star.bad_faces);
    EXPECT_EQ(fast.star.center_fell_back, slow.star.center_fell_back);
    EXPECT_LT(norm(fast.star.center - slow.star.center), 1e-12);
    EXPECT_FALSE(fast.times.contains("topology"));
  }
}

TEST(expand, turns_a_mesh_right_side_out) {
  Mesh mesh = bumpy_sphere(2);
  const Expanded outward = expand(mesh, {.degree = 6, .precision = 1e-13});
  flip(mesh);
  const Expanded inward = expand(mesh, {.degree = 6, .precision = 1e-13});
  EXPECT_FALSE(outward.flipped);
  EXPECT_TRUE(inward.flipped);
  const auto a = outward.transform.expansion.coefficients.values();
  const auto b = inward.transform.expansion.coefficients.values();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
}

TEST(expand, refuses_what_has_no_coefficients_with_a_code_and_words) {
  EXPECT_EQ(code_of({}), ErrorCode::kInvalidInput);
  Mesh one;
  one.vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  one.faces = {{0, 1, 2}};
  EXPECT_EQ(code_of(one), ErrorCode::kInvalidInput);
  Mesh open = icosphere(2);
  open.faces.pop_back();
  EXPECT_EQ(code_of(open), ErrorCode::kInvalidInput);
  Mesh misoriented = icosphere(2);
  std::swap(misoriented.faces[5][0], misoriented.faces[5][1]);
  EXPECT_EQ(code_of(misoriented), ErrorCode::kInvalidInput);
  Mesh nan = icosphere(1);
  nan.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(nan), ErrorCode::kInvalidInput);
  EXPECT_EQ(code_of(torus(1, 0.3, 24, 12)), ErrorCode::kNotStarShaped);
  ExpandOptions on_face{.chart = {.center = {.kind = CenterKind::kGiven, .point = {1, 0, 0}}}};
  EXPECT_EQ(code_of(box({2, 2, 2}), on_face), ErrorCode::kNotStarShaped);
  for (const Tolerance& wrong :
       {Tolerance{}, Tolerance{.error = -1}, Tolerance{.error = 0.1, .max_degree = -1}}) {
    EXPECT_EQ(code_of(icosphere(2), {.tolerance = wrong}), ErrorCode::kInvalidInput);
  }
}

TEST(expand, tells_its_stages_and_can_be_cancelled) {
  const Expanded expanded = expand(icosphere(3), {.degree = 8});
  for (const char* stage : {"center", "transform"}) {
    ASSERT_EQ(expanded.times.count(stage), 1u);
    EXPECT_GE(expanded.times.at(stage).wall, 0);
    EXPECT_GE(expanded.times.at(stage).cpu, 0);
  }
  const Context stop{
      .progress = [](std::string_view stage, double) { return stage != "transform"; }};
  EXPECT_THROW(expand(icosphere(3), {.degree = 8}, stop), Error);
}

}  // namespace
}  // namespace rholm
