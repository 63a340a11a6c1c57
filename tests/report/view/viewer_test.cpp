// The viewer in a page, and the data that it reads.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "report/page/viewer_data.h"
#include "report/view/named_arrays.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"
#include "rholm/report.h"

namespace rholm {
namespace {

Expansion expansion_of(const Mesh& mesh, int degree) {
  return expand(mesh, {.degree = degree}).transform.expansion;
}

// Returns the text between `name` and `end`.
std::string_view after(std::string_view text, std::string_view name, std::string_view end) {
  const std::size_t at = text.find(name);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + name.size());
  return text.substr(0, text.find(end));
}

std::size_t times(std::string_view text, std::string_view what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string_view::npos; ++at) ++n;
  return n;
}

// Reads a file by its header, independently of the library.
struct Read {
  std::string json;
  std::string_view bytes;

  template <typename T>
  std::vector<T> array(const std::string& name, std::size_t n) const {
    const std::string_view about = after(json, "\"name\":\"" + name + "\"", "}");
    std::vector<T> values(n);
    const std::size_t at = std::stoul(std::string(after(about, "\"offset\":", "}")));
    EXPECT_EQ(at % 8, 0u);
    EXPECT_LE(at + n * sizeof(T), bytes.size());
    std::memcpy(values.data(), bytes.data() + at, n * sizeof(T));
    return values;
  }
};

Read read(std::string_view bytes) {
  EXPECT_EQ(bytes.substr(0, 8), std::string_view("RHOLM1\0\0", 8));
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 8, 4);
  return {std::string(bytes.substr(12, length)), bytes};
}

TEST(named_arrays, lie_where_the_head_says_whatever_its_length) {
  // Names of all lengths put the arrays at every offset, so that offsets get more digits.
  for (std::size_t letters = 1; letters < 120; ++letters) {
    const std::string name(letters, 'x');
    const std::vector<double> doubles = {1.5, -2.25, 1e300};
    const std::vector<float> floats = {0.5F};
    const std::vector<std::uint32_t> numbers = {7, 0xFFFFFFFF};
    const std::vector<std::uint8_t> small = {1, 2, 3, 4, 5};
    NamedArrays arrays;
    arrays.add(name.c_str(), doubles, {3});
    arrays.add("floats", floats, {1, 1});
    arrays.add("none", std::vector<float>{}, {0, 3});
    arrays.add("small", small, {5});
    arrays.add("numbers", numbers, {2});
    const std::string bytes = arrays.bytes("{}");
    const Read found = read(bytes);
    EXPECT_EQ(found.array<double>(name, 3), doubles);
    EXPECT_EQ(found.array<float>("floats", 1), floats);
    EXPECT_EQ(found.array<std::uint8_t>("small", 5), small);
    EXPECT_EQ(found.array<std::uint32_t>("numbers", 2), numbers);
    EXPECT_NE(found.json.find(R"("shape":[0,3])"), std::string::npos);
  }
}

TEST(view_data, holds_the_coefficients_and_the_shape) {
  const Mesh shape = box({3, 2, 1});
  const Expansion expansion = expansion_of(shape, 5);
  const std::string bytes = view_data(expansion, &shape, "a \"box\" <&>");
  const Read found = read(bytes);
  const std::span<const double> wanted = expansion.coefficients.values();
  EXPECT_EQ(found.array<double>("coefficients", wanted.size()),
            std::vector<double>(wanted.begin(), wanted.end()));
  const auto positions = found.array<float>("positions", 3 * shape.vertices.size());
  for (std::size_t i = 0; i < shape.vertices.size(); ++i) {
    EXPECT_EQ(positions[3 * i + 1], static_cast<float>(shape.vertices[i].y));
  }
  EXPECT_EQ(found.array<std::uint32_t>("triangles", 3)[2], shape.faces[0][2]);
  EXPECT_NE(found.json.find(R"("title":"a \"box\" <&>")"), std::string::npos);
  EXPECT_NE(found.json.find(R"("function":"radius")"), std::string::npos);
}

TEST(view_data, of_large_shapes_has_a_simpler_one) {
  const Mesh sphere = icosphere(7);  // 327 680 faces
  const std::string bytes = view_data(expansion_of(box({1, 1, 1}), 2), &sphere, "");
  const std::string shape(after(read(bytes).json, R"("triangles","type":"u32","shape":[)", ","));
  EXPECT_LE(std::stoul(shape), report::kMostFacesViewed);
  EXPECT_GT(std::stoul(shape), report::kMostFacesViewed / 2);
}

TEST(view_data, is_of_surfaces_only) {
  Expansion field;
  field.function = RadialFunction::kOther;
  EXPECT_THROW(view_data(field, nullptr, ""), Error);
}

TEST(report_with_a_viewer, holds_it_and_its_data_and_nothing_breaks_out) {
  const Mesh shape = box({3, 2, 1});
  const Expansion expansion = expansion_of(shape, 4);
  const std::string viewer = "const a = '</script><!-- </SCRIPT', b = x < /script/;";
  const std::string page =
      report_html(expansion, &shape, {.title = "box", .picture_size = 16, .viewer = viewer});
  EXPECT_EQ(times(page, "id=\"rholm-view\""), 1u);
  EXPECT_EQ(times(page, "<script"), 2u);
  EXPECT_EQ(times(page, "</script>"), 2u);
  EXPECT_NE(page.find(R"(const a = '<\x2fscript><\x21-- <\x2fSCRIPT', b = x < /script/;)"),
            std::string::npos);
  EXPECT_NE(page.find("script-src 'unsafe-inline'"), std::string::npos);
}

TEST(report_without_a_viewer, runs_nothing) {
  const std::string page =
      report_html(expansion_of(box({3, 2, 1}), 4), nullptr, {.picture_size = 16});
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("script-src"), std::string::npos);
  EXPECT_EQ(page.find("rholm-view"), std::string::npos);
}

}  // namespace
}  // namespace rholm
