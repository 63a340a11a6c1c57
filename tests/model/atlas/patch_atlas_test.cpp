// The paper's atlas. The oracle is the sphere on which the points lie.
#include "rholm/patch_atlas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "reconstruct/points/oriented_points.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/test_points.h"

namespace rholm {
namespace {

double largest_error(const Mesh& surface) {
  double largest = 0;
  for (const Vec3& v : surface.vertices) largest = std::max(largest, std::abs(norm(v) - 1));
  return largest;
}

// Every patch of a sphere lies on that sphere. Only the sagitta of triangles is left to expand, at
// most 2 pi / 3000 sqrt(3) / 2 of the radius, which also has a jump at the border.
TEST(patch_atlas, a_sphere_extended_by_itself_is_the_sphere) {
  const PointCloud cloud = test::sphere_points(3000);
  const PatchAtlas made =
      patch_atlas(cloud, {.degree = 12, .extension = CapExtension::kSphere, .min_cosine = 0.6});
  EXPECT_LT(largest_error(made.surface), 4e-3);
  EXPECT_LT(made.rms_along_rays, 2e-3);
  EXPECT_EQ(inspect(made.surface).boundary_edges, 0U);
}

// At the border of the points the series of the zero extension is half the radius. For this reason
// integrals do not give a surface.
TEST(patch_atlas, zero_beyond_the_points_costs_a_large_part_of_the_radius) {
  const PointCloud cloud = test::sphere_points(3000);
  const PatchAtlas made = patch_atlas(cloud, {.degree = 24, .min_cosine = 0.6});
  EXPECT_GT(made.rms_along_rays, 0.02);
  EXPECT_LT(made.rms_along_rays, 0.5);
  EXPECT_EQ(made.model.atlas.blend, CapBlend::kSpline);
  EXPECT_EQ(made.model.atlas.caps.front().degree, 24);
}

// The patches of a sphere are seen from its middle. Their triangles cover the sphere except for
// gaps between patches, and lie on it with and without projection.
TEST(patch_atlas, pictures_of_the_steps_lie_on_the_sphere) {
  PointCloud cloud = test::sphere_points(3000);
  for (Vec3& p : cloud.points) p = 8.0 * p + Vec3{100, 0, 0};
  for (const PatchView view : {PatchView::kPatches, PatchView::kTriangles, PatchView::kSpheres}) {
    const PatchPicture picture = patch_picture(cloud, view, {.min_cosine = 0.6});
    EXPECT_GT(picture.patches, 8U);
    double area = 0;
    for (const Triangle& t : picture.mesh.faces) {
      const Vec3 &a = picture.mesh.vertices[t[0]], &b = picture.mesh.vertices[t[1]],
                 &c = picture.mesh.vertices[t[2]];
      const Vec3 twice = cross(b - a, c - a);
      EXPECT_GT(dot(twice, a - Vec3{100, 0, 0}), 0);
      area += norm(twice) / 2;
    }
    const bool apart = view == PatchView::kTriangles;
    // Separated triangles have 0.85 of their size and lie inside the sphere by a part of their
    // sagitta.
    const double whole = 4 * 3.1415926536 * 64 * (apart ? 0.85 * 0.85 : 1);
    EXPECT_LT(area, whole);
    EXPECT_GT(area, 0.75 * whole);
    for (const Vec3& v : picture.mesh.vertices) {
      EXPECT_NEAR(norm(v - Vec3{100, 0, 0}), 8, apart ? 0.2 : 1e-9);
    }
    ASSERT_EQ(picture.mesh.attributes.size(), 3U);
    EXPECT_EQ(picture.mesh.attributes[0].values.size(), picture.mesh.vertices.size());
    EXPECT_EQ(picture.mesh.vertices.size() == 3 * picture.mesh.faces.size(), apart);
    EXPECT_EQ(parse_name<PatchView>(to_string(view)), view);
  }
}

// Where points do not lie on the sphere of their patch, the picture moves them there: all points of
// a patch get the same distance r from its centre.
TEST(patch_atlas, spheres_are_those_that_fit_best) {
  const Mesh mesh = ellipsoid({3, 2, 1}, 4);
  const PatchPicture points = patch_picture(mesh, PatchView::kPatches);
  const PatchPicture spheres = patch_picture(mesh, PatchView::kSpheres);
  ASSERT_EQ(points.mesh.faces, spheres.mesh.faces);
  double largest = 0;
  for (std::size_t i = 0; i < points.mesh.vertices.size(); ++i) {
    largest = std::max(largest, norm(points.mesh.vertices[i] - spheres.mesh.vertices[i]));
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(largest, 0.3);
}

TEST(set_degree_colors, higher_degrees_are_lighter) {
  Atlas atlas;
  for (const int degree : {8, 2, 14, 5}) {
    atlas.caps.emplace_back().degree = static_cast<std::uint16_t>(degree);
  }
  std::vector<Attribute> colors = {{"red", ScalarType::kFloat32, {1}}};
  set_degree_colors(colors, atlas, {1, 3, 0, 2, kNoCap});
  ASSERT_EQ(colors.size(), 3U);  // previous attributes are replaced
  double last = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double light = 0.3 * colors[0].values[i] + 0.59 * colors[1].values[i];
    EXPECT_GT(light, last);
    last = light;
  }
  for (const Attribute& color : colors) EXPECT_EQ(color.values[4], 128);
}

TEST(patch_atlas, place_and_size_of_the_shape_do_not_matter) {
  PointCloud cloud = test::sphere_points(2000);
  const PatchAtlasOptions options{.degree = 8, .extension = CapExtension::kSphere};
  const PatchAtlas made = patch_atlas(cloud, options);
  for (Vec3& p : cloud.points) p = 1024.0 * p + Vec3{4096, 0, -2048};
  const PatchAtlas moved = patch_atlas(cloud, options);
  ASSERT_EQ(moved.model.atlas.caps.size(), made.model.atlas.caps.size());
  EXPECT_NEAR(moved.rms_along_rays, 1024 * made.rms_along_rays, 1e-6);
  EXPECT_NEAR(moved.model.errors->rms_from, 1024 * made.model.errors->rms_from, 1e-2);
}

TEST(patch_atlas, is_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = icosphere(3);
  const PatchAtlasOptions options{.degree = 6, .extension = CapExtension::kSphere};
  const PatchAtlas one = patch_atlas(mesh, options, {.threads = 1});
  const PatchAtlas two = patch_atlas(mesh, options, {.threads = 2});
  EXPECT_EQ(one.model.atlas.coefficients, two.model.atlas.coefficients);
  EXPECT_EQ(one.surface.vertices, two.surface.vertices);
}

TEST(patch_atlas, what_it_cannot_be_made_of_is_refused) {
  const PointCloud cloud = test::sphere_points(100);
  PointCloud bare = cloud;
  bare.normals.clear();
  PointCloud few = cloud;
  few.points.resize(10), few.normals.resize(10);
  EXPECT_THROW(patch_atlas(bare, {}), Error);
  EXPECT_THROW(patch_atlas(few, {}), Error);
  EXPECT_THROW(patch_atlas(cloud, {.degree = 25}), Error);
  EXPECT_THROW(patch_atlas(cloud, {.min_cosine = 2}), Error);
  EXPECT_THROW(patch_atlas(cloud, {.overlap = 0.5}), Error);
}

template <class Make>
std::string refusal(const Make& make) {
  try {
    make();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    return error.what();
  }
  return "accepted";
}

// A grid with the spacing of the points would need more memory than exists. The error blames the
// shape, not the machine.
TEST(patch_atlas, needles_are_refused_as_such) {
  try {
    patch_atlas(box({1, 1e-7, 1e-7}, 2), {.degree = 6});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kUnsupported) << error.what();
  }
}

TEST(atlases, of_points_without_normals_are_refused_with_what_helps) {
  PointCloud bare = test::sphere_points(1000);
  bare.normals.clear();
  for (const std::string& message : {refusal([&] { patch_atlas(bare, {}); }),
                                     refusal([&] { compress(bare, {.tolerance = 0.01}); })}) {
    EXPECT_NE(message.find("rholm orient"), std::string::npos) << message;
  }
}

TEST(atlases, leave_out_points_whose_normal_is_zero) {
  const Vec3 some{1, 2, 3}, other{4, 5, 6};
  const OrientedPoints kept = oriented_points({some, other, some}, {{0, 3, 0}, {}, {0, 0, -0.5}});
  EXPECT_EQ(kept.points, (std::vector<Vec3>{some, some}));
  EXPECT_EQ(kept.normals, (std::vector<Vec3>{{0, 1, 0}, {0, 0, -1}}));
}

}  // namespace
}  // namespace rholm
