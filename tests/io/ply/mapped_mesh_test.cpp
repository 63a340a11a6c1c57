#include "rholm/mapped_mesh.h"

#include <sys/stat.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "io/shapes/test_support.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

using testing::BytesBuilder;
using testing::expect_error;
using testing::TemporaryFolder;
using testing::write_all;

constexpr bool kBigEndianHost = std::endian::native == std::endian::big;
const std::string kNative = kBigEndianHost ? "binary_big_endian" : "binary_little_endian";
const std::string kForeign = kBigEndianHost ? "binary_little_endian" : "binary_big_endian";

// Parts of a PLY file, so that a test can change one part.
struct Parts {
  std::string format = kNative;
  std::string comments = "";
  std::string before = "";  // one-byte properties of vertices before x
  std::string coordinate = "float";
  std::string after = "";  // properties after z
  std::string list = "list uchar int vertex_indices";
  std::string more = "";  // header lines after the faces
  std::string line_end = "\n";
  std::string tail = "";  // bytes after the faces
};

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string(1, c);
  return result;
}

std::string ply(const Mesh& mesh, const Parts& parts) {
  const std::string& type = parts.coordinate;
  const std::string header = "ply\nformat " + parts.format + " 1.0\n" + parts.comments +
                             "element vertex " + std::to_string(mesh.vertices.size()) + "\n" +
                             parts.before + "property " + type + " x\nproperty " + type +
                             " y\nproperty " + type + " z\n" + parts.after + "element face " +
                             std::to_string(mesh.faces.size()) + "\nproperty " + parts.list + "\n" +
                             parts.more + "end_header\n";
  BytesBuilder file(kBigEndianHost);
  file.text(with_line_ends(header, parts.line_end));
  for (const Vec3& v : mesh.vertices) {
    file.text(std::string(lines_of(parts.before), '\7'));
    if (type == "float") file.put<float>(v.x, v.y, v.z);
    if (type == "double") file.put<double>(v.x, v.y, v.z);
    file.text(std::string(lines_of(parts.after), '\7'));
  }
  for (const Triangle& t : mesh.faces) {
    file.put<std::uint8_t>(3).put<std::uint32_t>(t[0], t[1], t[2]);
  }
  return file.text(parts.tail).bytes();
}

std::optional<MappedMesh> mapped(const std::string& bytes) {
  const TemporaryFolder folder;
  write_all(folder / "m.ply", bytes);
  return map_mesh(folder / "m.ply");  // the map stays valid without the name
}

// Checks for the same bits as read_shape() returns for the same file.
void expect_same_as_read(const std::string& bytes) {
  const std::optional<MappedMesh> map = mapped(bytes);
  ASSERT_TRUE(map);
  const Mesh mesh = testing::parse_mesh(bytes);
  const MeshView& view = map->view();
  ASSERT_EQ(view.n_vertices, mesh.vertices.size());
  ASSERT_EQ(view.n_faces, mesh.faces.size());
  for (std::size_t i = 0; i < view.n_vertices; ++i) EXPECT_EQ(view.vertex(i), mesh.vertices[i]);
  for (std::size_t t = 0; t < view.n_faces; ++t) {
    EXPECT_EQ(view.triangle(t), mesh.faces[t]);
  }
  EXPECT_TRUE(map->counts_are_three(0, view.n_faces));
}

TEST(map_mesh, shows_what_read_shape_reads) {
  const Mesh mesh = bumpy_sphere(2, 0.3);
  expect_same_as_read(ply(mesh, {}));
  expect_same_as_read(ply(mesh, {.coordinate = "double"}));
  expect_same_as_read(ply(mesh, {.list = "list int8 uint32 vertex_index"}));
  expect_same_as_read(ply(mesh, {.line_end = "\r\n"}));
  expect_same_as_read(ply(mesh, {.comments = "comment a\nobj_info b\n",
                                 .before = "property uchar a\n",
                                 .after = "property uchar red\nproperty char b\n"}));
}

TEST(map_mesh, leaves_every_other_file_to_the_reader) {
  const Mesh mesh = bumpy_sphere(1, 0.3);
  for (const Parts& parts :
       {Parts{.format = kForeign}, Parts{.list = "list uint int vertex_indices"},
        Parts{.list = "list uchar short vertex_indices"}, Parts{.list = "list uchar int other"},
        Parts{.list = "list uchar int vertex_indices\nproperty uchar red"},
        Parts{.after = "property list uchar uchar names\n"},
        Parts{.more = "element edge 0\nproperty int a\n"}, Parts{.tail = "x"},
        Parts{.before = "property uchar y2\n", .coordinate = "int"}}) {
    EXPECT_FALSE(mapped(ply(mesh, parts)));
  }
  EXPECT_FALSE(mapped("OFF\n0 0 0\n"));
  EXPECT_FALSE(
      mapped("ply"
             "x"));
  EXPECT_FALSE(mapped(""));
  EXPECT_FALSE(mapped("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"));
}

TEST(map_mesh, leaves_what_is_no_regular_file_to_the_reader) {
  const TemporaryFolder folder;
  EXPECT_FALSE(map_mesh("-"));
  EXPECT_FALSE(map_mesh(folder / "missing.ply"));
  EXPECT_FALSE(map_mesh(folder.path()));
  ASSERT_EQ(::mkfifo((folder / "pipe.ply").c_str(), 0600), 0);
  EXPECT_FALSE(map_mesh(folder / "pipe.ply"));
}

// Faces with fewer than three corners also make a file shorter: only the reader can distinguish.
TEST(map_mesh, leaves_truncated_files_and_wild_counts_to_the_reader) {
  const std::string whole = ply(bumpy_sphere(1, 0.3), {});
  for (const std::size_t missing : {1, 13, 14, 700, 1500}) {
    const std::string part = whole.substr(0, whole.size() - missing);
    EXPECT_FALSE(mapped(part));
    testing::expect_refused(part, {"truncated"});
  }
  const std::string header = "ply\nformat " + kNative +
                             " 1.0\nelement vertex 18446744073709551615\nproperty float x\n"
                             "property float y\nproperty float z\nelement face "
                             "18446744073709551615\nproperty list uchar int vertex_indices\n"
                             "end_header\n";
  EXPECT_FALSE(mapped(header + "some bytes"));
  expect_error([&] { mapped("ply\nformat ascii 1.0\n"); }, ErrorCode::kInvalidInput,
               {"end_header"});
}

TEST(mapped_mesh, finds_every_face_that_is_no_triangle) {
  const Mesh mesh = bumpy_sphere(1, 0.3);  // 80 faces
  const std::size_t n = mesh.faces.size();
  const std::string good = ply(mesh, {});
  for (std::size_t wrong = 0; wrong < n; ++wrong) {
    std::string bad = good;
    bad[bad.size() - 13 * (n - wrong)] = wrong % 2 == 0 ? 4 : 2;
    const std::optional<MappedMesh> map = mapped(bad);
    ASSERT_TRUE(map);
    for (const std::size_t first : {0, 1, 15, 33}) {
      for (const std::size_t count : {0, 1, 16, 31, 47}) {
        EXPECT_EQ(map->counts_are_three(first, count), wrong < first || wrong >= first + count)
            << wrong << ' ' << first << ' ' << count;
      }
    }
  }
}

TEST(mapped_mesh, comes_back_after_release) {
  const Mesh mesh = bumpy_sphere(5, 0.3);  // 20480 faces, 65 pages
  const std::optional<MappedMesh> map = mapped(ply(mesh, {}));
  ASSERT_TRUE(map);
  const std::size_t n = mesh.faces.size();
  for (std::size_t first = 0; first < n; first += 1000) {
    map->release(first, std::min<std::size_t>(1000, n - first));
  }
  map->release(0, n);
  for (std::size_t t = 0; t < n; ++t) ASSERT_EQ(map->view().triangle(t), mesh.faces[t]);
}

TEST(mapped_mesh, can_be_moved) {
  std::optional<MappedMesh> map = mapped(ply(bumpy_sphere(1, 0.3), {}));
  ASSERT_TRUE(map);
  const Triangle first = map->view().triangle(0);
  MappedMesh other = std::move(*map);
  map.reset();
  EXPECT_EQ(other.view().triangle(0), first);
}

}  // namespace
}  // namespace rholm
