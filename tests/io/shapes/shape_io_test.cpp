#include "rholm/shape_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::expect_refused;
using testing::parse;
using testing::TemporaryFolder;

// Coordinates use every digit: no short decimal fractions, and extremes of the format.
Mesh tetrahedron_with_attributes() {
  Mesh mesh;
  mesh.vertices = {{1.0 / 3, -std::sqrt(2.0), 1e-300},
                   {std::nextafter(1.0, 2.0), 0.1, -0.0},
                   {5e-324, std::numeric_limits<double>::max() / 4, 3},
                   {-1e22, 1e-7, 123456789.123456789}};
  mesh.faces = testing::kTetrahedronTriangles;
  mesh.attributes = {{"red", ScalarType::kUint8, {255, 0, 17, 1}},
                     {"green", ScalarType::kUint8, {0, 128, 3, 255}},
                     {"blue", ScalarType::kUint8, {9, 8, 7, 6}},
                     {"alpha", ScalarType::kUint8, {255, 254, 0, 1}},
                     {"nx", ScalarType::kFloat64, {1.0 / 7, 0, 1, -1}},
                     {"ny", ScalarType::kFloat64, {0, 1, 0, 1e-20}},
                     {"nz", ScalarType::kFloat64, {0.5, 0.25, 0.1, 1}},
                     {"u", ScalarType::kFloat64, {0, 0.1, 0.7, 1}},
                     {"v", ScalarType::kFloat64, {1.0 / 3, 0, 1, 0.5}}};
  return mesh;
}

PointCloud cloud_with_attributes() {
  PointCloud cloud;
  const Mesh mesh = tetrahedron_with_attributes();
  cloud.points = mesh.vertices;
  cloud.normals = {{0, 0, 1}, {0.6, 0.8, 0}, {1.0 / 3, 2, 3}, {1e-3, 0, 7}};
  return cloud;
}

// One attribute of every type, with values at the ends of its range.
std::vector<Attribute> attributes_of_every_type() {
  const double max_float = std::numeric_limits<float>::max();
  return {{"a", ScalarType::kInt8, {-128, 127, 0, 1}},
          {"b", ScalarType::kUint8, {0, 255, 1, 2}},
          {"c", ScalarType::kInt16, {-32768, 32767, 0, 1}},
          {"d", ScalarType::kUint16, {0, 65535, 1, 2}},
          {"e", ScalarType::kInt32, {-2147483648.0, 2147483647, 0, 1}},
          {"f", ScalarType::kUint32, {0, 4294967295.0, 1, 2}},
          {"g", ScalarType::kFloat32, {0.1f, -max_float, 1e-45f, 3}},
          {"h", ScalarType::kFloat64, {0.1, 1e308, 5e-324, -0.0}}};
}

void expect_same_attributes(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].type, b[i].type) << a[i].name;
    EXPECT_EQ(a[i].values, b[i].values) << a[i].name;
  }
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
  expect_same_attributes(a.attributes, b.attributes);
}

void expect_same_cloud(const PointCloud& a, const PointCloud& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  expect_same_attributes(a.attributes, b.attributes);
}

template <class Shape>
Shape round_trip(const Shape& shape, const char* name, const ShapeWriteOptions& options = {}) {
  const TemporaryFolder folder;
  write_shape(shape, folder / name, options);
  EXPECT_EQ(folder.n_files(), 1u);
  return std::get<Shape>(read_shape(folder / name).shape);
}

TEST(shape_io, ply_keeps_every_bit_of_a_mesh) {
  Mesh mesh = tetrahedron_with_attributes();
  for (const Attribute& a : attributes_of_every_type()) mesh.attributes.push_back(a);
  expect_same_mesh(round_trip(mesh, "a.ply"), mesh);
  expect_same_mesh(round_trip(mesh, "a.ply", {.ascii = true}), mesh);
}

TEST(shape_io, ply_keeps_every_bit_of_points) {
  PointCloud cloud = cloud_with_attributes();
  cloud.attributes = attributes_of_every_type();
  expect_same_cloud(round_trip(cloud, "a.ply"), cloud);
  expect_same_cloud(round_trip(cloud, "a.ply", {.ascii = true}), cloud);
  cloud.normals.clear();
  expect_same_cloud(round_trip(cloud, "a.ply"), cloud);
}

TEST(shape_io, negative_zero_survives) {
  for (const char* name : {"a.ply", "a.obj", "a.off"}) {
    EXPECT_TRUE(std::signbit(round_trip(tetrahedron_with_attributes(), name).vertices[1].z));
  }
}

TEST(shape_io, obj_keeps_normals_texture_coordinates_and_colours) {
  Mesh mesh = tetrahedron_with_attributes();
  // Colours come back as fractions, before other attributes. Alpha cannot be stored.
  Mesh expected = mesh;
  expected.attributes.erase(expected.attributes.begin() + 3);
  for (int k = 0; k < 3; ++k) {
    expected.attributes[k].type = ScalarType::kFloat64;
    for (double& value : expected.attributes[k].values) value /= 255;
  }
  expect_same_mesh(round_trip(mesh, "a.obj"), expected);
  // Fractions come back unchanged.
  expect_same_mesh(round_trip(expected, "a.obj"), expected);
  // Writes each kind of attribute alone.
  for (const std::size_t first : {0u, 3u, 6u}) {
    Mesh some = expected;
    some.attributes.assign(expected.attributes.begin() + first,
                           expected.attributes.begin() + std::min<std::size_t>(first + 3, 8));
    expect_same_mesh(round_trip(some, "a.obj"), some);
  }
  mesh.attributes.clear();
  expect_same_mesh(round_trip(mesh, "a.obj"), mesh);
}

TEST(shape_io, obj_writes_texture_coordinates_of_every_usual_name) {
  for (const auto& [u, v] : {std::pair("s", "t"), std::pair("texture_u", "texture_v")}) {
    Mesh mesh = tetrahedron_with_attributes();
    mesh.attributes.erase(mesh.attributes.begin(), mesh.attributes.begin() + 7);
    Mesh expected = mesh;
    mesh.attributes[0].name = u;
    mesh.attributes[1].name = v;
    expect_same_mesh(round_trip(mesh, "a.obj"), expected);
  }
}

TEST(shape_io, off_keeps_normals_and_colours) {
  Mesh mesh = tetrahedron_with_attributes();
  mesh.attributes.resize(7);
  expect_same_mesh(round_trip(mesh, "a.off"), mesh);
  mesh.attributes.erase(mesh.attributes.begin() + 3);  // without alpha
  expect_same_mesh(round_trip(mesh, "a.off"), mesh);
  mesh.attributes.resize(3);  // without normals
  expect_same_mesh(round_trip(mesh, "a.off"), mesh);
  for (Attribute& a : mesh.attributes) {
    a.type = ScalarType::kFloat64;
    for (double& value : a.values) value /= 255;
  }
  expect_same_mesh(round_trip(mesh, "a.off"), mesh);
  mesh.attributes.clear();
  expect_same_mesh(round_trip(mesh, "a.off"), mesh);
}

TEST(shape_io, points_keep_every_bit_in_text_formats) {
  PointCloud cloud = cloud_with_attributes();
  for (const char* name : {"a.obj", "a.off", "a.xyz", "a.pwn", "a.txt"}) {
    SCOPED_TRACE(name);
    expect_same_cloud(round_trip(cloud, name), cloud);
  }
  cloud.normals = {{0, 0, 1}, {0, 1, 0}, {0.6, 0.8, 0}, {0, 0, 0}};
  expect_same_cloud(round_trip(cloud, "a.xyz"), cloud);
  cloud.normals.clear();
  for (const char* name : {"a.obj", "a.off", "a.xyz"}) {
    expect_same_cloud(round_trip(cloud, name), cloud);
  }
}

TEST(shape_io, stl_keeps_the_corners_as_floats) {
  Mesh mesh = tetrahedron_with_attributes();
  mesh.vertices[2].y = 7.1;
  mesh.vertices[2].x = 1e-30;
  for (const bool ascii : {false, true}) {
    const Mesh read = round_trip(mesh, "a.stl", {.ascii = ascii});
    ASSERT_EQ(read.vertices.size(), 12u);
    for (std::size_t t = 0; t < 4; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& v = mesh.vertices[mesh.faces[t][k]];
        const Vec3& r = read.vertices[3 * t + k];
        EXPECT_EQ(static_cast<float>(r.x), static_cast<float>(v.x));
        EXPECT_EQ(static_cast<float>(r.y), static_cast<float>(v.y));
        EXPECT_EQ(static_cast<float>(r.z), static_cast<float>(v.z));
      }
    }
    if (ascii) {  // text keeps all digits
      EXPECT_EQ(read.vertices[0], mesh.vertices[mesh.faces[0][0]]);
      EXPECT_EQ(read.vertices[1], mesh.vertices[mesh.faces[0][1]]);
    }
    // A shape that STL can hold is kept exactly.
    expect_same_mesh(round_trip(read, "a.stl", {.ascii = ascii}), read);
  }
}

TEST(shape_io, stl_normals_are_unit_vectors_to_the_outside) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.vertices = testing::kTetrahedronVertices;
  mesh.faces = testing::kTetrahedronTriangles;
  write_shape(mesh, folder / "a.stl");
  const std::string bytes = testing::read_all(folder / "a.stl");
  ASSERT_EQ(bytes.size(), 84u + 4 * 50);
  EXPECT_FALSE(bytes.starts_with("solid"));
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof(normal));
  EXPECT_EQ(normal[2], -1);
  std::memcpy(normal, bytes.data() + 84 + 150, sizeof(normal));
  for (const float component : normal) EXPECT_FLOAT_EQ(component, 1 / std::sqrt(3.0f));
}

TEST(shape_io, large_shapes_survive_the_blocks_of_readers_and_writers) {
  Mesh mesh;
  const std::uint32_t n = 30000;
  Attribute tag{.name = "tag", .type = ScalarType::kInt32, .values = {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.vertices.push_back({std::sin(i), i * 0.1, -1.0 / (i + 1)});
    tag.values.push_back(i);
  }
  for (std::uint32_t i = 0; i + 2 < n; ++i) mesh.faces.push_back({i, i + 1, i + 2});
  for (const char* name : {"a.obj", "a.off"}) expect_same_mesh(round_trip(mesh, name), mesh);
  mesh.attributes = {tag};
  expect_same_mesh(round_trip(mesh, "a.ply"), mesh);
  expect_same_mesh(round_trip(mesh, "a.ply", {.ascii = true}), mesh);
}

TEST(shape_io, ply_gives_attributes_names_it_can_hold) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}};
  cloud.normals = {{0, 0, 1}};
  for (const char* name : {"x", "nx", "two words", "two_words", "", "line\nend"}) {
    cloud.attributes.push_back({name, ScalarType::kUint8, {7}});
  }
  const PointCloud read = round_trip(cloud, "a.ply");
  std::vector<std::string> names;
  names.reserve(read.attributes.size());
  for (const Attribute& a : read.attributes) names.push_back(a.name);
  EXPECT_EQ(names, (std::vector<std::string>{"x_2", "nx_2", "two_words", "two_words_2", "scalar",
                                             "line_end"}));
  EXPECT_EQ(read.normals, cloud.normals);
}

TEST(shape_io, values_their_type_cannot_hold_are_written_as_double) {
  PointCloud cloud;
  cloud.points = {{1, 2, 3}, {4, 5, 6}};
  cloud.attributes = {{"a", ScalarType::kUint8, {0.5, 1}},
                      {"b", ScalarType::kFloat32, {0.1, 1}},
                      {"c", ScalarType::kInt32, {3e9, 1}}};
  for (const bool ascii : {false, true}) {
    const PointCloud read = round_trip(cloud, "a.ply", {.ascii = ascii});
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(read.attributes[k].type, ScalarType::kFloat64);
      EXPECT_EQ(read.attributes[k].values, cloud.attributes[k].values);
    }
  }
}

// The warning names the attributes before writing, and reading shows that they are missing.
TEST(shape_io, attributes_that_are_left_out_are_told) {
  Mesh mesh = tetrahedron_with_attributes();
  mesh.attributes.push_back({"quality", ScalarType::kFloat64, {1, 2, 3, 4}});
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto expect_left_out = [](const auto& shape, ShapeFormat format) {
    const TemporaryFolder folder;
    write_shape(shape, folder / "a", {.format = format});
    const auto read = read_shape(folder / "a").shape;
    std::vector<std::string> missing;
    for (const Attribute& a : shape.attributes) {
      const bool found = std::visit(
          [&](const auto& it) { return find_attribute(it.attributes, a.name) != nullptr; }, read);
      if (!found) missing.push_back(a.name);
    }
    EXPECT_EQ(attributes_left_out(shape.attributes, format), missing) << to_string(format);
  };
  for (const ShapeFormat format :
       {ShapeFormat::kPly, ShapeFormat::kObj, ShapeFormat::kOff, ShapeFormat::kStl}) {
    expect_left_out(mesh, format);
  }
  expect_left_out(cloud_with_attributes(), ShapeFormat::kXyz);
}

TEST(shape_io, content_decides_before_the_name) {
  const TemporaryFolder folder;
  const Mesh mesh = tetrahedron_with_attributes();
  for (const ShapeFormat format : {ShapeFormat::kPly, ShapeFormat::kObj, ShapeFormat::kOff}) {
    for (const char* name : {"a.stl", "a.xyz", "b", "c.unknown"}) {
      write_shape(mesh, folder / name, {.format = format});
      EXPECT_EQ(read_shape(folder / name).format, format) << name;
    }
  }
  EXPECT_EQ(parse("1 2 3\n4 5 6\n", "points.dat").format, ShapeFormat::kXyz);
  EXPECT_EQ(parse("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off").format, ShapeFormat::kOff);
}

TEST(shape_io, formats_that_are_not_known_are_named) {
  const auto refuse = [](std::string_view bytes, const char* word) {
    expect_error([&] { parse(bytes, "some.file"); }, ErrorCode::kUnsupported, {"some.file", word});
  };
  refuse("\x1f\x8b\x08", "gzip");
  refuse("PK\x03\x04", "zip");
  refuse("glTF", "glTF");
  refuse("\x89HDF\r\n", "HDF5");
  refuse("\xff\xfev\0", "UTF-16");
  refuse("\xfe\xff\0v", "UTF-16");
  refuse("hello", "no known format");
  refuse(std::string_view("\0\0\0", 3), "no known format");
}

TEST(shape_io, empty_files_are_refused) {
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.xyz", "a"}) {
    expect_refused("", {name, "is empty"}, name);
    expect_refused("\xEF\xBB\xBF", {name, "is empty"}, name);
  }
}

TEST(shape_io, names_of_formats_are_read_back) {
  for (const ShapeFormat format : {ShapeFormat::kPly, ShapeFormat::kObj, ShapeFormat::kOff,
                                   ShapeFormat::kStl, ShapeFormat::kXyz}) {
    EXPECT_EQ(parse_shape_format(to_string(format)), format);
  }
  expect_error([] { parse_shape_format("doc"); }, ErrorCode::kUnsupported, {"'doc'", "ply"});
}

// A box of 16 units with corners at odd quarters, far from the origin. Between 2^22 and 2^23 floats
// have steps of 1/2, so that faces a quarter wide collapse.
TEST(shape_io, binary_stl_says_what_single_precision_does) {
  const TemporaryFolder folder;
  Mesh mesh{.vertices = testing::kTetrahedronVertices,
            .faces = testing::kTetrahedronTriangles,
            .attributes = {}};
  for (Vec3& v : mesh.vertices) v = 16.0 * v;
  EXPECT_TRUE(write_shape(mesh, folder / "near.stl").empty());
  for (Vec3& v : mesh.vertices) v.y += 5155487;
  EXPECT_TRUE(write_shape(mesh, folder / "far.ply").empty());
  EXPECT_TRUE(write_shape(mesh, folder / "far.stl", {.ascii = true}).empty());
  const auto far = write_shape(mesh, folder / "far.stl");
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NE(far[0].find("steps of 0.5"), std::string::npos) << far[0];
  EXPECT_EQ(far[0].find("faces lose"), std::string::npos) << far[0];
  // A triangle of height 0.2 loses its area.
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(),
                       {{0, 5155487, 0}, {1, 5155487, 0}, {0.5, 5155487.2, 0}});
  mesh.faces.push_back({n, n + 1, n + 2});
  const auto lost = write_shape(mesh, folder / "far.stl");
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_NE(lost[0].find("1 of 5 faces"), std::string::npos) << lost[0];
}

TEST(shape_io, small_coordinates_beside_others_may_round_to_zero) {
  const TemporaryFolder folder;
  Mesh mesh = tetrahedron_with_attributes();
  mesh.vertices = {{1, 1e-60, 0}, {0, 1, 1e-17}, {1e-300, 0, 1}, {0, 0, 0}};
  EXPECT_NO_THROW(write_shape(mesh, folder / "a.stl"));
}

TEST(shape_io, what_a_format_cannot_hold_is_refused) {
  const TemporaryFolder folder;
  const auto refuse = [&](const auto& shape, const char* name, ErrorCode code, const char* word) {
    expect_error([&] { write_shape(shape, folder / name); }, code, {word});
  };
  Mesh mesh = tetrahedron_with_attributes();
  refuse(cloud_with_attributes(), "a.stl", ErrorCode::kUnsupported, "points");
  refuse(mesh, "a.xyz", ErrorCode::kUnsupported, "faces");
  refuse(mesh, "a.doc", ErrorCode::kUnsupported, "extension");
  refuse(mesh, "a", ErrorCode::kUnsupported, "extension");
  refuse(mesh, "a.stl", ErrorCode::kInvalidInput, "does not fit the floats");
  Mesh tiny = mesh;  // all coordinates would be 0
  for (Vec3& v : tiny.vertices) v = {1e-60, 2e-60, -3e-60};
  refuse(tiny, "a.stl", ErrorCode::kInvalidInput, "does not fit the floats");
  expect_error([&] { write_shape(mesh, "-"); }, ErrorCode::kInvalidInput, {"format"});
  mesh.vertices[0].x = NAN;
  refuse(mesh, "a.ply", ErrorCode::kInvalidInput, "vertex 0");
  mesh = tetrahedron_with_attributes();
  mesh.faces[0][0] = 4;
  refuse(mesh, "a.ply", ErrorCode::kInvalidInput, "vertex 4");
  EXPECT_EQ(folder.n_files(), 0u);
}

TEST(shape_io, empty_shapes_are_written) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.xyz"}) {
    write_shape(Mesh{}, folder / name);
    EXPECT_TRUE(std::filesystem::exists(folder / name));
  }
}

TEST(shape_io, reading_can_be_cancelled) {
  const TemporaryFolder folder;
  testing::write_all(folder / "a.xyz", "1 2 3\n");
  Context context;
  context.progress = [](std::string_view stage, double) { return stage != "read"; };
  expect_error([&] { read_shape(folder / "a.xyz", {}, context); }, ErrorCode::kCancelled);
  expect_error([&] { parse_shape(std::string_view("1 2 3\n"), "a", {}, context); },
               ErrorCode::kCancelled);
}

TEST(shape_io, cancelled_write_leaves_the_old_file) {
  const TemporaryFolder folder;
  testing::write_all(folder / "a.ply", "old");
  Context context;
  context.progress = [](std::string_view stage, double) { return stage != "write"; };
  expect_error([&] { write_shape(tetrahedron_with_attributes(), folder / "a.ply", {}, context); },
               ErrorCode::kCancelled);
  EXPECT_EQ(testing::read_all(folder / "a.ply"), "old");
  EXPECT_EQ(folder.n_files(), 1u);
}

TEST(shape_io, progress_of_reading_rises_to_one) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.vertices.resize(300000);
  mesh.faces.resize(300000);
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    write_shape(mesh, folder / name);
    double last = 0;
    Context context;
    context.progress = [&](std::string_view, double fraction) {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1);
      last = fraction;
      return true;
    };
    read_shape(folder / name, {}, context);
    EXPECT_GT(last, 0.95) << name;
  }
}

// Every file of the writers is cut at every byte. The reader throws an error or returns a valid
// shape, because cut text may be complete. It never crashes or uses memory beyond the size of the
// file. Binary files and files that state their counts must be refused.
TEST(shape_io, files_cut_at_any_byte_do_no_harm) {
  const TemporaryFolder folder;
  Mesh mesh = tetrahedron_with_attributes();
  mesh.vertices[2] = {1, 2, 3};
  PointCloud cloud = cloud_with_attributes();
  cloud.points[2] = {1, 2, 3};
  struct Variant {
    const char* name;
    bool ascii;
    bool counted;
  };
  for (const auto& [name, ascii, is_counted] :
       {Variant{"a.ply", false, true}, Variant{"a.ply", true, false}, Variant{"a.obj", true, false},
        Variant{"a.off", true, false}, Variant{"a.stl", false, true}, Variant{"a.stl", true, false},
        Variant{"a.xyz", true, false}}) {
    const ShapeWriteOptions options{.format = {}, .ascii = ascii};
    if (std::string(name) == "a.xyz") {
      write_shape(cloud, folder / name, options);
    } else {
      write_shape(mesh, folder / name, options);
    }
    const std::string whole = testing::read_all(folder / name);
    for (std::size_t n = 0; n < whole.size(); ++n) {
      const std::vector<char> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n));
      try {
        const ShapeFile file = parse_shape(part, name);
        std::visit([](const auto& shape) { validate(shape); }, file.shape);
        EXPECT_FALSE(is_counted) << name << " cut to " << n << " of " << whole.size();
      } catch (const Error& refused) {
        EXPECT_STRNE(refused.what(), "") << name << " cut to " << n;
      }
    }
  }
}

// Does the same with the seeds of the fuzzers, which are files of every variant.
TEST(shape_io, seeds_cut_at_any_byte_do_no_harm) {
  const std::filesystem::path seeds =
      std::filesystem::path(RHOLM_TEST_DATA) / "../../../fuzz/seeds";
  std::size_t n_files = 0;
  for (const char* reader : {"ply", "obj", "off", "stl", "xyz"}) {
    for (const auto& entry : std::filesystem::directory_iterator(seeds / reader)) {
      const std::string whole = testing::read_all(entry.path());
      SCOPED_TRACE(entry.path());
      ++n_files;
      for (std::size_t n = 0; n <= whole.size(); ++n) {
        const std::vector<char> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n));
        try {
          const ShapeFile file = parse_shape(part, entry.path().filename().string());
          std::visit([](const auto& shape) { validate(shape); }, file.shape);
        } catch (const Error& refused) {
          EXPECT_STRNE(refused.what(), "") << entry.path() << " cut to " << n;
        }
      }
    }
  }
  EXPECT_GE(n_files, 50u);
}

}  // namespace
}  // namespace rholm
