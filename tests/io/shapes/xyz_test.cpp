#include <gtest/gtest.h>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::expect_refused;
using testing::parse;
using testing::parse_points;

const std::vector<Vec3> kPoints = {{1, 2, 3}, {4, 5, 6}};
const std::vector<Vec3> kNormals = {{0, 0, 1}, {0, 1, 0}};

void expect_attribute(const PointCloud& cloud, const std::string& name, ScalarType type,
                      const std::vector<double>& values) {
  const Attribute* attribute = find_attribute(cloud.attributes, name);
  ASSERT_NE(attribute, nullptr) << name;
  EXPECT_EQ(attribute->type, type) << name;
  EXPECT_EQ(attribute->values, values) << name;
}

TEST(xyz, three_columns_are_points) {
  for (const std::string text :
       {"1 2 3\n4 5 6\n", "1,2,3\n4,5,6\n", "1; 2; 3\r\n4; 5; 6", "\t1\t2\t3\r4 5 6\r",
        "# comment\n\n1 2 3 # one\n// two\n4 5 6\n% end", "\xEF\xBB\xBF+1 2.0 3e0\n4 5 6 \n\n"}) {
    SCOPED_TRACE(text);
    const ShapeFile file = parse(text);
    EXPECT_EQ(file.format, ShapeFormat::kXyz);
    EXPECT_EQ(file.encoding, "ascii");
    const auto& cloud = std::get<PointCloud>(file.shape);
    EXPECT_EQ(cloud.points, kPoints);
    EXPECT_TRUE(cloud.normals.empty());
    EXPECT_TRUE(cloud.attributes.empty());
  }
}

TEST(xyz, unit_vectors_behind_the_position_are_normals) {
  const PointCloud cloud = parse_points("1 2 3 0 0 1\n4 5 6 0 1 0\n");
  EXPECT_EQ(cloud.points, kPoints);
  EXPECT_EQ(cloud.normals, kNormals);
  EXPECT_TRUE(cloud.attributes.empty());
  // Normals rounded to two digits, and a point without a normal.
  const PointCloud rounded = parse_points("1 2 3 .58 .58 .58\n4 5 6 0 0 0\n");
  EXPECT_EQ(rounded.normals, (std::vector<Vec3>{{.58, .58, .58}, {0, 0, 0}}));
  const PointCloud more = parse_points("1 2 3 0 0 1 7\n4 5 6 0 1 0 8\n");
  EXPECT_EQ(more.normals, kNormals);
  expect_attribute(more, "scalar_1", ScalarType::kFloat64, {7, 8});
}

TEST(xyz, bytes_behind_the_position_are_colours) {
  const PointCloud cloud = parse_points("1 2 3 255 0 0\n4 5 6 0 1 0\n");
  EXPECT_TRUE(cloud.normals.empty());
  expect_attribute(cloud, "red", ScalarType::kUint8, {255, 0});
  expect_attribute(cloud, "green", ScalarType::kUint8, {0, 1});
  expect_attribute(cloud, "blue", ScalarType::kUint8, {0, 0});
}

TEST(xyz, other_columns_are_numbered_scalars) {
  const PointCloud one = parse_points("1 2 3 0.5\n4 5 6 1.5\n");
  EXPECT_EQ(one.attributes.size(), 1u);
  expect_attribute(one, "scalar_1", ScalarType::kFloat64, {0.5, 1.5});
  const PointCloud three = parse_points("1 2 3 0.5 0 10\n4 5 6 1.5 1 20\n");
  EXPECT_TRUE(three.normals.empty());
  expect_attribute(three, "scalar_3", ScalarType::kFloat64, {10, 20});
}

TEST(xyz, lengths_within_a_percent_of_one_are_normals) {
  EXPECT_EQ(parse_points("1 2 3 0 0 1.009\n").normals.size(), 1u);
  EXPECT_EQ(parse_points("1 2 3 0 0 0.991\n").normals.size(), 1u);
  for (const char* text :
       {"1 2 3 0 0 1.011\n", "1 2 3 0 0 0.989\n", "1 2 3 0 0 1\n4 5 6 0 0 .5\n"}) {
    const PointCloud cloud = parse_points(text);
    EXPECT_TRUE(cloud.normals.empty()) << text;
    EXPECT_EQ(cloud.attributes.size(), 3u) << text;
  }
}

TEST(xyz, column_names_are_followed) {
  for (const std::string head :
       {"id,X,Y,Z,NX,NY,NZ,Red,Green,Blue,weight\n", "\"id\" x y z nx ny nz r g b weight\n",
        "# id x y z normal_x normal_y normal_z r g b weight\n",
        "//id;X;Y;Z;Nx;Ny;Nz;R;G;B;weight\r\n"}) {
    SCOPED_TRACE(head);
    const PointCloud cloud =
        parse_points(head + "9,1,2,3,0,0,2,10,20,30,0.5\n8,4,5,6,0,3,0,40,50,60,0.25\n");
    EXPECT_EQ(cloud.points, kPoints);
    EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 2}, {0, 3, 0}}));
    EXPECT_EQ(cloud.attributes.size(), 5u);
    expect_attribute(cloud, "id", ScalarType::kFloat64, {9, 8});
    expect_attribute(cloud, "red", ScalarType::kUint8, {10, 40});
    expect_attribute(cloud, "blue", ScalarType::kUint8, {30, 60});
    expect_attribute(cloud, "weight", ScalarType::kFloat64, {0.5, 0.25});
  }
  EXPECT_EQ(parse_points("Points:0,Points:1,Points:2\n1,2,3\n4,5,6\n").points, kPoints);
  // A comment with another number of words is only a comment.
  EXPECT_TRUE(parse_points("# x y z of the hand\n1 2 3 7\n4 5 6 8\n").attributes[0].name ==
              "scalar_1");
}

TEST(xyz, first_line_may_be_the_number_of_points) {
  EXPECT_EQ(parse_points("2\n1 2 3\n4 5 6\n").points, kPoints);
  const PointCloud pts = parse_points("2\n1 2 3 -5 10 20 30\n4 5 6 -6 1 2 3\n");
  EXPECT_EQ(pts.points, kPoints);
  expect_attribute(pts, "scalar_1", ScalarType::kFloat64, {-5, -6});
  EXPECT_EQ(parse_points("//X Y Z\n2\n1 2 3\n4 5 6\n").points, kPoints);
  expect_refused("3\n1 2 3\n4 5 6\n", {"promises 3 points", "2 follow"});
  expect_refused("1.5\n1 2 3\n4 5 6\n", {"promises 1.5 points"});
}

TEST(xyz, pwn_has_normals_in_either_layout) {
  const PointCloud blocks = parse_points("2\n1 2 3\n4 5 6\n0 0 7\n0 8 0\n");
  EXPECT_EQ(blocks.points, kPoints);
  EXPECT_EQ(blocks.normals, (std::vector<Vec3>{{0, 0, 7}, {0, 8, 0}}));
  const PointCloud rows = parse_points("1 2 3 0 0 7\n4 5 6 0 8 0\n", "a.pwn");
  EXPECT_EQ(rows.normals, (std::vector<Vec3>{{0, 0, 7}, {0, 8, 0}}));
  EXPECT_TRUE(rows.attributes.empty());
}

TEST(xyz, attributes_may_be_left_out) {
  const auto cloud = std::get<PointCloud>(
      parse("1 2 3 0 0 1 7\n4 5 6 0 1 0 8\n", "test", {.attributes = false}).shape);
  EXPECT_EQ(cloud.normals, kNormals);
  EXPECT_TRUE(cloud.attributes.empty());
}

TEST(xyz, broken_rows_are_refused_with_their_line) {
  expect_refused("1 2 3\n4 5\n", {"line 2", "2 values", "3"});
  expect_refused("1 2 3\n4 5 6 7\n", {"line 2", "more values"});
  expect_refused("1 2 3\n4 five 6\n", {"line 2", "'five'"});
  EXPECT_EQ(parse_points("1 2 3 0 0 inf\n4 5 6 0 0 1\n", "a.pwn").normals,
            (std::vector<Vec3>{{}, {0, 0, 1}}));
  expect_refused("1 2\n3 4\n", {"line 1", "3 coordinates"}, "a.xyz");
  expect_refused("a b c d\n1 2 3 4\n", {"x, y, z"}, "a.csv");
  expect_refused("x y z w\n1 2 3\n", {"line 2", "4 columns", "3 values"}, "a.csv");
  expect_refused("# nothing\n\n", {"no points"}, "a.xyz");
  expect_refused("2\n", {"no points"}, "a.xyz");
  expect_refused("hello\nworld\n", {"line 2", "'world'"}, "a.txt");
}

}  // namespace
}  // namespace rholm
