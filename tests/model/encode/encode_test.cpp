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

ErrorCode code_of(const Mesh& mesh, const EncodeOptions& options = {}) {
  try {
    encode(mesh, options);
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
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t i : t) soup.vertices.push_back(mesh.vertices[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(encode, a_soup_of_triangles_gives_the_coefficients_of_the_welded_mesh) {
  const Mesh mesh = bumpy_sphere(2);
  // The fast engine treats identical vertices as one in place; the direct engine joins them.
  for (const Engine engine : {Engine::kFast, Engine::kDirect}) {
    const EncodeOptions options{.analyze = {.degree = 12, .engine = engine, .precision = 1e-13}};
    const Encoded whole = encode(mesh, options), soup = encode(soup_of(mesh), options);
    EXPECT_EQ(soup.edges, 3 * mesh.triangles.size() / 2);
    if (engine == Engine::kDirect) {
      EXPECT_EQ(soup.vertices, mesh.vertices.size());
      EXPECT_EQ(soup.merged_vertices, 3 * mesh.triangles.size() - mesh.vertices.size());
    }
    const auto a = whole.analysis.expansion.coefficients.values();
    const auto b = soup.analysis.expansion.coefficients.values();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
    EXPECT_NEAR(*whole.analysis.expansion.tail_strength, *soup.analysis.expansion.tail_strength,
                1e-12 * *whole.analysis.expansion.tail_strength);
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
    for (const Triangle& t : mesh.triangles) faces.push_back({{}, t});
  }
  MeshView view() const {
    return {.vertices = reinterpret_cast<const std::byte*>(vertices.data()),
            .n_vertices = vertices.size(),
            .vertex_stride = sizeof(Vertex),
            .coordinate = ScalarType::kFloat32,
            .triangles = reinterpret_cast<const std::byte*>(faces.data()) + offsetof(Face, corners),
            .n_triangles = faces.size(),
            .triangle_stride = sizeof(Face)};
  }
};

TEST(encode, arrays_of_another_program_give_the_bits_of_the_mesh_they_hold) {
  Mesh upside_down = bumpy_sphere(2);
  flip(upside_down);  // must be copied and flipped
  for (const Mesh& mesh : {bumpy_sphere(2), upside_down}) {
    const Records records(mesh);
    const Mesh same = mesh_of(records.view());
    EXPECT_EQ(same.triangles, mesh.triangles);
    EXPECT_EQ(same.vertices[5].x, float(mesh.vertices[5].x));
    const Encoded a = encode(same, {.analyze = {.degree = 12}});
    const Encoded b = encode(records.view(), {.analyze = {.degree = 12}});
    EXPECT_EQ(a.flipped, b.flipped);
    const auto x = a.analysis.expansion.coefficients.values();
    const auto y = b.analysis.expansion.coefficients.values();
    EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end()));
  }
}

TEST(encode, refuses_a_view_with_an_index_out_of_range) {
  Records records(bumpy_sphere(1));
  records.faces[3].corners[1] = 1u << 31;
  EXPECT_THROW(encode(records.view()), Error);
}

// The fast engine uses the mesh in place; the direct engine uses a chart.
TEST(encode, finds_the_same_degree_for_a_tolerance_on_both_ways) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    EncodeOptions options;
    options.tolerance = Tolerance{.error = 1e-2, .norm = norm};
    const Encoded fast = encode(mesh, options);
    options.analyze.engine = Engine::kDirect;
    const Encoded direct = encode(mesh, options);
    ASSERT_TRUE(fast.tolerance && direct.tolerance);
    EXPECT_TRUE(fast.tolerance->met);
    EXPECT_EQ(fast.analysis.expansion.coefficients.degree(),
              direct.analysis.expansion.coefficients.degree());
    EXPECT_NEAR(fast.tolerance->reached, direct.tolerance->reached,
                1e-4 * direct.tolerance->reached);
    EXPECT_LE(norm == ErrorNorm::kRms ? *fast.analysis.expansion.errors->rms
                                      : *fast.analysis.expansion.errors->measured_max,
              fast.tolerance->allowed);
  }
}

// A search for a degree returns the same model as this degree given directly.
TEST(encode, a_tolerance_gives_the_bits_of_the_degree_it_finds) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.3));
  for (const Tolerance& tolerance :
       {Tolerance{.error = 0.02, .norm = ErrorNorm::kMax},
        Tolerance{.error = 5e-3, .measure = ErrorMeasure::kDistance},
        Tolerance{.error = 0.02, .norm = ErrorNorm::kMax, .measure = ErrorMeasure::kDistance}}) {
    const Encoded found = encode(mesh, {.tolerance = tolerance});
    const Expansion& expansion = found.analysis.expansion;
    const Encoded same = encode(mesh, {.analyze = {.degree = expansion.coefficients.degree()}});
    const auto a = expansion.coefficients.values();
    const auto b = same.analysis.expansion.coefficients.values();
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    ASSERT_TRUE(expansion.errors && same.analysis.expansion.errors);
    EXPECT_EQ(expansion.errors->rms, same.analysis.expansion.errors->rms);
    EXPECT_EQ(expansion.errors->measured_max, same.analysis.expansion.errors->measured_max);
    EXPECT_EQ(expansion.errors->distance_rms, same.analysis.expansion.errors->distance_rms);
    EXPECT_EQ(expansion.errors->predicted_max, same.analysis.expansion.errors->predicted_max);
    EXPECT_EQ(expansion.errors->points, same.analysis.expansion.errors->points);
    EXPECT_EQ(expansion.errors->diagonal, same.analysis.expansion.errors->diagonal);
  }
}

// The search itself uses the fast sums.
TEST(encode, a_tolerance_ends_with_the_method_that_was_asked_for) {
  const Mesh mesh = test::rotated(bumpy_sphere(2, 0.3));
  EncodeOptions options{.analyze = {.method = Method::kArea, .precision = 1e-6}};
  options.tolerance = Tolerance{.error = 0.03, .norm = ErrorNorm::kMax};
  const Encoded found = encode(mesh, options);
  ASSERT_TRUE(found.tolerance->met);
  options.analyze.degree = found.analysis.expansion.coefficients.degree();
  options.tolerance.reset();
  const Encoded same = encode(mesh, options);
  EXPECT_EQ(found.analysis.expansion.method, "area");
  const auto a = found.analysis.expansion.coefficients.values();
  const auto b = same.analysis.expansion.coefficients.values();
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST(encode, without_errors_a_tolerance_leaves_none) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  const Tolerance tolerance{.error = 0.02, .norm = ErrorNorm::kMax};
  const Encoded encoded = encode(mesh, {.tolerance = tolerance, .errors = false});
  EXPECT_TRUE(encoded.tolerance->met);
  EXPECT_FALSE(encoded.analysis.expansion.errors);
}

// Compares first-order distances with exact closest points.
TEST(encode, distances_in_a_model_are_those_of_an_independent_comparison) {
  const Mesh mesh = test::rotated(bumpy_sphere(3, 0.3));
  const Encoded encoded = encode(mesh, {.analyze = {.degree = 12}});
  const Mesh surface = synthesize(encoded.analysis.expansion, icosphere(6));
  const Comparison comparison = compare(mesh, surface, {.samples = 100000});
  const TruncationErrors& errors = *encoded.analysis.expansion.errors;
  const double rms = std::max(comparison.a_to_b.rms, comparison.b_to_a.rms);
  EXPECT_NEAR(*errors.distance_rms, rms, 0.03 * rms);
  // The largest distance of random samples is a lower bound.
  EXPECT_LT(comparison.hausdorff, 1.02 * *errors.measured_max_distance);
  EXPECT_GT(comparison.hausdorff, 0.8 * *errors.measured_max_distance);
}

TEST(encode, leaves_errors_out_when_told_and_where_they_mean_nothing) {
  EXPECT_FALSE(encode(bumpy_sphere(2), {.analyze = {.degree = 4}, .errors = false})
                   .analysis.expansion.errors.has_value());
  EncodeOptions folded{.analyze = {.degree = 4}};
  folded.chart.allow_signed = true;
  folded.chart.center = {.kind = CenterKind::kGiven, .point = {2, 0.5, 0.1}};
  const Encoded prism = encode(test::l_prism(1), folded);
  EXPECT_FALSE(prism.analysis.expansion.errors.has_value());
}

// The direct engine uses a chart.
TEST(encode, surfaces_that_fold_are_the_same_as_by_a_chart) {
  EncodeOptions folded{.analyze = {.degree = 12, .precision = 1e-8}};
  folded.chart.allow_signed = true;
  folded.chart.center = {.kind = CenterKind::kGiven, .point = {2, 0.5, 0.1}, .rays = 2000};
  const Encoded fast = encode(test::l_prism(1), folded);
  folded.analyze.engine = Engine::kDirect;
  const Encoded slow = encode(test::l_prism(1), folded);
  EXPECT_LT(test::relative_error(fast.analysis.expansion.coefficients,
                                 slow.analysis.expansion.coefficients),
            2e-8);
  EXPECT_FALSE(fast.star.star_shaped);
  EXPECT_EQ(fast.star.bad_triangles, slow.star.bad_triangles);
  EXPECT_EQ(fast.star.multiple_share, slow.star.multiple_share);
  EXPECT_GT(fast.star.multiple_share, 0);
  EXPECT_NEAR(fast.star.min_d, slow.star.min_d, 1e-14);
  EXPECT_FALSE(fast.analysis.expansion.norm_squared.has_value());
  EXPECT_TRUE(fast.times.contains("rays"));
  EXPECT_FALSE(fast.times.contains("topology"));
  EXPECT_EQ(fast.edges, slow.edges);
}

// The better of two centres is used; neither sees the whole surface.
TEST(encode, surfaces_without_a_kernel_are_the_same_as_by_a_chart) {
  EncodeOptions folded{.analyze = {.degree = 12, .precision = 1e-8}};
  folded.chart.allow_signed = true;
  folded.chart.center.rays = 2000;
  for (const Mesh& mesh : {test::l_prism(1), test::rotated(torus(2, 0.5, 40, 20))}) {
    folded.analyze.engine = Engine::kFast;
    const Encoded fast = encode(mesh, folded);
    folded.analyze.engine = Engine::kDirect;
    const Encoded slow = encode(mesh, folded);
    EXPECT_LT(test::relative_error(fast.analysis.expansion.coefficients,
                                   slow.analysis.expansion.coefficients),
              2e-8);
    EXPECT_EQ(fast.star.once_share, slow.star.once_share);
    EXPECT_EQ(fast.star.bad_triangles, slow.star.bad_triangles);
    EXPECT_EQ(fast.star.center_fell_back, slow.star.center_fell_back);
    EXPECT_LT(norm(fast.star.center - slow.star.center), 1e-12);
    EXPECT_FALSE(fast.times.contains("topology"));
  }
}

TEST(encode, turns_a_mesh_right_side_out) {
  Mesh mesh = bumpy_sphere(2);
  const Encoded outward = encode(mesh, {.analyze = {.degree = 6, .precision = 1e-13}});
  flip(mesh);
  const Encoded inward = encode(mesh, {.analyze = {.degree = 6, .precision = 1e-13}});
  EXPECT_FALSE(outward.flipped);
  EXPECT_TRUE(inward.flipped);
  const auto a = outward.analysis.expansion.coefficients.values();
  const auto b = inward.analysis.expansion.coefficients.values();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-13);
}

TEST(encode, refuses_what_has_no_coefficients_with_a_code_and_words) {
  EXPECT_EQ(code_of({}), ErrorCode::kInvalidInput);
  Mesh one;
  one.vertices = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  one.triangles = {{0, 1, 2}};
  EXPECT_EQ(code_of(one), ErrorCode::kInvalidInput);
  Mesh open = icosphere(2);
  open.triangles.pop_back();
  EXPECT_EQ(code_of(open), ErrorCode::kInvalidInput);
  Mesh misoriented = icosphere(2);
  std::swap(misoriented.triangles[5][0], misoriented.triangles[5][1]);
  EXPECT_EQ(code_of(misoriented), ErrorCode::kInvalidInput);
  Mesh nan = icosphere(1);
  nan.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of(nan), ErrorCode::kInvalidInput);
  EXPECT_EQ(code_of(torus(1, 0.3, 24, 12)), ErrorCode::kNotStarShaped);
  EncodeOptions on_face{.chart = {.center = {.kind = CenterKind::kGiven, .point = {1, 0, 0}}}};
  EXPECT_EQ(code_of(box({2, 2, 2}), on_face), ErrorCode::kNotStarShaped);
  for (const Tolerance& wrong :
       {Tolerance{}, Tolerance{.error = -1}, Tolerance{.error = 0.1, .max_degree = -1}}) {
    EXPECT_EQ(code_of(icosphere(2), {.tolerance = wrong}), ErrorCode::kInvalidInput);
  }
}

TEST(encode, tells_its_stages_and_can_be_cancelled) {
  const Encoded encoded = encode(icosphere(3), {.analyze = {.degree = 8}});
  for (const char* stage : {"center", "transform"}) {
    ASSERT_EQ(encoded.times.count(stage), 1u);
    EXPECT_GE(encoded.times.at(stage).wall, 0);
    EXPECT_GE(encoded.times.at(stage).cpu, 0);
  }
  const Context stop{
      .progress = [](std::string_view stage, double) { return stage != "transform"; }};
  EXPECT_THROW(encode(icosphere(3), {.analyze = {.degree = 8}}, stop), Error);
}

}  // namespace
}  // namespace rholm
