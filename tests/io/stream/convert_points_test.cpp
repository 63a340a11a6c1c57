// Compares with write_shape() of read_shape(): the same bytes, warnings and refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "../shapes/test_support.h"
#include "rholm/error.h"
#include "rholm/point_stream.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

using testing::expect_error;
using testing::read_all;
using testing::TemporaryFolder;
using testing::write_all;

constexpr std::size_t kPoints = 70000;  // more than one block

PointCloud cloud_of(std::size_t n, bool with_normals) {
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    cloud.points.push_back({std::cos(t), std::sin(t), 1e-3 * t});
    if (with_normals) cloud.normals.push_back({std::cos(t), std::sin(t), 0});
  }
  return cloud;
}

void add(const char* name, ScalarType type, double step, PointCloud& cloud) {
  Attribute attribute{.name = name, .type = type};
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    attribute.values.push_back(step * static_cast<double>(i % 200));
  }
  cloud.attributes.push_back(std::move(attribute));
}

void expect_same_files(const TemporaryFolder& folder, const std::filesystem::path& from) {
  SCOPED_TRACE(from.filename().string());
  const ShapeFile file = read_shape(from);
  const auto& cloud = std::get<PointCloud>(file.shape);
  for (const char* name : {"x.ply", "x.xyz"}) {
    for (const bool ascii : {false, true}) {
      const std::filesystem::path whole = folder / "whole" / name,
                                  pieces = folder / "pieces" / name;
      std::filesystem::create_directories(whole.parent_path());
      std::filesystem::create_directories(pieces.parent_path());
      write_shape(cloud, whole, {.ascii = ascii});
      const ConvertedPoints converted = convert_points(from, pieces, {.ascii = ascii});
      EXPECT_TRUE(read_all(pieces) == read_all(whole)) << name << (ascii ? " ascii" : "");
      EXPECT_EQ(converted.points, cloud.points.size());
      EXPECT_EQ(converted.warnings, file.warnings);
      ASSERT_EQ(converted.attributes.size(), cloud.attributes.size());
      for (std::size_t k = 0; k < cloud.attributes.size(); ++k) {
        EXPECT_EQ(converted.attributes[k].name, cloud.attributes[k].name);
        EXPECT_EQ(converted.attributes[k].type, cloud.attributes[k].type);
      }
    }
  }
}

TEST(convert_points, writes_what_is_written_of_all_of_them) {
  const TemporaryFolder folder;
  for (const std::size_t n : {std::size_t{1}, kPoints}) {
    for (const bool with_normals : {false, true}) {
      PointCloud cloud = cloud_of(n, with_normals);
      write_shape(cloud, folder / "plain.xyz");
      expect_same_files(folder, folder / "plain.xyz");
      if (n > 1 && !with_normals) continue;  // takes some seconds
      add("red", ScalarType::kUint8, 1, cloud);
      add("green", ScalarType::kUint8, 1, cloud);
      add("blue", ScalarType::kUint8, 0, cloud);
      add("quality", ScalarType::kFloat32, 0.5, cloud);
      add("time", ScalarType::kFloat64, 0.1, cloud);
      add("label", ScalarType::kInt16, -100, cloud);
      cloud.attributes[3].values[n / 2] = NAN;
      cloud.attributes[4].values[n - 1] = INFINITY;
      for (const bool ascii : {false, true}) {
        write_shape(cloud, folder / "all.ply", {.ascii = ascii});
        expect_same_files(folder, folder / "all.ply");
      }
    }
  }
}

// Lengths of normals are known after all points only, and the number of points after all lines.
TEST(convert_points, looks_ahead_where_the_first_line_depends_on_the_last) {
  const TemporaryFolder folder;
  PointCloud cloud = cloud_of(kPoints, true);
  cloud.normals.back() = {3, 0, 0};
  write_shape(cloud, folder / "long.ply");
  expect_same_files(folder, folder / "long.ply");
  write_shape(cloud, folder / "long.xyz");
  expect_same_files(folder, folder / "long.xyz");
  for (Vec3& normal : cloud.normals) normal = {};
  write_shape(cloud, folder / "zero.ply");
  expect_same_files(folder, folder / "zero.ply");
}

TEST(convert_points, reads_lines_of_any_columns) {
  const TemporaryFolder folder;
  std::string named = "# a file\n# x y z intensity\n", colors, scalars, counted = "3\n";
  for (int i = 0; i < 70000; ++i) {
    const std::string k = std::to_string(i % 250);
    named += k + " 0.5 " + k + " 1e-" + std::to_string(i % 300) + "\n";
    colors += "1 2 " + k + " " + k + " 0 255\r\n";
    scalars += k + ",2,3," + k + ".5,7\n";
  }
  for (int i = 0; i < 3; ++i) counted += "1 2 3 0 0 1\n";
  write_all(folder / "named.xyz", named);
  write_all(folder / "colors.xyz", colors);
  write_all(folder / "scalars.csv", scalars);
  write_all(folder / "counted.pwn", counted);
  for (const char* name : {"named.xyz", "colors.xyz", "scalars.csv", "counted.pwn"}) {
    expect_same_files(folder, folder / name);
  }
}

// Other elements of the file are skipped with a warning.
TEST(convert_points, passes_over_other_elements) {
  const TemporaryFolder folder;
  write_shape(cloud_of(10, true), folder / "points.ply");
  const std::string points = read_all(folder / "points.ply");
  EXPECT_TRUE(PointStream(folder / "points.ply").is_all());
  std::string edges = points + "ab";
  edges.insert(edges.find("end_header"), "element edge 2\nproperty uchar a\n");
  write_all(folder / "edges.ply", edges);
  EXPECT_FALSE(PointStream(folder / "edges.ply").is_all());
  expect_same_files(folder, folder / "edges.ply");
  std::string none = points;
  none.insert(none.find("end_header"), "element face 0\nproperty list uchar int vertex_indices\n");
  write_all(folder / "none.ply", none);
  EXPECT_TRUE(PointStream(folder / "none.ply").is_all());
  expect_same_files(folder, folder / "none.ply");
  write_all(folder / "more.ply", points + "x");
  write_all(folder / "less.ply", points.substr(0, points.size() - 1));
  write_shape(cloud_of(10, true), folder / "text.ply", {.ascii = true});
  write_shape(cloud_of(10, true), folder / "lines.xyz");
  write_shape(icosphere(1), folder / "mesh.ply");
  for (const char* name : {"more.ply", "less.ply", "text.ply", "lines.xyz", "mesh.ply"}) {
    EXPECT_FALSE(PointStream(folder / name).is_all()) << name;
  }
}

TEST(convert_points, leaves_the_old_file_where_it_fails) {
  const TemporaryFolder folder;
  write_shape(cloud_of(kPoints, true), folder / "good.ply");
  const std::string good = read_all(folder / "good.ply");
  write_all(folder / "cut.ply", good.substr(0, good.size() - 5));
  write_all(folder / "cut.xyz", "1 2 3\n4 5 6\n7 8");
  write_all(folder / "nothing.ply", "");
  write_shape(icosphere(1), folder / "mesh.ply");
  write_all(folder / "out.ply", "old");
  for (const char* name : {"cut.ply", "cut.xyz", "nothing.ply"}) {
    expect_error([&] { convert_points(folder / name, folder / "out.ply"); },
                 ErrorCode::kInvalidInput);
  }
  expect_error([&] { convert_points(folder / "mesh.ply", folder / "out.ply"); },
               ErrorCode::kUnsupported, {"mesh"});
  expect_error([&] { convert_points(folder / "good.ply", folder / "out.obj"); },
               ErrorCode::kUnsupported, {"obj"});
  expect_error([&] { convert_points(folder / "none.ply", folder / "out.ply"); }, ErrorCode::kIo);
  int calls = 0;
  const Context stop{.progress = [&](std::string_view, double) { return ++calls < 5; }};
  expect_error([&] { convert_points(folder / "good.ply", folder / "out.ply", {}, stop); },
               ErrorCode::kCancelled);
  EXPECT_EQ(read_all(folder / "out.ply"), "old");
  convert_points(folder / "good.ply", folder / "good.ply");  // replaces its own input
  EXPECT_TRUE(read_all(folder / "good.ply") == good);
}

}  // namespace
}  // namespace rholm
