#include <gtest/gtest.h>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::BytesBuilder;
using testing::expect_refused;
using testing::expect_tetrahedron;
using testing::parse;
using testing::parse_mesh;
using testing::parse_points;
using testing::volume_of;

const std::string kAsciiHead = "ply\nformat ascii 1.0\n";
const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";
const std::string kVertexRows = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kFaceRows = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string ascii_tetrahedron() {
  return kAsciiHead + "element vertex 4\n" + kXyz + "element face 4\n" + kFaces + "end_header\n" +
         kVertexRows + kFaceRows;
}

std::string with_line_ends(const std::string& text, const std::string& line_end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? line_end : std::string(1, c);
  return result;
}

// Returns the header of a binary file in either byte order.
std::string binary_head(bool big) {
  return std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n";
}

template <class Scalar>
void put_tetrahedron_vertices(BytesBuilder& out) {
  for (const Vec3& v : testing::kTetrahedronVertices) out.put<Scalar>(v.x, v.y, v.z);
}

template <class Count, class Index>
void put_tetrahedron_faces(BytesBuilder& out) {
  for (const Triangle& t : testing::kTetrahedronTriangles) {
    out.put<Count>(3).template put<Index>(t[0], t[1], t[2]);
  }
}

template <class Scalar, class Count, class Index>
std::string binary_tetrahedron(bool big, const std::string& scalar, const std::string& count,
                               const std::string& index) {
  BytesBuilder out(big);
  out.text(binary_head(big) + "element vertex 4\nproperty " + scalar + " x\nproperty " + scalar +
           " y\nproperty " + scalar + " z\nelement face 4\nproperty list " + count + " " + index +
           " vertex_index\nend_header\n");
  put_tetrahedron_vertices<Scalar>(out);
  put_tetrahedron_faces<Count, Index>(out);
  return out.bytes();
}

TEST(ply, ascii_is_read) {
  const ShapeFile file = parse(ascii_tetrahedron());
  EXPECT_EQ(file.format, ShapeFormat::kPly);
  EXPECT_EQ(file.encoding, "ascii");
  EXPECT_TRUE(file.warnings.empty());
  expect_tetrahedron(std::get<Mesh>(file.shape));
}

TEST(ply, all_line_ends_are_read) {
  expect_tetrahedron(parse_mesh(with_line_ends(ascii_tetrahedron(), "\r\n")));
  expect_tetrahedron(parse_mesh(with_line_ends(ascii_tetrahedron(), "\r")));
}

TEST(ply, last_line_end_may_be_missing) {
  const std::string text = ascii_tetrahedron();
  expect_tetrahedron(parse_mesh(text.substr(0, text.size() - 1)));
}

TEST(ply, all_scalar_types_in_both_spellings_and_orders_are_read) {
  for (const bool big : {false, true}) {
    SCOPED_TRACE(big);
    using I8 = std::int8_t;
    using U8 = std::uint8_t;
    using I16 = std::int16_t;
    using U16 = std::uint16_t;
    using I32 = std::int32_t;
    using U32 = std::uint32_t;
    const std::vector<std::string> files = {
        binary_tetrahedron<I8, I8, I8>(big, "char", "char", "char"),
        binary_tetrahedron<U8, U8, U8>(big, "uchar", "uchar", "uchar"),
        binary_tetrahedron<I16, I16, I16>(big, "short", "short", "short"),
        binary_tetrahedron<U16, U16, U16>(big, "ushort", "ushort", "ushort"),
        binary_tetrahedron<I32, I32, I32>(big, "int", "int", "int"),
        binary_tetrahedron<U32, U32, U32>(big, "uint", "uint", "uint"),
        binary_tetrahedron<float, U8, I32>(big, "float", "uchar", "int"),
        binary_tetrahedron<double, U8, U32>(big, "double", "uchar", "uint"),
        binary_tetrahedron<I8, I8, I8>(big, "int8", "int8", "int8"),
        binary_tetrahedron<U8, U8, U8>(big, "uint8", "uint8", "uint8"),
        binary_tetrahedron<I16, I16, I16>(big, "int16", "int16", "int16"),
        binary_tetrahedron<U16, U16, U16>(big, "uint16", "uint16", "uint16"),
        binary_tetrahedron<I32, I32, I32>(big, "int32", "int32", "int32"),
        binary_tetrahedron<U32, U32, U32>(big, "uint32", "uint32", "uint32"),
        binary_tetrahedron<float, I8, I32>(big, "float32", "int8", "int32"),
        binary_tetrahedron<double, U16, I16>(big, "float64", "uint16", "int16")};
    for (const std::string& bytes : files) {
      SCOPED_TRACE(bytes.substr(0, 120));
      const ShapeFile file = parse(bytes);
      EXPECT_EQ(file.encoding, big ? "binary big endian" : "binary little endian");
      expect_tetrahedron(std::get<Mesh>(file.shape));
    }
  }
}

TEST(ply, every_column_keeps_its_type_sign_and_exact_value) {
  for (const bool big : {false, true}) {
    BytesBuilder out(big);
    out.text(binary_head(big) +
             "element vertex 1\nproperty char a\nproperty uchar b\nproperty double z\nproperty "
             "short c\nproperty ushort d\nproperty float y\nproperty int e\nproperty uint f\n"
             "property float g\nproperty double h\nproperty float x\nend_header\n");
    out.put<std::int8_t>(-100).put<std::uint8_t>(200).put<double>(3.1).put<std::int16_t>(-30000);
    out.put<std::uint16_t>(60000).put<float>(2.5).put<std::int32_t>(-2000000000);
    out.put<std::uint32_t>(4000000000u).put<float>(0.1f).put<double>(0.1).put<float>(1.5);
    const PointCloud cloud = parse_points(out.bytes());
    EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1.5, 2.5, 3.1}}));
    const std::vector<Attribute> expected = {
        {"a", ScalarType::kInt8, {-100}},         {"b", ScalarType::kUint8, {200}},
        {"c", ScalarType::kInt16, {-30000}},      {"d", ScalarType::kUint16, {60000}},
        {"e", ScalarType::kInt32, {-2000000000}}, {"f", ScalarType::kUint32, {4000000000}},
        {"g", ScalarType::kFloat32, {0.1f}},      {"h", ScalarType::kFloat64, {0.1}}};
    ASSERT_EQ(cloud.attributes.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(cloud.attributes[i].name, expected[i].name);
      EXPECT_EQ(cloud.attributes[i].type, expected[i].type) << expected[i].name;
      EXPECT_EQ(cloud.attributes[i].values, expected[i].values) << expected[i].name;
    }
  }
}

TEST(ply, blocks_of_rows_join_without_a_seam) {
  // There are more rows than one block holds. The x of row i is i, so that any shift is seen.
  const std::size_t n = 5000;
  BytesBuilder out;
  out.text(binary_head(false) + "element vertex 5000\n" + kXyz +
           "property uchar tag\nelement face 4998\n" + kFaces + "end_header\n");
  for (std::size_t i = 0; i < n; ++i) out.put<float>(i, 2 * i, 3 * i).put<std::uint8_t>(i % 251);
  for (std::size_t i = 0; i + 2 < n; ++i) {
    out.put<std::uint8_t>(3).put<std::int32_t>(i, i + 1, i + 2);
  }
  const Mesh mesh = parse_mesh(out.bytes());
  ASSERT_EQ(mesh.vertices.size(), n);
  ASSERT_EQ(mesh.faces.size(), n - 2);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i);
    ASSERT_EQ(mesh.vertices[i], (Vec3{x, 2 * x, 3 * x}));
    ASSERT_EQ(mesh.attributes[0].values[i], static_cast<double>(i % 251));
  }
  for (std::uint32_t i = 0; i + 2 < n; ++i) {
    ASSERT_EQ(mesh.faces[i], (Triangle{i, i + 1, i + 2}));
  }
}

TEST(ply, blocks_of_rows_with_lists_join_without_a_seam) {
  const std::size_t n = 2500;
  BytesBuilder out;
  out.text(binary_head(false) + "element vertex 2500\n" + kXyz +
           "property list uchar short l\nend_header\n");
  for (std::size_t i = 0; i < n; ++i) {
    out.put<float>(i, 2 * i, 3 * i).put<std::uint8_t>(i % 3);
    for (std::size_t k = 0; k < i % 3; ++k) out.put<std::int16_t>(-1);
  }
  const PointCloud cloud = parse_points(out.bytes());
  ASSERT_EQ(cloud.points.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i);
    ASSERT_EQ(cloud.points[i], (Vec3{x, 2 * x, 3 * x}));
  }
}

TEST(ply, unknown_elements_and_lists_are_passed_over) {
  const std::string header =
      "comment a comment\nobj_info anything\nelement junk 2\nproperty list uchar float weights\n"
      "property int id\nelement fixed 3\nproperty short s\nelement nothing 4000000000\n"
      "element vertex 4\nproperty list uchar int neighbours\n" +
      kXyz + "element face 4\nproperty uchar flags\n" + kFaces +
      "property list uchar float texcoord\nend_header\n";
  const auto check = [](const ShapeFile& file) {
    expect_tetrahedron(std::get<Mesh>(file.shape));
    EXPECT_EQ(file.warnings,
              (std::vector<std::string>{"element 'junk' with 2 rows passed over",
                                        "element 'fixed' with 3 rows passed over",
                                        "element 'nothing' with 4000000000 rows passed over",
                                        "2 properties of element 'face' passed over",
                                        "1 list property of the vertices passed over"}));
  };
  check(parse(kAsciiHead + header + "2 0.5 1e3 7\n0 8\n1\n2\n3\n" +
              "1 5 0 0 0\n0 1 0 0\n2 1 2 0 1 0\n0 0 0 1\n" +
              "9 3 0 2 1 2 .5 .5\n9 3 0 1 3 0\n9 3 0 3 2 0\n9 3 1 2 3 1 0\n"));
  for (const bool big : {false, true}) {
    BytesBuilder out(big);
    out.text(binary_head(big) + header);
    out.put<std::uint8_t>(2).put<float>(0.5, 1e3).put<std::int32_t>(7);
    out.put<std::uint8_t>(0).put<std::int32_t>(8).put<std::int16_t>(1, 2, 3);
    for (const Vec3& v : testing::kTetrahedronVertices) {
      out.put<std::uint8_t>(1).put<std::int32_t>(5).put<float>(v.x, v.y, v.z);
    }
    for (const Triangle& t : testing::kTetrahedronTriangles) {
      out.put<std::uint8_t>(9, 3).put<std::int32_t>(t[0], t[1], t[2]);
      out.put<std::uint8_t>(2).put<float>(0.5, 0.5);
    }
    check(parse(out.bytes()));
  }
}

TEST(ply, faces_may_come_before_vertices) {
  expect_tetrahedron(parse_mesh(kAsciiHead + "element face 4\n" + kFaces + "element vertex 4\n" +
                                kXyz + "end_header\n" + kFaceRows + kVertexRows));
}

TEST(ply, polygons_become_triangles_of_the_same_solid) {
  const std::string cube_rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
  const std::string quads =
      "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n3 1 2 6\n3 1 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const Mesh cube = parse_mesh(kAsciiHead + "element vertex 8\n" + kXyz + "element face 7\n" +
                               kFaces + "end_header\n" + cube_rows + quads);
  EXPECT_EQ(cube.faces.size(), 12u);
  EXPECT_DOUBLE_EQ(volume_of(cube), 1);
  // The order of the faces is kept: two triangles take the place of the quad.
  EXPECT_EQ(cube.faces[6], (Triangle{1, 2, 6}));
  EXPECT_EQ(cube.faces[7], (Triangle{1, 6, 5}));

  BytesBuilder out;
  out.text(binary_head(false) + "element vertex 8\n" + kXyz + "element face 7\n" + kFaces +
           "end_header\n");
  for (int i = 0; i < 8; ++i) {
    out.put<float>(i % 4 == 1 || i % 4 == 2, i % 4 >= 2, i / 4);
  }
  out.put<std::uint8_t>(3).put<std::int32_t>(1, 2, 6);
  out.put<std::uint8_t>(4).put<std::int32_t>(0, 3, 2, 1).put<std::uint8_t>(4);
  out.put<std::int32_t>(4, 5, 6, 7).put<std::uint8_t>(4).put<std::int32_t>(0, 1, 5, 4);
  out.put<std::uint8_t>(3).put<std::int32_t>(1, 6, 5);
  out.put<std::uint8_t>(4).put<std::int32_t>(2, 3, 7, 6);
  out.put<std::uint8_t>(4).put<std::int32_t>(3, 0, 4, 7);
  const Mesh binary = parse_mesh(out.bytes());
  EXPECT_EQ(binary.faces.size(), 12u);
  EXPECT_DOUBLE_EQ(volume_of(binary), 1);
}

TEST(ply, faces_with_fewer_than_three_corners_are_skipped_and_counted) {
  const ShapeFile file = parse(
      kAsciiHead + "element vertex 4\n" + kXyz + "element face 8\n" + kFaces + "end_header\n" +
      kVertexRows + "3 0 2 1\n0\n3 0 1 3\n1 2\n2 0 1\n4 1 1 2 2\n" + "5 0 0 3 2 0\n3 1 2 3\n");
  expect_tetrahedron(std::get<Mesh>(file.shape));
  EXPECT_EQ(file.warnings, (std::vector<std::string>{"4 faces with fewer than 3 corners skipped"}));
}

TEST(ply, triangle_strips_alternate_and_restart) {
  // 0 1 2 3 stands for the triangles 0 1 2 and 2 1 3. A repeated corner only joins strips.
  const std::string head = kAsciiHead + "element vertex 5\n" + kXyz +
                           "element tristrips 2\nproperty list int int vertex_indices\n"
                           "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
  const Mesh strip = parse_mesh(head + "9 0 1 2 3 4 -1 1 3 2\n6 0 1 2 2 3 4\n");
  EXPECT_EQ(strip.faces, (std::vector<Triangle>{
                             {0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {1, 3, 2}, {0, 1, 2}, {3, 2, 4}}));
  BytesBuilder out(true);
  out.text(binary_head(true) + "element vertex 4\n" + kXyz +
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n");
  put_tetrahedron_vertices<float>(out);
  out.put<std::int32_t>(8, 0, 2, 1, 3, -1, 0, 3, 2);
  const Mesh tetrahedron = parse_mesh(out.bytes());
  EXPECT_EQ(tetrahedron.faces, (std::vector<Triangle>{{0, 2, 1}, {1, 2, 3}, {0, 3, 2}}));
  expect_refused(head + "3 0 1 5\n0\n", {"names vertex 5", "5 vertices"});
  expect_refused(head + "3 0 1 -2\n0\n", {"names vertex -2"});
}

TEST(ply, without_faces_is_points_with_normals) {
  const std::string text = kAsciiHead + "element vertex 2\n" + kXyz +
                           "property float nx\nproperty float ny\nproperty float nz\nproperty "
                           "uchar red\nelement face 0\n" +
                           kFaces + "end_header\n1 2 3 0 0 1 255\n4 5 6 0.5 0 0 7\n";
  const PointCloud cloud = parse_points(text);
  EXPECT_EQ(cloud.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.normals, (std::vector<Vec3>{{0, 0, 1}, {0.5, 0, 0}}));
  ASSERT_EQ(cloud.attributes.size(), 1u);
  EXPECT_EQ(cloud.attributes[0].name, "red");
  EXPECT_EQ(cloud.attributes[0].values, (std::vector<double>{255, 7}));
  const auto bare = std::get<PointCloud>(parse(text, "test", {.attributes = false}).shape);
  EXPECT_EQ(bare.normals, cloud.normals);
  EXPECT_TRUE(bare.attributes.empty());
}

TEST(ply, normals_of_a_mesh_are_attributes) {
  const Mesh mesh = parse_mesh(kAsciiHead + "element vertex 3\n" + kXyz +
                               "property float nx\nproperty float ny\nproperty float nz\nelement "
                               "face 1\n" +
                               kFaces +
                               "end_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n"
                               "3 0 1 2\n");
  ASSERT_EQ(mesh.attributes.size(), 3u);
  EXPECT_EQ(mesh.attributes[2].name, "nz");
  EXPECT_EQ(mesh.attributes[2].values, (std::vector<double>{1, 1, 1}));
}

TEST(ply, text_values_beyond_their_type_are_kept_as_double) {
  const ShapeFile file = parse(kAsciiHead + "element vertex 2\n" + kXyz +
                               "property uchar red\nproperty float t\nproperty float huge\n"
                               "property int whole\nend_header\n"
                               "0.1 0 0 256 0.1 1e300 1\n1 0 0 3 0.2 0 2\n");
  const auto& a = std::get<PointCloud>(file.shape).attributes;
  ASSERT_EQ(a.size(), 4u);
  EXPECT_EQ(a[0].type, ScalarType::kFloat64);
  EXPECT_EQ(a[0].values, (std::vector<double>{256, 3}));
  EXPECT_EQ(a[1].type, ScalarType::kFloat32);  // the float nearest to the text
  EXPECT_EQ(a[1].values, (std::vector<double>{0.1f, 0.2f}));
  EXPECT_EQ(a[2].type, ScalarType::kFloat64);
  EXPECT_EQ(a[2].values, (std::vector<double>{1e300, 0}));
  EXPECT_EQ(a[3].type, ScalarType::kInt32);
  EXPECT_EQ(file.warnings.size(), 2u);
  // Positions keep all digits of the text.
  EXPECT_EQ(std::get<PointCloud>(file.shape).points[0].x, 0.1);
}

TEST(ply, attribute_that_is_not_a_number_is_kept_with_a_warning) {
  const ShapeFile file = parse(kAsciiHead + "element vertex 2\n" + kXyz +
                               "property float quality\nend_header\n0 0 0 nan\n1 0 0 inf\n");
  EXPECT_EQ(
      file.warnings,
      (std::vector<std::string>{"attribute 'quality' has 2 values that are not finite numbers"}));
}

TEST(ply, points_that_are_not_finite_are_dropped) {
  const std::string head = kAsciiHead + "element vertex 2\n" + kXyz + "end_header\n0 0 0\n";
  for (const char* row : {"0 nan 0\n", "0 0 -inf\n"}) {
    const ShapeFile file = parse(head + row);
    EXPECT_EQ(file.dropped, 1u);
    EXPECT_EQ(std::get<PointCloud>(file.shape).points, (std::vector<Vec3>{{}}));
  }
  expect_refused(head + "0 0 1e999\n", {"line 9", "'1e999'", "not a number"});
}

TEST(ply, vertices_of_faces_that_are_not_finite_are_refused) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    BytesBuilder out;
    out.text(binary_head(false) + "element vertex 2000\n" + kXyz + faces);
    for (int i = 0; i < 2000; ++i) out.put<float>(1, 2, i == 1500 ? bad : 3);
    out.put<std::uint8_t>(3).put<std::int32_t>(0, 1, 2);
    expect_refused(out.bytes(), {"vertex 1500"});
  }
}

TEST(ply, indices_out_of_range_are_refused_with_their_face) {
  const std::string head = kAsciiHead + "element vertex 3\n" + kXyz + "element face 2\n" + kFaces +
                           "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_refused(head + "3 0 1 3\n", {"face 1", "vertex 3", "3 vertices"});
  expect_refused(head + "3 0 1 -1\n", {"face 1", "vertex -1"});
  expect_refused(head + "3 0 1 1.5\n", {"line 14", "'1.5'", "not an integer"});
  expect_refused(head + "-3 0 1 2\n", {"length -3"});
  for (const std::int32_t bad : {3, -1, 2147483647}) {
    BytesBuilder out;
    out.text(binary_head(false) + "element vertex 3\n" + kXyz + "element face 2\n" + kFaces +
             "end_header\n");
    out.put<float>(0, 0, 0, 1, 0, 0, 0, 1, 0).put<std::uint8_t>(3).put<std::int32_t>(0, 1, 2);
    out.put<std::uint8_t>(3).put<std::int32_t>(0, bad, 2);
    expect_refused(out.bytes(), {"face 1", "names vertex"});
  }
  BytesBuilder negative;
  negative.text(binary_head(false) + "element vertex 1\n" + kXyz +
                "element face 1\nproperty list char int vertex_indices\nend_header\n");
  negative.put<float>(0, 0, 0).put<std::int8_t>(-3).put<std::int32_t>(0, 0, 0);
  expect_refused(negative.bytes(), {"length -3"});
}

TEST(ply, counts_beyond_the_file_are_refused_before_memory_is_taken) {
  for (const std::string count : {"5", "4000000000", "18446744073709551615"}) {
    SCOPED_TRACE(count);
    const std::string vertex = "element vertex " + count + "\n" + kXyz;
    expect_refused(kAsciiHead + vertex + "end_header\n" + kVertexRows, {});
    const std::string faces =
        "element vertex 4\n" + kXyz + "element face " + count + "\n" + kFaces + "end_header\n";
    expect_refused(kAsciiHead + faces + kVertexRows + kFaceRows, {"truncated"});
    BytesBuilder vertices;
    vertices.text(binary_head(false) + vertex + "end_header\n");
    put_tetrahedron_vertices<float>(vertices);
    expect_refused(vertices.bytes(), {});
    BytesBuilder out;
    out.text(binary_head(false) + faces);
    put_tetrahedron_vertices<float>(out);
    put_tetrahedron_faces<std::uint8_t, std::int32_t>(out);
    expect_refused(out.bytes(), {"truncated"});
  }
  // The list claims more values than the file holds.
  BytesBuilder list;
  list.text(binary_head(false) + "element vertex 1\n" + kXyz +
            "element face 1\nproperty list uint int vertex_indices\nend_header\n");
  list.put<float>(0, 0, 0).put<std::uint32_t>(4000000000u).put<std::int32_t>(0, 0, 0);
  expect_refused(list.bytes(), {"truncated"});
  expect_refused(kAsciiHead + "element vertex 1\n" + kXyz + "element face 1\n" + kFaces +
                     "end_header\n0 0 0\n4000000000 0 0 0\n",
                 {"truncated"});
  expect_refused(kAsciiHead + "element e 4000000000\nproperty list uint int a\nelement vertex 1\n" +
                     kXyz + "end_header\n0 0 0 0\n",
                 {"truncated"});
}

TEST(ply, broken_headers_are_refused_with_their_line) {
  const std::string body = "end_header\n0 0 0\n";
  expect_refused("ply\nformat ascii 1.0\n", {"line 3", "end_header"});
  expect_refused("ply\n" + ("element vertex 1\n" + kXyz + body), {"no format line"});
  expect_refused("ply\nformat text 1.0\nelement vertex 1\n" + kXyz + body, {"line 2", "ascii"});
  expect_refused(kAsciiHead + "element vertex\n" + kXyz + body, {"line 3", "a name and a count"});
  expect_refused(kAsciiHead + "element vertex -1\n" + kXyz + body, {"line 3"});
  expect_refused(kAsciiHead + "element vertex 1x\n" + kXyz + body, {"line 3"});
  expect_refused(kAsciiHead + "property float x\n" + body, {"line 3", "before the first element"});
  expect_refused(kAsciiHead + "element vertex 1\n" + kXyz + kXyz + body,
                 {"line 7", "'x' appears twice"});
  expect_refused(kAsciiHead + "element vertex 1\n" + kXyz + "element vertex 1\n" + body,
                 {"line 7", "appears twice"});
  expect_refused(kAsciiHead + "element vertex 1\nproperty float128 x\n" + body,
                 {"line 4", "'float128'", "is not a type"});
  expect_refused(kAsciiHead + "element vertex 1\nproperty list float int x\n" + body,
                 {"line 4", "integer type"});
  expect_refused(kAsciiHead + "element vertex 1\nproperty float\n" + body, {"line 4", "name"});
  expect_refused(kAsciiHead + "what is this\n" + body, {"line 3", "'what'"});
  expect_refused(kAsciiHead + "element vertex 1\n" + kXyz + "end_header 0 0 0\n", {"end_header"});
  expect_refused(kAsciiHead + "element vertex 1\nproperty float x\nproperty float y\n" + body,
                 {"x, y, z"});
  expect_refused(kAsciiHead + "element face 1\n" + kFaces + "end_header\n3 0 1 2\n",
                 {"no vertices"});
  expect_refused(kAsciiHead + "element vertex 0\n" + kXyz + "end_header\n", {"no vertices"});
  expect_refused(kAsciiHead + "element vertex 1\n" + kXyz +
                     "element face 1\nproperty list uchar float vertex_indices\n" + body + "0\n",
                 {"'face'", "vertex_indices"});
  expect_refused("plywood", {"does not begin with 'ply'"}, "a.ply");
}

TEST(ply, words_that_are_not_numbers_are_refused_with_their_line) {
  const std::string head = kAsciiHead + "element vertex 2\n" + kXyz + "end_header\n";
  expect_refused(head + "0 0 0\n0 zero 0\n", {"line 9", "'zero'", "not a number"});
  expect_refused(head + "0 0 0\n0 1.5x 0\n", {"line 9", "'1.5x'"});
  expect_refused(head + "0 0 0\n0 0", {"truncated", "'vertex'"});
}

TEST(ply, bytes_after_the_last_element_are_noted) {
  EXPECT_EQ(parse(ascii_tetrahedron() + "more").warnings,
            (std::vector<std::string>{"4 bytes after the last element passed over"}));
  EXPECT_TRUE(parse(ascii_tetrahedron() + "\n \n").warnings.empty());
}

}  // namespace
}  // namespace rholm
