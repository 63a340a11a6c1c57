#include <gtest/gtest.h>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::expect_refused;
using testing::expect_tetrahedron;
using testing::parse;
using testing::parse_mesh;
using testing::parse_points;

const std::string kVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

void expect_attribute(const std::vector<Attribute>& attributes, const std::string& name,
                      ScalarType type, const std::vector<double>& values) {
  const Attribute* attribute = find_attribute(attributes, name);
  ASSERT_NE(attribute, nullptr) << name;
  EXPECT_EQ(attribute->type, type) << name;
  EXPECT_EQ(attribute->values, values) << name;
}

TEST(off, plain_file_is_read) {
  const ShapeFile file = parse("OFF\n4 4 6\n" + kVertices + kFaces);
  EXPECT_EQ(file.format, ShapeFormat::kOff);
  EXPECT_TRUE(file.warnings.empty());
  expect_tetrahedron(std::get<Mesh>(file.shape));
}

TEST(off, header_and_counts_are_read_in_every_layout) {
  for (const std::string head :
       {"OFF 4 4 6\n", "OFF 4 4\n", "OFF\n4 4\n", "# c\nOFF # c\n# c\n\n  4 4 6 # c\n\n",
        "\xEF\xBB\xBFOFF\r\n4 4 0\r\n", "OFF\r4 4 0\r", "OFF\n4\n4\n"}) {
    SCOPED_TRACE(head);
    expect_tetrahedron(parse_mesh(head + kVertices + kFaces));
  }
  expect_tetrahedron(parse_mesh("4 4 6\n" + kVertices + kFaces, "no-header-word.off"));
}

TEST(off, comments_and_face_colours_are_passed_over) {
  expect_tetrahedron(
      parse_mesh("OFF\n4 4 0\n0 0 0 # first\n# none\n1 0 0\n\n0 1 0\n0 0 1\n"
                 "3 0 2 1 255 0 0\n3 0 1 3 0.5 0.5 0.5 1 # c\n3 0 3 2 7\n3 1 2 3"));
}

TEST(off, vertices_may_share_lines) {
  expect_tetrahedron(parse_mesh("OFF\n4 4 0\n0 0 0 1 0 0 0 1 0 0 0 1\n" + kFaces));
}

TEST(off, byte_colours_keep_their_type) {
  for (const std::string word : {"COFF", "OFF"}) {
    const Mesh mesh = parse_mesh(word +
                                 "\n3 1 0\n0 0 0 255 0 0 128\n1 0 0 0 255 0 255\n"
                                 "0 1 0 0 0 17 0\n3 0 1 2\n");
    EXPECT_EQ(mesh.attributes.size(), 4u);
    expect_attribute(mesh.attributes, "red", ScalarType::kUint8, {255, 0, 0});
    expect_attribute(mesh.attributes, "blue", ScalarType::kUint8, {0, 0, 17});
    expect_attribute(mesh.attributes, "alpha", ScalarType::kUint8, {128, 255, 0});
  }
}

TEST(off, colours_as_fractions_are_kept_as_they_are) {
  const Mesh mesh =
      parse_mesh("COFF\n3 1 0\n0 0 0 1.0 0 0\n1 0 0 0 0.5 0\n0 1 0 0 0 1e-1\n3 0 1 2\n");
  EXPECT_EQ(mesh.attributes.size(), 3u);
  expect_attribute(mesh.attributes, "green", ScalarType::kFloat64, {0, 0.5, 0});
  // Colours of 0 and 1 alone are fractions too: nobody writes 1 for 1/255.
  const Mesh primary = parse_mesh("COFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n3 0 1 2\n");
  expect_attribute(primary.attributes, "red", ScalarType::kFloat64, {1, 0, 0});
}

TEST(off, normals_colours_and_texture_coordinates_are_told_apart) {
  const Mesh mesh = parse_mesh(
      "STCNOFF\n3 1 0\n0 0 0  0 0 1  9 8 7  .5 .25\n1 0 0  0 1 0  6 5 4  1 0\n"
      "0 1 0  1 0 0  3 2 1  0 1\n3 0 1 2\n");
  EXPECT_EQ(mesh.vertices[1], (Vec3{1, 0, 0}));
  expect_attribute(mesh.attributes, "nx", ScalarType::kFloat64, {0, 0, 1});
  expect_attribute(mesh.attributes, "nz", ScalarType::kFloat64, {1, 0, 0});
  expect_attribute(mesh.attributes, "red", ScalarType::kUint8, {9, 6, 3});
  expect_attribute(mesh.attributes, "u", ScalarType::kFloat64, {0.5, 1, 0});
  expect_attribute(mesh.attributes, "v", ScalarType::kFloat64, {0.25, 0, 1});
  const Mesh st = parse_mesh("STOFF\n3 1 0\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  EXPECT_EQ(st.attributes.size(), 2u);
  expect_attribute(st.attributes, "u", ScalarType::kFloat64, {0, 1, 0});
}

TEST(off, without_faces_is_points_with_normals) {
  const PointCloud cloud = parse_points("NOFF\n2 0 0\n1 2 3 0 0 1\n4 5 6 0 1 0\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}}));
  EXPECT_TRUE(cloud.attributes.empty());
}

TEST(off, polygons_are_cut_and_short_faces_skipped) {
  const ShapeFile file = parse("OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n2 0 1\n0\n");
  EXPECT_EQ(std::get<Mesh>(file.shape).faces.size(), 2u);
  EXPECT_EQ(file.warnings, (std::vector<std::string>{"2 faces with fewer than 3 corners skipped"}));
}

TEST(off, other_dimensions_and_binary_are_not_supported) {
  for (const std::string head : {"4OFF\n", "nOFF\n", "C4nOFF 3\n", "OFF BINARY\n"}) {
    expect_error([&] { parse(head + "4 4 6\n" + kVertices + kFaces); }, ErrorCode::kUnsupported);
  }
}

TEST(off, broken_files_are_refused) {
  expect_refused("OFF\n0 0 0\n", {"no vertices"});
  expect_refused("OFF\nfour 4 0\n" + kVertices, {"line 2", "'four'", "number of vertices"});
  expect_refused("OFF\n-4 4 0\n" + kVertices, {"line 2"});
  expect_refused("OFF\n4\n", {"truncated"});
  expect_refused("OFF\n4 4 0\n" + kVertices + "3 0 2 1\n3 0 1 3\n3 0 3 2\n", {"truncated"});
  expect_refused("OFF\n4 4 0\n" + kVertices + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2\n", {"truncated"});
  expect_refused("OFF\n4 4 0\n" + kVertices + "3 0 2 4\n" + kFaces, {"line 7", "vertex 4"});
  expect_refused("OFF\n4 4 0\n" + kVertices + "3 0 2 -1\n" + kFaces, {"line 7", "'-1'"});
  expect_refused("OFF\n4 4 0\n0 0 x\n" + kVertices + kFaces, {"line 3", "'x'"});
  expect_refused("OFF\n4 4 0\n0 0 inf\n" + kVertices + kFaces, {"line 3", "finite"});
  expect_refused("COFF\n3 1 0\n0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n", {"line 3", "colour"});
  expect_refused("COFF\n3 1 0\n0 0 0 1 2 3\n1 0 0\n0 1 0 1 2 3\n3 0 1 2\n", {"line 4", "colour"});
  EXPECT_EQ(parse_points("NOFF\n1 0 0\n0 0 0 nan 0 0\n").normals, (std::vector<Vec3>{{}}));
  EXPECT_EQ(parse("OFF\n2 0 0\n0 0 inf\n1 2 3\n").dropped, 1u);
  expect_refused("OFF\n", {"number of vertices", "missing"});
  expect_refused("OFF\n3\n", {"number of faces", "missing"});
}

TEST(off, counts_beyond_the_file_are_refused_before_memory_is_taken) {
  expect_refused("OFF\n4000000000 4 0\n" + kVertices + kFaces, {"truncated", "4000000000"});
  expect_refused("OFF\n4 4000000000 0\n" + kVertices + kFaces, {"truncated", "4000000000"});
  expect_refused("OFF\n18446744073709551615 18446744073709551615 0\n" + kVertices, {"truncated"});
  expect_refused("OFF\n1 1 0\n0 0 0\n4000000000 0 0 0\n", {"truncated"});
}

TEST(off, bytes_after_the_last_face_are_noted) {
  EXPECT_EQ(parse("OFF\n4 4 0\n" + kVertices + kFaces + "# end\nrest").warnings,
            (std::vector<std::string>{"4 bytes after the last face passed over"}));
}

}  // namespace
}  // namespace rholm
