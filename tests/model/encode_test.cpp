#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"

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

// As an STL file has it: three vertices of its own per triangle.
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
  // The fast engine takes identical vertices for one as they are, the direct one joins them.
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
