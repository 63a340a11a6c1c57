// Compares with read_shape() of the whole file: the same values in blocks of any size, same
// refusals.
#include "rholm/point_stream.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../shapes/test_support.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

using testing::BytesBuilder;
using testing::expect_error;
using testing::TemporaryFolder;
using testing::write_all;

void append(const PointCloud& piece, PointCloud& all) {
  if (all.points.empty()) {
    for (const Attribute& a : piece.attributes) all.attributes.push_back({a.name, a.type, {}});
  }
  ASSERT_EQ(piece.attributes.size(), all.attributes.size());
  ASSERT_TRUE(piece.normals.empty() || piece.normals.size() == piece.points.size());
  all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
  all.normals.insert(all.normals.end(), piece.normals.begin(), piece.normals.end());
  for (std::size_t k = 0; k < all.attributes.size(); ++k) {
    EXPECT_EQ(piece.attributes[k].name, all.attributes[k].name);
    EXPECT_EQ(piece.attributes[k].type, all.attributes[k].type);
    auto& values = all.attributes[k].values;
    values.insert(values.end(), piece.attributes[k].values.begin(),
                  piece.attributes[k].values.end());
  }
}

PointCloud read_in_pieces(const std::filesystem::path& path, std::size_t n,
                          const ShapeReadOptions& options = {}) {
  PointStream stream(path, options);
  PointCloud piece, all;
  while (stream.read(n, piece)) {
    EXPECT_LE(piece.points.size(), n);
    EXPECT_GE(piece.points.size(), 1U);
    append(piece, all);
    EXPECT_EQ(stream.read_so_far(), all.points.size());
  }
  EXPECT_TRUE(piece.points.empty());
  EXPECT_EQ(stream.size().value_or(all.points.size()), all.points.size());
  return all;
}

void expect_same(const PointCloud& found, const PointCloud& wanted) {
  EXPECT_EQ(found.points, wanted.points);
  EXPECT_EQ(found.normals, wanted.normals);
  ASSERT_EQ(found.attributes.size(), wanted.attributes.size());
  for (std::size_t k = 0; k < wanted.attributes.size(); ++k) {
    EXPECT_EQ(found.attributes[k].name, wanted.attributes[k].name);
    EXPECT_EQ(found.attributes[k].type, wanted.attributes[k].type);
    EXPECT_EQ(found.attributes[k].values, wanted.attributes[k].values);
  }
}

PointCloud points_of(const ShapeFile& file) {
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) return *cloud;
  const Mesh& mesh = std::get<Mesh>(file.shape);
  return {.points = mesh.vertices, .normals = {}, .attributes = mesh.attributes};
}

void expect_as_whole(const std::filesystem::path& path) {
  for (const bool attributes : {true, false}) {
    const ShapeReadOptions options{.attributes = attributes};
    const PointCloud whole = points_of(read_shape(path, options));
    for (const std::size_t n : {1, 3, 7, 100, 1000000}) {
      SCOPED_TRACE(path.string() + ", " + std::to_string(n) + " at a time");
      expect_same(read_in_pieces(path, n, options), whole);
    }
  }
}

PointCloud some_points(std::size_t n) {
  Mesh mesh = bumpy_sphere(2, 0.3);
  const std::size_t vertices = mesh.vertices.size();
  std::vector<double> bytes(vertices), reals(vertices);
  for (std::size_t i = 0; i < vertices; ++i) {
    bytes[i] = static_cast<double>(i % 256);
    reals[i] = 0.1 * static_cast<double>(i);
  }
  mesh.attributes = {{"red", ScalarType::kUint8, bytes}, {"quality", ScalarType::kFloat64, reals}};
  return sample_surface(mesh, {.points = n});
}

TEST(PointStream, has_the_points_of_the_whole_file) {
  const TemporaryFolder folder;
  const PointCloud cloud = some_points(250);
  PointCloud bare = cloud;
  bare.normals.clear();
  bare.attributes.clear();
  for (const bool ascii : {false, true}) {
    write_shape(cloud, folder / "points.ply", {.format = {}, .ascii = ascii});
    expect_as_whole(folder / "points.ply");
    write_shape(bare, folder / "bare.ply", {.format = {}, .ascii = ascii});
    expect_as_whole(folder / "bare.ply");
    write_shape(bumpy_sphere(2), folder / "mesh.ply", {.format = {}, .ascii = ascii});
    expect_as_whole(folder / "mesh.ply");
  }
  write_shape(cloud, folder / "points.xyz");
  expect_as_whole(folder / "points.xyz");
  write_shape(bare, folder / "bare.xyz");
  expect_as_whole(folder / "bare.xyz");
}

TEST(PointStream, knows_either_order_of_bytes) {
  const TemporaryFolder folder;
  for (const bool big : {false, true}) {
    BytesBuilder bytes(big);
    bytes.text(big ? "ply\r\nformat binary_big_endian 1.0\r\n"
                   : "ply\r\nformat binary_little_endian 1.0\r\n");
    bytes.text(
        "element vertex 5\r\nproperty short label\r\nproperty float x\r\nproperty double y\r\n"
        "property float z\r\nend_header\r\n");
    for (int i = 0; i < 5; ++i) {
      bytes.put<std::int16_t>(i).put<float>(i).put<double>(2 * i).put<float>(3);
    }
    write_all(folder / "order.ply", bytes.bytes());
    expect_as_whole(folder / "order.ply");
  }
}

// Comments, blank lines, both kinds of line ends, columns with and without names.
TEST(PointStream, takes_lines_as_they_come) {
  const TemporaryFolder folder;
  const std::vector<std::pair<const char*, std::string>> files = {
      {"plain.xyz", "0 0 0\n1 0 0\n\n# a comment\n0 1 0 // another\n0 0 1"},
      {"pairs.xyz", "0 0 0\r\n1 0 0\r\n\r\n0 1 0\r\n0 0 1\r\n"},
      {"old.xyz", "0 0 0\r1 0 0\r0 1 0\r0 0 1\r"},
      {"named.csv", "x,y,z,time,red,green,blue\n0,0,0,1.5,1,2,3\n1,0,0,2.5,4,5,6\n0,1,0,3,7,8,9\n"},
      {"comment.txt", "# x y z nx ny nz\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 1\n"},
      {"colours.xyz", "0 0 0 1 2 3\n1 0 0 255 0 0\n0 1 0 9 9 9\n"},
      {"normals.xyz", "0 0 0 0 0 1 5\n1 0 0 0 1 0 6\n0 1 0 1 0 0 7\n"},
      {"scalars.xyz", "0 0 0 0 0 3 5\n1 0 0 0 1 0 6\n0 1 0 1 0 0 7\n"},
      {"long.pwn", "3\n0 0 0 0 0 3\n1 0 0 0 2 0\n0 1 0 1 0 0\n"},
      {"marked.xyz", "\xEF\xBB\xBF 0 0 0\n1 0 0\n0 1 0\n"},
  };
  for (const auto& [name, text] : files) {
    write_all(folder / name, text);
    expect_as_whole(folder / name);
  }
}

std::string refusal_of(const std::filesystem::path& path, bool whole) {
  try {
    if (whole) {
      read_shape(path);
    } else {
      read_in_pieces(path, 2);
    }
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput) << error.what();
    return error.what();
  }
}

// Errors name the same line, or the same point, of the file.
TEST(PointStream, tells_where_something_is_wrong) {
  const TemporaryFolder folder;
  const std::string lines = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 5 5\n";
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n0 0 0\n1 1 1\n2 2 2\n";
  const std::vector<std::pair<const char*, std::string>> files = {
      {"word.xyz", lines + "1 2 no\n"},
      {"few.xyz", lines + "1 2\n"},
      {"many.xyz", lines + "1 2 3 4\n"},
      {"promised.xyz", "9\n0 0 0 1\n1 0 0 2\n"},
      {"header.xyz", "a b c\n0 0 0\n"},
      {"none.xyz", "# nothing\n"},
      {"two.xyz", "1 2\n"},
      {"word.ply", header + "3 x 3\n"},
      {"none.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n"},
      {"no_x.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nend_header\n1\n"},
      {"no_properties.ply", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n"},
      {"empty.xyz", ""},
  };
  for (const auto& [name, text] : files) {
    write_all(folder / name, text);
    const std::string wanted = refusal_of(folder / name, true);
    EXPECT_FALSE(wanted.empty()) << name;
    EXPECT_EQ(refusal_of(folder / name, false), wanted);
  }
  expect_error([&] { PointStream(folder / "absent.xyz"); }, ErrorCode::kIo, {"absent.xyz"});
  expect_error([&] { PointStream(folder.path()); }, ErrorCode::kIo);
}

TEST(PointStream, drops_points_that_are_not_finite) {
  const TemporaryFolder folder;
  std::string text = "nan 0 0\n";
  for (int i = 0; i < 30; ++i) text += i % 3 == 0 ? "1 inf 2\n" : std::to_string(i) + " 0.5 7\n";
  write_all(folder / "gaps.xyz", text);
  PointStream stream(folder / "gaps.xyz");
  PointCloud piece, all;
  while (stream.read(2, piece)) append(piece, all);
  EXPECT_EQ(all.points.size(), 20u);
  expect_same(all, points_of(read_shape(folder / "gaps.xyz")));
  EXPECT_EQ(stream.warnings(), read_shape(folder / "gaps.xyz").warnings);
  EXPECT_EQ(stream.warnings().size(), 1u);
}

// A file cut anywhere is refused in both ways of reading, or gives the same points in both.
TEST(PointStream, takes_a_shortened_file_as_it_is_taken_whole) {
  const TemporaryFolder folder;
  const PointCloud cloud = some_points(6);
  for (const char* name : {"binary.ply", "text.ply", "points.xyz"}) {
    const bool ascii = std::string_view(name) == "text.ply";
    write_shape(cloud, folder / name, {.format = {}, .ascii = ascii});
    const std::string bytes = testing::read_all(folder / name);
    for (std::size_t size = 1; size < bytes.size(); ++size) {
      SCOPED_TRACE(std::string(name) + " cut to " + std::to_string(size));
      write_all(folder / name, std::string_view(bytes).substr(0, size));
      bool whole = true;
      PointCloud wanted;
      try {
        wanted = points_of(read_shape(folder / name));
      } catch (const Error&) {
        whole = false;
      }
      try {
        const PointCloud found = read_in_pieces(folder / name, 4);
        EXPECT_TRUE(whole);
        if (whole) expect_same(found, wanted);
      } catch (const Error&) {
        EXPECT_FALSE(whole);
      }
    }
  }
}

TEST(PointStream, refuses_what_has_no_order_of_points) {
  const TemporaryFolder folder;
  for (const char* name : {"mesh.obj", "mesh.off", "mesh.stl"}) {
    write_shape(bumpy_sphere(1), folder / name);
  }
  write_all(folder / "follow.pwn", "1\n0 0 0\n0 0 1\n");
  write_all(folder / "faces_first.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
            "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  write_all(folder / "list.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
            "property float z\nproperty list uchar int tags\nend_header\n0 0 0 1 5\n");
  for (const char* name :
       {"mesh.obj", "mesh.off", "mesh.stl", "follow.pwn", "faces_first.ply", "list.ply"}) {
    expect_error([&] { PointStream(folder / name); }, ErrorCode::kUnsupported, {name});
  }
}

// Later values that do not fit the types are refused, not rounded.
TEST(PointStream, keeps_to_the_types_of_the_first_piece) {
  const TemporaryFolder folder;
  std::string text = "x y z red green blue\n";
  while (text.size() <= std::size_t{1} << 20) text += "0 0 0 1 2 3\n";  // determines the types
  write_all(folder / "late.xyz", text + "0 0 0 1 2 3.5\n");
  PointStream stream(folder / "late.xyz");
  PointCloud piece;
  ASSERT_TRUE(stream.read(10, piece));
  EXPECT_EQ(piece.attributes[2].type, ScalarType::kUint8);
  expect_error(
      [&] {
        while (stream.read(10000, piece)) continue;
      },
      ErrorCode::kInvalidInput, {"blue"});
}

TEST(PointStream, claims_no_memory_for_what_a_header_promises) {
  const TemporaryFolder folder;
  BytesBuilder bytes;
  bytes.text(
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n"
      "property float y\nproperty float z\nend_header\n");
  for (int i = 0; i < 9; ++i) bytes.put<float>(i);
  write_all(folder / "short.ply", bytes.bytes());
  PointStream stream(folder / "short.ply");
  EXPECT_EQ(stream.size(), 4000000000U);
  PointCloud piece;
  ASSERT_TRUE(stream.read(2, piece));
  EXPECT_EQ(piece.points[1], (Vec3{3, 4, 5}));
  expect_error([&] { stream.read(std::numeric_limits<std::size_t>::max(), piece); },
               ErrorCode::kInvalidInput, {"truncated"});
}

TEST(PointStream, asks_whether_to_go_on) {
  const TemporaryFolder folder;
  write_shape(some_points(100000), folder / "points.ply");
  PointStream stream(folder / "points.ply");
  PointCloud piece;
  const Context context{.threads = 1, .progress = [](std::string_view stage, double) {
                          EXPECT_EQ(stage, "read");
                          return false;
                        }};
  expect_error([&] { stream.read(100000, piece, context); }, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace rholm
