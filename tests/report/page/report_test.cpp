#include "rholm/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/html.h"
#include "report/page/report_data.h"
#include "report/page/report_pictures.h"
#include "report/page/report_plot.h"
#include "report_pages.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"
#include "support/sizes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using namespace test;

Expansion expansion_of(const Mesh& mesh, int degree, Method method = Method::kEdge) {
  return expand(mesh, {.degree = degree, .method = method}).transform.expansion;
}

// RFC 4648, section 10.
TEST(base64, has_the_test_vectors_of_its_standard) {
  const std::string text = "foobar";
  constexpr const char* kWanted[] = {"",         "Zg==",     "Zm8=",    "Zm9v",
                                     "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t n = 0; n <= text.size(); ++n) {
    EXPECT_EQ(html::base64(std::span(text).first(n)), kWanted[n]);
  }
  const std::vector<char> high = {'\xFB', '\xFF', '\xBF'};
  EXPECT_EQ(html::base64(high), "+/+/");
}

TEST(escaped, leaves_no_markup_and_no_byte_that_is_not_text) {
  EXPECT_EQ(html::escaped("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
  EXPECT_EQ(html::escaped("gr\xC3\xB6\xC3\x9F"
                          "e"),
            "gr\xC3\xB6\xC3\x9F"
            "e");
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(html::escaped("a\xFF"
                          "b\x01"
                          "c\x7F"
                          "d"),
            "a" + replacement + "b" + replacement + "c" + replacement + "d");
  EXPECT_EQ(html::escaped(std::string_view("\0", 1)), replacement);
  EXPECT_EQ(html::escaped("\xC2\x85"), replacement);  // U+0085, a control character
}

TEST(number, is_printed_as_in_books) {
  const std::string thin = "\xE2\x80\xAF", times = thin + "\xC3\x97" + thin, minus = "\xE2\x88\x92";
  EXPECT_EQ(html::number(0), "0");
  EXPECT_EQ(html::number(2.5), "2.500");
  EXPECT_EQ(html::number(-0.00123456), minus + "0.001235");
  EXPECT_EQ(html::number(1234567, 6), "1" + thin + "234" + thin + "567");
  EXPECT_EQ(html::number(1.5e-7, 2), "1.5" + times + "10<sup>" + minus + "7</sup>");
  EXPECT_EQ(html::number(-3e200, 1), minus + "3" + times + "10<sup>200</sup>");
  EXPECT_EQ(html::number(std::nan("")), "not finite");
  EXPECT_EQ(html::decimal(-1e-9, 3), "0.000");  // zero has no minus sign
  EXPECT_EQ(html::count(4225), "4225");
  EXPECT_EQ(html::count(33800), "33" + thin + "800");
}

TEST(degree_ladder, doubles_up_to_the_degree) {
  EXPECT_EQ(report::degree_ladder(0), std::vector<int>{0});
  EXPECT_EQ(report::degree_ladder(1), std::vector<int>{1});
  EXPECT_EQ(report::degree_ladder(8), (std::vector<int>{1, 2, 4, 8}));
  EXPECT_EQ(report::degree_ladder(9), (std::vector<int>{1, 2, 4, 8, 9}));
}

// There is one coefficient per degree: C_l0 = 3. The norm has 5 more. The remainder after degree l
// is 9 (L - l) + 5.
TEST(report_data, rms_of_every_degree_is_that_of_parseval) {
  const int degree = 6;
  Expansion expansion;
  expansion.coefficients = Coefficients(degree);
  for (int l = 0; l <= degree; ++l) expansion.coefficients.c(l, 0) = 3;
  expansion.norm_squared = 9 * (degree + 1) + 5;
  const report::Data data = report::find_data(expansion, {}, {});
  ASSERT_EQ(data.rows.size(), 4u);  // 1, 2, 4, 6
  for (const report::DegreeRow& row : data.rows) {
    const double rest = 9.0 * (degree - row.degree) + 5;
    ASSERT_TRUE(row.rms.has_value());
    EXPECT_TRUE(row.rms_is_exact);
    EXPECT_NEAR(*row.rms, std::sqrt(rest / (4 * std::numbers::pi)), 1e-14);
    EXPECT_FALSE(row.max.has_value());
  }
}

// A norm that exceeds the coefficients by less than their precision bounds the remainder, but does
// not determine it. A measured error does.
TEST(report_data, a_difference_within_the_precision_of_coefficients_is_not_called_exact) {
  Expansion expansion;
  expansion.coefficients.c(0, 0) = 1;
  expansion.norm_squared = 1 + 1e-10;
  report::Data data = report::find_data(expansion, {}, {});
  EXPECT_FALSE(data.rows.back().rms);
  EXPECT_GE(*data.rows.back().rms_at_most, std::sqrt(1e-10 / (4 * std::numbers::pi)));
  expansion.errors = TruncationErrors{};
  expansion.errors->rms = 1e-5;
  data = report::find_data(expansion, {}, {});
  EXPECT_FALSE(data.rows.back().rms_is_exact);
  EXPECT_EQ(*data.rows.back().rms, 1e-5);
}

// The remainder varies from a part of its uncertainty to a hundred times it. The page must state
// the same as rms_beyond().
TEST(report_data, knows_of_every_degree_what_rms_beyond_knows) {
  Expansion expansion;
  expansion.coefficients = Coefficients(2);
  expansion.coefficients.c(0, 0) = 1;
  expansion.coefficients.c(2, 0) = 1e-3;
  int known = 0, exact = 0;
  for (const double rest : {1e-9, 1e-8, 3e-8, 1e-7, 3e-7, 3e-6}) {
    expansion.norm_squared = 1 + 1e-6 + rest;
    const RmsBeyond beyond = rms_beyond(expansion);
    const report::Data data = report::find_data(expansion, {}, {});
    EXPECT_EQ(data.rms, beyond.rms);
    for (const report::DegreeRow& row : data.rows) {
      const std::optional<double>& wanted = beyond.rms[static_cast<std::size_t>(row.degree)];
      EXPECT_EQ(row.rms, wanted);
      EXPECT_EQ(row.rms_at_most, wanted ? std::nullopt : beyond.bound());
    }
    if (data.rows.back().rms) ++known;
    if (data.rows.back().rms_is_exact) ++exact;
    EXPECT_EQ(
        count(report_html(expansion, nullptr, {}), "by Parseval&#8217;s identity, as far as") > 0,
        !data.rows.back().rms_is_exact);
  }
  EXPECT_EQ(known, 3);
  EXPECT_EQ(exact, 1);
}

// The unit sphere is compared with the regular octahedron in it. The largest error is at the middle
// of a face, 1 - 1 / sqrt 3, and a point near it has nearly this error.
TEST(report_data, largest_error_of_a_sphere_around_an_octahedron_is_at_the_faces) {
  Mesh octahedron = test::random_octahedron(1);
  for (Vec3& v : octahedron.vertices) v = normalized(v);
  Expansion sphere;
  sphere.coefficients.c(0, 0) = std::sqrt(4 * std::numbers::pi);
  const report::Data data =
      report::find_data(sphere, report::shape_figures(octahedron, {}, 0, {}), {});
  ASSERT_TRUE(data.shape->is_star());
  EXPECT_NEAR(data.shape->star.min_d, 1 / std::sqrt(3.0), 1e-12);
  const double largest = 1 - 1 / std::sqrt(3.0);
  ASSERT_TRUE(data.rows.back().max.has_value());
  EXPECT_LE(*data.rows.back().max, largest + 1e-9);
  EXPECT_GE(*data.rows.back().max, 0.97 * largest);
  EXPECT_NEAR(data.model->volume.value(), 4 * std::numbers::pi / 3, 1e-12);
}

TEST(report_data, an_open_mesh_has_distances_but_no_radial_errors) {
  Mesh open = icosphere(2);
  open.faces.pop_back();
  const Expansion expansion = expansion_of(icosphere(2), 4);
  const report::Data data =
      report::find_data(expansion, report::shape_figures(open, {}, 0, {}), {});
  EXPECT_FALSE(data.shape->is_star());
  EXPECT_FALSE(data.rows.front().max.has_value());
  expect_decent(report_html(expansion, &open, small_pictures()));
}

TEST(may_be_of, a_model_knows_its_own_shape_from_others) {
  const Mesh shape = bumpy_sphere(3);
  Mesh larger = shape, moved = shape;
  for (Vec3& v : larger.vertices) v *= 1.001;
  for (Vec3& v : moved.vertices) v += {0.01, 0, 0};
  for (const Method method : {Method::kEdge, Method::kGauge}) {
    const Expansion expansion = expansion_of(shape, 4, method);
    const auto may_be_of = [&](const Mesh& mesh) {
      return report::may_be_of(expansion, report::shape_figures(mesh, expansion.center, 0, {}));
    };
    EXPECT_TRUE(may_be_of(shape));
    EXPECT_FALSE(may_be_of(larger));
    EXPECT_FALSE(may_be_of(torus(1, 0.3, 24, 12)));
    // A model of the gauge does not keep the norm of the radius.
    if (method == Method::kEdge) {
      EXPECT_FALSE(may_be_of(moved));
    }
  }
}

// Two panels of 2 x 60 pixels, grey in rows 20 ... 29 of the second: both keep these rows and 2
// more on either side.
TEST(cut_apart, panels_keep_their_columns_and_common_rows) {
  Image image{.width = 4, .height = 60, .rgb = std::vector<std::uint8_t>(4 * 60 * 3, 255)};
  for (std::size_t y = 20; y < 30; ++y) {
    for (std::size_t k = 6; k < 12; ++k) image.rgb[y * 12 + k] = 100;
  }
  const std::vector<Image> parts = report::cut_apart(image, 2);
  ASSERT_EQ(parts.size(), 2u);
  for (const Image& part : parts) {
    EXPECT_EQ(part.width, 2);
    EXPECT_EQ(part.height, 14);
    ASSERT_EQ(part.rgb.size(), 2u * 14 * 3);
  }
  for (std::size_t k = 0; k < 84; ++k) {
    EXPECT_EQ(parts[0].rgb[k], 255);
    EXPECT_EQ(parts[1].rgb[k], k / 6 >= 2 && k / 6 < 12 ? 100 : 255);
  }
}

// The slope -4 over two decades of x spans eight decades of y: a line from corner to corner.
TEST(log_log_plot, a_power_law_is_a_straight_line) {
  report::Plot plot{
      .id = "p", .title = "t", .description = "d", .y_label = "y", .x_max = 100, .series = {}};
  report::Series series{.label = "law", .ink = report::Ink::kMeasured, .points = {}};
  for (const double l : {1.0, 10.0, 100.0}) series.points.push_back({l, 0.8 * std::pow(l, -4)});
  plot.series = {series};
  const std::string svg = report::log_log_plot(plot);
  EXPECT_TRUE(is_balanced(svg));
  double x[3], y[3];
  const std::string_view begin = "class=\"line measured\" d=\"";
  const std::size_t path = svg.find(begin);
  ASSERT_NE(path, std::string::npos);
  std::istringstream text(svg.substr(path + begin.size()));
  for (int i = 0; i < 3; ++i) {
    char command = 0;
    text >> command >> x[i] >> y[i];
    ASSERT_TRUE(text && command == (i == 0 ? 'M' : 'L')) << i;
  }
  EXPECT_NEAR(x[1], (x[0] + x[2]) / 2, 0.11);  // coordinates are printed to 0.1
  EXPECT_NEAR(y[1], (y[0] + y[2]) / 2, 0.11);
  EXPECT_LT(y[0], y[2]);  // downwards
  EXPECT_EQ(
      report::log_log_plot(
          {.id = "e", .title = "t", .description = "d", .y_label = "y", .x_max = 3, .series = {}}),
      "");
}

TEST(report_html, is_one_page_that_needs_nothing_else) {
  const Mesh shape = bumpy_sphere(3);
  ReportOptions options = small_pictures();
  options.tolerance = 1e-3;
  options.commands = {{"This page", "rholm report a.ply -o a.html"}};
  const std::string html = report_html(expansion_of(shape, 12), &shape, options);
  expect_decent(html);
  EXPECT_EQ(count(html, "<img "), 5u);  // degrees 3 and 12, the shape, two maps
  EXPECT_EQ(count(html, "<table"), 3u);
  EXPECT_EQ(count(html, "<svg class=\"plot\""), 2u);
  EXPECT_EQ(count(html, "class=\"line tolerance\" d=\"M1 7H35\""), 2u);
  EXPECT_EQ(count(html, "rholm report a.ply -o a.html"), 1u);
}

TEST(report_html, is_the_same_bytes_for_any_number_of_threads) {
  const Mesh shape = bumpy_sphere(3);
  const Expansion expansion = expansion_of(shape, 10);
  const std::string one = report_html(expansion, &shape, small_pictures(), {.threads = 1});
  EXPECT_TRUE(one == report_html(expansion, &shape, small_pictures(), {.threads = 3}));
}

TEST(report_html, words_from_outside_are_text_and_not_markup) {
  const Mesh shape = icosphere(2);
  Expansion expansion = expansion_of(shape, 3);
  const std::string evil = "</style><script>x(\"'&\n\xFF";
  expansion.unit = expansion.method = evil;
  ReportOptions options{.title = evil, .shape_name = evil};
  options.commands = {{evil, evil}};
  options.notes = {evil};
  options.picture_size = 24;
  const std::string html = report_html(expansion, &shape, options);
  expect_decent(html);
  EXPECT_GE(count(html, "&lt;/style&gt;&lt;script&gt;x(&quot;&#39;&amp;"), 8u);
}

TEST(report_html, coefficients_alone_have_pictures_and_a_spectrum) {
  for (const Method method : {Method::kEdge, Method::kGauge}) {
    Expansion expansion = expansion_of(bumpy_sphere(2), 8, method);
    const std::string known = report_html(expansion, nullptr, small_pictures());
    expect_decent(known);
    EXPECT_EQ(count(known, "<img "), 2u);
    expansion.norm_squared.reset();
    expansion.tail_strength.reset();
    expansion.errors.reset();
    const std::string bare = report_html(expansion, nullptr, small_pictures());
    expect_decent(bare);
    EXPECT_GE(count(bare, "Nothing: the file does not keep the norm"), 1u);
  }
}

// q = 1 + 3 cos theta has no surface; its degree 0 alone has one.
TEST(report_html, a_gauge_without_a_surface_is_refused_or_left_out) {
  Expansion expansion;
  expansion.function = RadialFunction::kGauge;
  expansion.coefficients = Coefficients(4);
  expansion.coefficients.c(0, 0) = std::sqrt(4 * std::numbers::pi);
  expansion.coefficients.c(1, 0) = 3 * std::sqrt(4 * std::numbers::pi / 3);
  try {
    report_html(expansion, nullptr, small_pictures());
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
  }
  // q = 4 + 4.5 x + 3 x^2 - 1 >= 1.3 with x = cos theta. The page also draws degree 1, which has 4
  // + 4.5 x.
  expansion.coefficients.c(1, 0) *= 1.5;
  expansion.coefficients.c(0, 0) *= 4;
  expansion.coefficients.c(2, 0) = 2 * std::sqrt(4 * std::numbers::pi / 5);
  const std::string html = report_html(expansion, nullptr, small_pictures());
  expect_decent(html);
  EXPECT_EQ(count(html, "<img "), 1u);
  EXPECT_EQ(count(html, "There is no surface at degree 1"), 1u);
}

TEST_OF_TWO_SIZES(report_html, degree_zero_and_sizes_of_every_order_make_a_page) {
  for (const double size :
       nightly ? std::vector{1.0, 1e-30, 1e30, 1e100, 1e-100} : std::vector{1e100, 1e-100}) {
    Mesh shape = icosphere(2);
    for (Vec3& v : shape.vertices) v *= size;
    for (const int degree : {0, 3}) {
      expect_decent(report_html(expansion_of(shape, degree), &shape, small_pictures()));
    }
  }
}

TEST(report_html, options_out_of_range_are_refused) {
  const Expansion sphere = expansion_of(icosphere(2), 1);
  const auto refused = [&](const std::function<void(ReportOptions&)>& change, const Mesh* shape) {
    ReportOptions options = small_pictures();
    change(options);
    try {
      report_html(sphere, shape, options);
    } catch (const Error& error) {
      return error.code() == ErrorCode::kInvalidInput;
    }
    return false;
  };
  EXPECT_TRUE(refused([](ReportOptions& o) { o.picture_size = 15; }, nullptr));
  EXPECT_TRUE(refused([](ReportOptions& o) { o.picture_size = 5000; }, nullptr));
  EXPECT_TRUE(refused([](ReportOptions& o) { o.tolerance = 0; }, nullptr));
  const Mesh empty;
  EXPECT_TRUE(refused([](ReportOptions&) {}, &empty));
}

TEST(report_html, can_be_cancelled) {
  const Mesh shape = bumpy_sphere(2);
  const Expansion expansion = expansion_of(shape, 4);
  for (int calls = 0; calls < 12; calls += 3) {
    int left = calls;
    const Context context{.threads = 1,
                          .progress = [&](std::string_view, double) { return left-- > 0; }};
    EXPECT_THROW(report_html(expansion, &shape, small_pictures(), context), Error);
  }
}

}  // namespace
}  // namespace rholm
