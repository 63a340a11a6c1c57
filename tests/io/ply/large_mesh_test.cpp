#include "rholm/large_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/shapes/test_support.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::read_all;
using testing::TemporaryFolder;

TEST(large_mesh, a_survey_knows_the_measures_of_a_box) {
  const TemporaryFolder folder;
  Mesh mesh = box({2, 3, 4}, 30);
  for (Vec3& v : mesh.vertices) v += Vec3{1, 2, 3};
  write_shape(mesh, folder / "m.ply");
  const std::optional<MappedMesh> map = map_mesh(folder / "m.ply");
  ASSERT_TRUE(map);
  for (const int threads : {1, 3}) {
    const MeshSurvey survey = survey_mesh(*map, {.threads = threads});
    EXPECT_TRUE(survey.closed);
    EXPECT_NEAR(survey.area, 52, 1e-12);
    EXPECT_NEAR(survey.volume, 24, 1e-12);
    EXPECT_NEAR(norm(survey.volume_centroid - Vec3{1, 2, 3}), 0, 1e-13);
    EXPECT_EQ(survey.bounds.min, Vec3(0, 0.5, 1));
    EXPECT_EQ(survey.bounds.max, Vec3(2, 3.5, 5));
  }
}

TEST(large_mesh, an_open_mesh_is_not_closed) {
  const TemporaryFolder folder;
  Mesh mesh = icosphere(2);
  mesh.faces.pop_back();
  write_shape(mesh, folder / "m.ply");
  EXPECT_FALSE(survey_mesh(*map_mesh(folder / "m.ply")).closed);
}

// Writes the mesh of that file in all formats, once read into memory and once mapped.
void expect_same_files(const TemporaryFolder& folder, const std::filesystem::path& path) {
  const std::optional<MappedMesh> map = map_mesh(path);
  ASSERT_TRUE(map);
  EXPECT_TRUE(has_triangles_only(*map));
  const ShapeFile file = read_shape(path);
  const auto& mesh = std::get<Mesh>(file.shape);
  EXPECT_EQ(has_attributes(*map), !mesh.attributes.empty());
  EXPECT_EQ(attribute_warnings(*map), file.warnings);
  const std::vector<Attribute> described = described_attributes(*map);
  ASSERT_EQ(described.size(), mesh.attributes.size());
  for (std::size_t k = 0; k < described.size(); ++k) {
    EXPECT_EQ(described[k].name, mesh.attributes[k].name);
    EXPECT_EQ(described[k].type, mesh.attributes[k].type);
  }
  for (const char* name : {"x.ply", "x.obj", "x.off", "x.stl"}) {
    for (const bool ascii : {false, true}) {
      write_shape(mesh, folder / (std::string("memory_") + name).c_str(), {.ascii = ascii});
      write_shape(*map, folder / (std::string("mapped_") + name).c_str(), {.ascii = ascii});
      EXPECT_EQ(read_all(folder / (std::string("memory_") + name).c_str()),
                read_all(folder / (std::string("mapped_") + name).c_str()))
          << name;
    }
  }
  expect_error([&] { write_shape(*map, folder / "x.xyz"); }, ErrorCode::kUnsupported, {"XYZ"});
}

TEST(large_mesh, is_written_as_a_mesh_in_memory_is) {
  const TemporaryFolder folder;
  Mesh mesh = latitude_longitude_sphere(260, 260);  // several blocks of vertices
  Attribute height{.name = "height", .type = ScalarType::kFloat64, .values = {}};
  for (const Vec3& v : mesh.vertices) height.values.push_back(v.z);
  mesh.attributes.push_back(std::move(height));
  write_shape(mesh, folder / "m.ply");
  expect_same_files(folder, folder / "m.ply");
}

// Normals, colours with and without opacity, texture coordinates, all types, and NaN as
// values.
TEST(large_mesh, is_written_with_its_attributes) {
  const TemporaryFolder folder;
  Mesh mesh = latitude_longitude_sphere(30, 30);
  const auto add = [&](const char* name, ScalarType type, double first, double step) {
    std::vector<double> values;
    values.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      values.push_back(first + step * static_cast<double>(i % 100));
    }
    mesh.attributes.push_back({.name = name, .type = type, .values = std::move(values)});
  };
  add("i8", ScalarType::kInt8, -100, 1);
  add("nx", ScalarType::kFloat32, -0.5, 0.25);
  add("ny", ScalarType::kFloat64, -0.1, 0.1);
  add("nz", ScalarType::kFloat32, 1, 0.5);
  add("red", ScalarType::kUint8, 0, 2);
  add("green", ScalarType::kUint8, 255, -2);
  add("blue", ScalarType::kUint8, 3, 0);
  write_shape(mesh, folder / "colors.ply");
  expect_same_files(folder, folder / "colors.ply");
  add("alpha", ScalarType::kUint8, 7, 1);
  add("s", ScalarType::kFloat32, 0, 0.125);
  add("t", ScalarType::kFloat64, 1, -0.01);
  add("i16", ScalarType::kInt16, -30000, 500);
  add("u16", ScalarType::kUint16, 0, 600);
  add("i32", ScalarType::kInt32, -2e9, 4e7);
  add("u32", ScalarType::kUint32, 0, 4e7);
  mesh.attributes[1].values[5] = NAN;
  mesh.attributes[9].values[100] = mesh.attributes[9].values[200] = INFINITY;
  write_shape(mesh, folder / "all.ply");
  expect_same_files(folder, folder / "all.ply");
}

// Attributes of other programs also come before the coordinates.
TEST(large_mesh, is_written_with_attributes_on_both_sides_of_its_coordinates) {
  const TemporaryFolder folder;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty uchar label\n"
      "property float x\nproperty float y\nproperty float z\nproperty double quality\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  for (int i = 0; i < 4; ++i) {
    put(static_cast<std::uint8_t>(200 + i));
    for (int k = 0; k < 3; ++k) put(static_cast<float>(i == k ? 1 : 0.25 * i));
    put(0.1 * i);
  }
  for (const int first : {0, 1}) {
    put(std::uint8_t{3});
    for (int k = 0; k < 3; ++k) put(static_cast<std::int32_t>(first + k));
  }
  testing::write_all(folder / "m.ply", bytes);
  expect_same_files(folder, folder / "m.ply");
}

// A binary PLY file with an attribute and faces of any number of corners on the points of a
// lattice. Some faces have their corners in no order.
std::string polygons(std::size_t n_faces, const std::string& more = {}) {
  constexpr int kSide = 20;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 400\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nelement face " +
      std::to_string(n_faces) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  for (int i = 0; i < kSide * kSide; ++i) {
    put(static_cast<float>(i % kSide));
    put(static_cast<float>(i / kSide));  // NOLINT(bugprone-integer-division): a row
    put(0.1F * static_cast<float>(i * 7 % 11));
    put(static_cast<std::uint8_t>(i));
  }
  for (std::size_t face = 0; face < n_faces; ++face) {
    const std::size_t n = face % 97 == 0 ? 255 : face * face % 9;
    put(static_cast<std::uint8_t>(n));
    for (std::size_t k = 0; k < n; ++k) {
      put(static_cast<std::uint32_t>((face * 13 + k * k * 31 + k / 2 * 20 * (face % 3)) % 400));
    }
  }
  return bytes + more;
}

TEST(convert_mesh, writes_what_is_written_of_a_mesh_in_memory) {
  const TemporaryFolder folder;
  write_shape(icosphere(3), folder / "triangles.ply");
  testing::write_all(folder / "few.ply", polygons(5));
  testing::write_all(folder / "many.ply", polygons(35000));  // several blocks
  for (const char* from : {"triangles.ply", "few.ply", "many.ply"}) {
    const ShapeFile file = read_shape(folder / from);
    for (const char* to : {".ply", ".obj", ".off", ".stl"}) {
      for (const bool ascii : {false, true}) {
        const std::string whole = std::string("whole") + to,
                          in_place = std::string("in_place") + to;
        write_shape(std::get<Mesh>(file.shape), folder / whole.c_str(), {.ascii = ascii});
        const std::optional<ConvertedMesh> converted =
            convert_mesh(folder / from, folder / in_place.c_str(), {.ascii = ascii});
        ASSERT_TRUE(converted) << from;
        EXPECT_TRUE(read_all(folder / whole.c_str()) == read_all(folder / in_place.c_str()))
            << from << to;
        EXPECT_EQ(converted->warnings, file.warnings);
        EXPECT_EQ(converted->attributes.size(), std::get<Mesh>(file.shape).attributes.size());
      }
    }
  }
}

TEST(convert_mesh, leaves_to_others_what_it_cannot_write_in_place) {
  const TemporaryFolder folder;
  const std::string good = polygons(10);
  std::string index = good, coordinate = good;
  index.replace(index.size() - 2, 1, "\x7f");
  testing::write_all(folder / "index.ply", index);
  testing::write_all(folder / "cut.ply", good.substr(0, good.size() - 1));
  testing::write_all(folder / "more.ply", polygons(10, "x"));
  testing::write_all(folder / "missing.ply", polygons(10).substr(0, good.size() - 200));
  write_shape(icosphere(1), folder / "text.ply", {.ascii = true});
  write_shape(icosphere(1), folder / "m.obj");
  for (const char* name :
       {"index.ply", "cut.ply", "more.ply", "missing.ply", "text.ply", "m.obj", "none.ply"}) {
    EXPECT_FALSE(convert_mesh(folder / name, folder / "out.ply")) << name;
  }
  const float nan = NAN;
  std::memcpy(coordinate.data() + coordinate.find("end_header\n") + 11 + 13, &nan, sizeof nan);
  testing::write_all(folder / "nan.ply", coordinate);
  expect_error([&] { convert_mesh(folder / "nan.ply", folder / "out.ply"); },
               ErrorCode::kInvalidInput, {"vertex 1"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
}

TEST(large_mesh, with_something_wrong_is_refused) {
  const TemporaryFolder folder;
  write_shape(icosphere(1), folder / "m.ply");
  const std::string good = read_all(folder / "m.ply");
  const auto with = [&](std::size_t from_end, const std::string& bytes) {
    std::string bad = good;
    bad.replace(bad.size() - from_end, bytes.size(), bytes);
    std::filesystem::remove(folder / "m.ply");
    testing::write_all(folder / "m.ply", bad);
    return map_mesh(folder / "m.ply");
  };
  for (const auto& map : {with(13, "\4"), with(4, "\xff\xff\xff\x7f")}) {
    ASSERT_TRUE(map);
    expect_error([&] { survey_mesh(*map); }, ErrorCode::kInvalidInput);
    expect_error([&] { write_shape(*map, folder / "out.ply"); }, ErrorCode::kInvalidInput);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
}

TEST(large_mesh, vertices_that_were_released_are_there_again) {
  const TemporaryFolder folder;
  const Mesh mesh = latitude_longitude_sphere(100, 100);
  write_shape(mesh, folder / "m.ply");
  const std::optional<MappedMesh> map = map_mesh(folder / "m.ply");
  ASSERT_TRUE(map);
  for (const std::size_t first : {0u, 5u, 5000u}) {
    release_vertices(*map, first, mesh.vertices.size() - first);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      EXPECT_EQ(map->view().vertex(i), mesh.vertices[i]);
    }
    EXPECT_EQ(map->view().triangle(3), mesh.faces[3]);
  }
}

}  // namespace
}  // namespace rholm
