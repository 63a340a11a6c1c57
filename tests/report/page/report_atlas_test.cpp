// The report of an atlas. The oracle is a unit sphere made of six caps about its centre.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "report/page/report_atlas.h"
#include "report_pages.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/report.h"

namespace rholm {
namespace {

using namespace test;

// Degree 2 without coefficients: r = R_0 everywhere.
AtlasModel six_caps_of_a_sphere() {
  AtlasModel model;
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 6; ++k) {
    const double sign = k < 3 ? 1 : -1;
    Cap cap;
    cap.frame.z = sign * axes[k % 3];
    cap.frame.x = axes[(k + 1) % 3];
    cap.frame.y = cross(cap.frame.z, cap.frame.x);
    cap.frame.support = 1.2;
    cap.where.xx = cap.where.yy = 1 / (1.2 * 1.2);
    cap.basis = CapBasis::kFull;
    cap.degree = 2;
    cap.first = model.atlas.coefficients.size();
    model.atlas.coefficients.resize(cap.first + n_coefficients(cap.basis, cap.degree), 0.0);
    model.atlas.caps.push_back(cap);
  }
  model.atlas.diagonal = 2 * std::sqrt(3.0);
  model.step = 0.1;
  return model;
}

TEST(report_atlas, heights_are_those_of_orthonormal_coefficients) {
  AtlasModel model = six_caps_of_a_sphere();
  for (const Cap& cap : model.atlas.caps) {
    model.atlas.coefficients[cap.first + 1] = 0.3;  // degree 1
    model.atlas.coefficients[cap.first + 4] = 0.4;  // degree 2, with two coefficients
    model.atlas.coefficients[cap.first + 8] = 0.3;
  }
  const std::vector<double> heights = report::cap_heights_by_degree(model.atlas);
  ASSERT_EQ(heights.size(), 3U);
  const double mean = std::sqrt(4 * std::numbers::pi);
  EXPECT_EQ(heights[0], 0);
  EXPECT_NEAR(heights[1], 0.3 / mean, 1e-15);
  EXPECT_NEAR(heights[2], 0.5 / mean, 1e-15);
  EXPECT_EQ(report::coefficients_up_to(model.atlas, 0), 0U);
  EXPECT_EQ(report::coefficients_up_to(model.atlas, 1), 6U);
  EXPECT_EQ(report::coefficients_up_to(model.atlas, 2), 18U);
  EXPECT_EQ(report::drawn_limits(model.atlas), (std::vector<int>{1, 2}));
}

TEST(atlas, has_the_highest_degree_of_its_caps) {
  EXPECT_EQ(highest_degree(Atlas{}), 0);
  Atlas atlas = six_caps_of_a_sphere().atlas;
  EXPECT_EQ(highest_degree(atlas), 2);
  atlas.caps[3].degree = 7;
  EXPECT_EQ(highest_degree(atlas), 7);
}

TEST(report_atlas, is_one_page_that_needs_nothing_else) {
  const AtlasModel model = six_caps_of_a_sphere();
  const Mesh shape = icosphere(4);
  ReportOptions options = small_pictures();
  options.file_bytes = 4260;
  options.commands = {{"This page", "rholm report a.h5 -o a.html"}};
  const std::string html = report_html(model, &shape, options);
  expect_decent(html);
  EXPECT_EQ(count(html, "<img "), 7U);  // degrees 1 and 2, the shape, two caps, two maps
  EXPECT_EQ(count(html, "<table"), 2U);
  EXPECT_EQ(count(html, "4.26&nbsp;kB"), 1U);
  EXPECT_EQ(count(html, "rholm report a.h5 -o a.html"), 1U);
}

TEST(report_atlas, without_its_shape_says_what_the_model_knows) {
  AtlasModel model = six_caps_of_a_sphere();
  model.errors = AtlasErrors{.rms_from = 0.25, .max_from = 1, .rms_to = 0.125, .max_to = 0.5};
  model.unit = "km";
  const std::string html = report_html(model, nullptr, small_pictures());
  expect_decent(html);
  EXPECT_EQ(count(html, "<img "), 4U);
  EXPECT_EQ(count(html, "<dt>rms distance</dt><dd>0.250&nbsp;km"), 1U);
  EXPECT_EQ(count(html, "<dt>largest distance</dt><dd>1.00&nbsp;km"), 1U);
}

TEST(report_atlas, is_the_same_bytes_for_any_number_of_threads) {
  const AtlasModel model = six_caps_of_a_sphere();
  const Mesh shape = icosphere(3);
  const std::string one = report_html(model, &shape, small_pictures(), {.threads = 1});
  EXPECT_TRUE(one == report_html(model, &shape, small_pictures(), {.threads = 3}));
}

TEST(report_atlas, what_cannot_be_drawn_is_refused) {
  const auto is_refused = [](const AtlasModel& model, const Mesh* shape) {
    try {
      report_html(model, shape, small_pictures());
    } catch (const Error& error) {
      return error.code() == ErrorCode::kInvalidInput;
    }
    return false;
  };
  AtlasModel model = six_caps_of_a_sphere();
  const Mesh empty;
  EXPECT_TRUE(is_refused(model, &empty));
  EXPECT_TRUE(is_refused({}, nullptr));
  model.step = 0;
  EXPECT_TRUE(is_refused(model, nullptr));
}

}  // namespace
}  // namespace rholm
