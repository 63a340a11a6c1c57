#include "rholm/star.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::joined;
using test::moved;
using test::tetrahedron;

const Context kOneThread{.threads = 1, .progress = {}};

ChartOptions from_origin() { return {.center = {.kind = CenterKind::kNone, .point = {}}}; }

// From the middle of a cube of edge 2, every face plane is at 1 and every corner at sqrt(3).
TEST(check_star, of_a_cube_from_its_middle) {
  const StarReport report = check_star(box({2, 2, 2}, 3), {0, 0, 0}, 5000, kOneThread);
  EXPECT_EQ(report.min_d, 1);
  EXPECT_NEAR(report.min_cos_gamma, 1 / std::sqrt(3), 1e-15);
  EXPECT_EQ(report.bad_faces, 0u);
  EXPECT_TRUE(report.star_shaped);
  EXPECT_EQ(report.rays, 5000);
  EXPECT_EQ(report.once_share, 1);
}

TEST(check_star, a_centre_on_a_face_an_edge_or_a_corner_is_not_inside) {
  const Mesh mesh = box({2, 2, 2}, 1);
  EXPECT_EQ(check_star(mesh, {1, 0.1, 0.2}, 0).bad_faces, 2u);
  EXPECT_EQ(check_star(mesh, {1, 1, 0.2}, 0).bad_faces, 4u);
  const StarReport corner = check_star(mesh, {1, 1, 1}, 0);
  EXPECT_EQ(corner.bad_faces, 6u);
  EXPECT_EQ(corner.min_d, 0);
  EXPECT_EQ(corner.min_cos_gamma, 0);
  EXPECT_FALSE(corner.star_shaped);
}

TEST(check_star, outside_a_cube_one_face_turns_its_back) {
  const StarReport report = check_star(box({2, 2, 2}, 1), {3, 0, 0}, 1000);
  EXPECT_EQ(report.bad_faces, 2u);
  EXPECT_EQ(report.min_d, -2);
  // The nearest corner of that face is at sqrt(4 + 1 + 1).
  EXPECT_NEAR(report.min_cos_gamma, -2 / std::sqrt(6), 1e-15);
}

// The tube of the torus is half as wide as its centre line. From the middle, directions below
// asin(1/2) meet the torus twice, others never: the share is sin(30 degrees).
TEST(check_star, half_of_the_directions_meet_a_torus_twice_and_half_never) {
  const StarReport report = check_star(torus(2, 1, 200, 200), {0, 0, 0}, 20000, kOneThread);
  EXPECT_EQ(report.once_share, 0);
  EXPECT_NEAR(report.multiple_share, 0.5, 1e-3);  // polygons: relative 1 - cos(pi/200) = 1.2e-4
  EXPECT_NEAR(report.missed_share, 0.5, 1e-3);
}

TEST(check_star, shares_are_the_same_for_any_number_of_threads_and_at_any_scale) {
  const Mesh mesh = torus(2, 1, 30, 20);
  const StarReport one = check_star(mesh, {0.5, 0, 0}, 5000, kOneThread);
  for (const int threads : {2, 4}) {
    const StarReport other =
        check_star(mesh, {0.5, 0, 0}, 5000, {.threads = threads, .progress = {}});
    EXPECT_EQ(one.once_share, other.once_share);
    EXPECT_EQ(one.multiple_share, other.multiple_share);
  }
  const double scale = std::ldexp(1, 400);
  const StarReport huge =
      check_star(moved(mesh, {.scale = scale, .shift = {}}), {0.5 * scale, 0, 0}, 5000);
  EXPECT_EQ(one.multiple_share, huge.multiple_share);
  EXPECT_EQ(one.min_d, huge.min_d / scale);
}

TEST(check_star, refuses_a_centre_that_is_no_point_near_the_shape) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(check_star(tetrahedron(), {nan, 0, 0}, 0), Error);
  EXPECT_THROW(check_star(tetrahedron(), {1e17, 0, 0}, 0), Error);
  EXPECT_NO_THROW(check_star(tetrahedron(), {1e14, 0, 0}, 10));
}

// Two nested spheres face outwards: all d_T are positive, but every direction is covered twice.
TEST(check_star, nested_spheres_are_not_one_star) {
  const Mesh mesh = joined(icosphere(2), moved(icosphere(2), {.scale = 0.5, .shift = {}}));
  const StarReport report = check_star(mesh, {0, 0, 0}, 1000);
  EXPECT_EQ(report.bad_faces, 0u);
  EXPECT_FALSE(report.star_shaped);
  EXPECT_EQ(report.multiple_share, 1);
}

TEST(find_center, without_a_kernel_falls_back_to_the_centre_that_sees_more_once) {
  const StarReport report =
      find_center(torus(2, 0.5, 40, 20), {.kind = CenterKind::kAuto, .point = {}, .rays = 2000});
  EXPECT_FALSE(report.star_shaped);
  EXPECT_TRUE(report.center_fell_back);
  EXPECT_GT(report.bad_faces, 0u);
  const StarReport cosine =
      find_center(torus(2, 0.5, 40, 20), {.kind = CenterKind::kCosine, .point = {}, .rays = 2000});
  EXPECT_EQ(cosine.center, report.center);
  EXPECT_GE(report.once_share, check_star(torus(2, 0.5, 40, 20), {0, 0, 0}, 2000).once_share);
}

TEST(find_center, refuses_meshes_without_a_surface) {
  const Mesh flat{.vertices = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}},
                  .faces = {{0, 1, 2}, {2, 1, 0}},
                  .attributes = {}};
  EXPECT_THROW(find_center(flat, {}), Error);
  EXPECT_THROW(find_center(Mesh{}, {}), Error);
  Mesh bad = tetrahedron();
  bad.vertices[0].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(find_center(bad, {}), Error);
}

TEST(find_center, of_one_triangle_is_finite) {
  const Mesh one{
      .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}, .attributes = {}};
  for (const CenterKind kind : {CenterKind::kAuto, CenterKind::kSlope, CenterKind::kCosine}) {
    const StarReport report = find_center(one, {.kind = kind, .point = {}, .rays = 100});
    EXPECT_TRUE(is_finite(report.center));
    EXPECT_FALSE(report.star_shaped);
  }
}

TEST(find_center, can_be_cancelled) {
  const Context context{.threads = 1, .progress = [](std::string_view, double) { return false; }};
  EXPECT_THROW(find_center(icosphere(2), {}, context), Error);
}

TEST(make_star_chart, moves_the_centre_to_the_origin_and_drops_attributes) {
  Mesh mesh = moved(tetrahedron(), {.shift = {1, 2, 3}});
  mesh.attributes = {{.name = "red", .values = {1, 2, 3, 4}}};
  const StarChart chart = make_star_chart(mesh);
  EXPECT_TRUE(chart.report.star_shaped);
  EXPECT_EQ(chart.report.once_share, 1);
  EXPECT_EQ(chart.edges.size(), 6u);
  EXPECT_EQ(chart.mesh.faces, mesh.faces);
  EXPECT_TRUE(chart.mesh.attributes.empty());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(chart.mesh.vertices[i], mesh.vertices[i] - chart.report.center);
  }
}

// A vertex splits an edge in one of its faces, and a triangle without area closes the gap.
TEST(make_star_chart, passes_over_triangles_without_area) {
  Mesh mesh = box({2, 2, 2}, 1);
  const Edge edge = pair_edges(mesh).front();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[edge.a] + mesh.vertices[edge.b]));
  Triangle& left = mesh.faces[edge.left];
  Triangle second = left;
  for (int k = 0; k < 3; ++k) {
    if (left[k] == edge.b) left[k] = middle;
    if (second[k] == edge.a) second[k] = middle;
  }
  mesh.faces.push_back(second);
  mesh.faces.push_back({edge.a, edge.b, middle});
  ASSERT_EQ(inspect(mesh).degenerate_faces, 1u);
  const StarChart chart = make_star_chart(mesh);
  EXPECT_NEAR(chart.report.min_d, 1, 1e-11);
  EXPECT_TRUE(chart.report.star_shaped);
}

std::string refusal(const Mesh& mesh, ErrorCode code, const ChartOptions& options = {}) {
  try {
    make_star_chart(mesh, options);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' in: " << text;
  }
}

TEST(make_star_chart, refuses_what_is_not_a_star_with_the_figures_and_the_way_out) {
  ChartOptions options = from_origin();
  options.center.rays = 1000;
  const std::string text = refusal(torus(2, 1, 30, 20), ErrorCode::kNotStarShaped, options);
  expect_words(text, {"not star-shaped", "(0, 0, 0)", "min d", "cos gamma", "faces",
                      "of 1000 directions", "atlas of caps", "any shape"});
  EXPECT_EQ(text.find("sum of the radii"), std::string::npos);
}

TEST(make_star_chart, says_when_there_are_several_components) {
  const Mesh nested = joined(icosphere(2), moved(icosphere(2), {.scale = 0.5, .shift = {}}));
  expect_words(refusal(nested, ErrorCode::kNotStarShaped), {"2 components", "100 %"});
  const Mesh apart = joined(icosphere(2), moved(icosphere(2), {.shift = {3, 0, 0}}));
  expect_words(refusal(apart, ErrorCode::kNotStarShaped), {"2 components"});
}

TEST(make_star_chart, refuses_open_inward_and_misoriented_meshes) {
  Mesh open = icosphere(1);
  open.faces.pop_back();
  expect_words(refusal(open, ErrorCode::kInvalidInput), {"3 boundary edges", "rholm repair"});
  Mesh inward = icosphere(1);
  flip(inward);
  expect_words(refusal(inward, ErrorCode::kInvalidInput), {"inside out", "rholm repair"});
  ChartOptions signed_sum;
  signed_sum.allow_signed = true;
  expect_words(refusal(inward, ErrorCode::kInvalidInput, signed_sum), {"inside out"});
  Mesh turned = icosphere(1);
  std::swap(turned.faces[0][0], turned.faces[0][1]);
  expect_words(refusal(turned, ErrorCode::kInvalidInput), {"opposite orientation"});
  refusal(Mesh{}, ErrorCode::kInvalidInput);
}

TEST(make_star_chart, accepts_the_alternating_sum_when_asked) {
  ChartOptions options = from_origin();
  options.allow_signed = true;
  options.center.rays = 1000;
  const StarChart chart = make_star_chart(torus(2, 1, 30, 20), options);
  EXPECT_FALSE(chart.report.star_shaped);
  EXPECT_GT(chart.report.bad_faces, 0u);
  EXPECT_EQ(chart.report.rays, 1000);
  EXPECT_NEAR(chart.report.multiple_share, 0.5, 0.05);
}

}  // namespace
}  // namespace rholm
