#include <gtest/gtest.h>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::expect_refused;
using testing::expect_tetrahedron;
using testing::parse;
using testing::parse_mesh;
using testing::parse_points;

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

void expect_attribute(const Mesh& mesh, const std::string& name,
                      const std::vector<double>& values) {
  const Attribute* attribute = find_attribute(mesh.attributes, name);
  ASSERT_NE(attribute, nullptr) << name;
  EXPECT_EQ(attribute->values, values) << name;
}

TEST(obj, plain_faces_are_read) {
  const ShapeFile file = parse(kVertices + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  EXPECT_EQ(file.format, ShapeFormat::kObj);
  EXPECT_EQ(file.encoding, "ascii");
  EXPECT_TRUE(file.warnings.empty());
  expect_tetrahedron(std::get<Mesh>(file.shape));
}

TEST(obj, all_index_forms_are_read) {
  const std::string data = kVertices + "vt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\n";
  for (const std::string faces :
       {"f 1/1 3/1 2/2\nf 1/1 2/2 4/1\nf 1/1 4/1 3/1\nf 2/2 3/1 4/1\n",
        "f 1//1 3//1 2//2\nf 1//1 2//2 4//1\nf 1//1 4//1 3//1\nf 2//2 3//1 4//1\n",
        "f 1/1/1 3/1/1 2/2/2\nf 1/1/1 2/2/2 4/1/1\nf 1/1/1 4/1/1 3/1/1\nf 2/2/2 3/1/1 4/1/1\n",
        "f 1/ 3/ 2/\nf 1// 2// 4//\nf 1/1/ 4/1/ 3/1/\nf 2 3 4\n",
        "f -4 -2 -3\nf -4/-2/-2 -3/-1/-1 -1/-2/-2\nf -4//-2 -1//-2 -2//-2\nf -3 -2 -1\n"}) {
    SCOPED_TRACE(faces);
    expect_tetrahedron(parse_mesh(data + faces));
  }
}

TEST(obj, negative_indices_count_from_the_latest_vertex) {
  expect_tetrahedron(
      parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -1 -2\nv 0 0 1\nf -4 -3 -1\nf 1 4 3\nf 2 3 4\n"));
}

TEST(obj, faces_may_come_before_their_vertices) {
  expect_tetrahedron(parse_mesh("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n" + kVertices));
}

TEST(obj, other_statements_and_comments_are_passed_over) {
  const ShapeFile file =
      parse("# made by hand\r\nmtllib a file.mtl\r\no name\r\ng group 1\r\n\r\n" + kVertices +
            "usemtl red\ns off\nf 1 3 2 # with a comment\n  f 1 2 4\n\tf\t1 4 3\nf 2 3 4\nl 1 2 "
            "3\np 1\n");
  expect_tetrahedron(std::get<Mesh>(file.shape));
  EXPECT_EQ(file.warnings, (std::vector<std::string>{"2 line and point elements passed over"}));
  EXPECT_EQ(parse(kVertices + "cstype bezier\ncurv 1 2\nf 1 2 3\n").warnings,
            (std::vector<std::string>{
                "2 statements of unknown kind passed over, the first is 'cstype' in line 5"}));
}

TEST(obj, lines_continue_behind_a_backslash) {
  expect_tetrahedron(
      parse_mesh("v 0 0 \\\n0\nv 1 \\\r\n0 0\nv 0 1 0\nv 0 0 1\n"
                 "f 1 3 \\\n  2\nf 1\\\n 2 4\nf 1 4 3\nf \\\n 2 3 4\n"));
}

TEST(obj, polygons_are_cut) {
  const Mesh mesh = parse_mesh(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0\nf 1 2 3 4\n"
      "f 1 2 3 5 4\n");
  EXPECT_EQ(mesh.faces.size(), 5u);
  EXPECT_EQ(parse(kVertices + "f 1 2\nf 1 2 3\n").warnings,
            (std::vector<std::string>{"1 face with fewer than 3 corners skipped"}));
}

TEST(obj, weights_are_ignored_and_colours_kept) {
  const Mesh weighted = parse_mesh("v 1 2 3 0.5\nv 4 5 6 1\nv 7 8 10 1\nf 1 2 3\n");
  EXPECT_EQ(weighted.vertices[0], (Vec3{1, 2, 3}));
  EXPECT_TRUE(weighted.attributes.empty());
  const Mesh colored = parse_mesh("v 0 0 0 1 0.5 0\nv 1 0 0 0 1 0.25\nv 0 1 0 0 0 1 1\nf 1 2 3\n");
  expect_attribute(colored, "red", {1, 0, 0});
  expect_attribute(colored, "green", {0.5, 1, 0});
  expect_attribute(colored, "blue", {0, 0.25, 1});
  const ShapeFile some = parse("v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(std::get<Mesh>(some.shape).attributes.empty());
  EXPECT_EQ(some.warnings,
            (std::vector<std::string>{"only 1 of 3 vertices have a colour: colours passed over"}));
}

TEST(obj, consistent_normals_and_texture_coordinates_are_kept) {
  // The unused vertex 5 gets zeros; normal 4 equals normal 1.
  const Mesh mesh =
      parse_mesh(kVertices +
                 "v 9 9 9\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvn 0 0 1\nvt 0.5\n"
                 "vt 0.25 0.75\nvt 1 2 3\nf 1/1/1 2/2/2 3/3/3\nf 1/1/4 3/3/3 4/1/1\n");
  expect_attribute(mesh, "nx", {0, 0, 1, 0, 0});
  expect_attribute(mesh, "ny", {0, 1, 0, 0, 0});
  expect_attribute(mesh, "nz", {1, 0, 0, 1, 0});
  expect_attribute(mesh, "u", {0.5, 0.25, 1, 0.5, 0});
  expect_attribute(mesh, "v", {0, 0.75, 2, 0, 0});
}

TEST(obj, normals_defined_after_the_faces_are_kept) {
  const Mesh mesh = parse_mesh("f 1//1 2//2 3//1\n" + kVertices + "vn 0 0 1\nvn 0 1 0\n");
  expect_attribute(mesh, "nz", {1, 0, 1, 0});
}

TEST(obj, contradicting_normals_and_texture_coordinates_are_dropped_with_a_warning) {
  const ShapeFile file = parse(kVertices +
                               "vn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\nf 1/1/1 2/1/1 3/1/1\n"
                               "f 1/2/2 3/1/1 4/1/1\n");
  EXPECT_TRUE(std::get<Mesh>(file.shape).attributes.empty());
  EXPECT_EQ(file.warnings.size(), 2u);
  const ShapeFile partial = parse(kVertices + "vn 0 0 1\nf 1//1 2//1 3\nf 1//1 3 4\n");
  EXPECT_TRUE(std::get<Mesh>(partial.shape).attributes.empty());
  EXPECT_EQ(partial.warnings.size(), 1u);
}

TEST(obj, only_vertices_are_points_with_their_normals) {
  const PointCloud cloud = parse_points("v 1 2 3\nvn 0 0 1\nv 4 5 6\nvn 0 1 0\n");
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 1, 0}}));
  const ShapeFile odd = parse("v 1 2 3\nv 4 5 6\nvn 0 0 1\n");
  EXPECT_TRUE(std::get<PointCloud>(odd.shape).normals.empty());
  EXPECT_EQ(odd.warnings, (std::vector<std::string>{"1 normal for 2 points passed over"}));
  EXPECT_EQ(parse_points("v 1 2 3\nvn 0 nan 1\n").normals, (std::vector<Vec3>{{}}));
}

TEST(obj, numbers_are_read_in_every_notation) {
  const PointCloud cloud =
      parse_points("v +1.5 -2.5e+01 .5\nv 5. 1E-2 -0\nv 1e-400 -1e-400 4.9e-324\n");
  EXPECT_EQ(cloud.points[0], (Vec3{1.5, -25, 0.5}));
  EXPECT_EQ(cloud.points[1], (Vec3{5, 0.01, 0}));
  EXPECT_EQ(cloud.points[2], (Vec3{0, 0, 4.9e-324}));
  EXPECT_TRUE(std::signbit(cloud.points[2].y));
}

TEST(obj, broken_lines_are_refused_with_their_number) {
  expect_refused("v 0 0\n", {"line 1", "3 coordinates"});
  expect_refused("v 0 0 0\nv 1 one 0\n", {"line 2", "'one'"});
  expect_refused("v 0 0 0\r\nv 1 1.2.3 0\r\n", {"line 2", "'1.2.3'"});
  expect_refused("v 0 0 0\nv 1 nan 0\nv 1 1 1\nf 1 2 3\n", {"line 2", "finite"});
  EXPECT_EQ(parse("v 0 0 0\nv 1 nan 0\n").dropped, 1u);
  expect_refused("v 0 0 0\nv 1 +-1 0\n", {"line 2"});
  expect_refused("v 0 0 0 1 1 1 1 1\n", {"line 1", "too many"});
  expect_refused(kVertices + "vn 1 2\n", {"line 5", "3 numbers"});
  expect_refused(kVertices + "vt\n", {"line 5"});
  expect_refused(kVertices + "f 1 2 three\n", {"line 5", "'three'"});
  expect_refused(kVertices + "f 1 2 3;\n", {"line 5", "';'"});
  expect_refused(kVertices + "f 1/x 2 3\n", {"line 5"});
  expect_refused(kVertices + "f 1/1/1/1 2 3\n", {"line 5"});
  expect_refused("# only a comment\nvn 0 0 1\n", {"no vertices"}, "a.obj");
}

TEST(obj, indices_out_of_range_are_refused_with_their_line) {
  expect_refused(kVertices + "f 1 2 3\nf 1 2 5\nf 1 2 3\n", {"line 6", "vertex 5", "only 4"});
  expect_refused(kVertices + "f 1 2 0\n", {"line 5", "0"});
  expect_refused(kVertices + "f 1 2 -5\n", {"line 5", "-5"});
  expect_refused(kVertices + "f 1 2 4294967297\n", {"line 5", "4294967297"});
  expect_refused(kVertices + "f 1 2 99999999999999999999\n", {"line 5"});
  expect_refused(kVertices + "vn 0 0 1\nf 1//1 2//2 3//1\n", {"line 6", "normal 2"});
  expect_refused(kVertices + "vt 0 0\nf 1/1 2/1 3/3\n", {"line 6", "texture coordinate 3"});
}

}  // namespace
}  // namespace rholm
