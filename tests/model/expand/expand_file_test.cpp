// Compares files that are processed without reading them into memory with the same shapes in
// memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "io/shapes/test_support.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using testing::TemporaryFolder;

constexpr ExpandOptions kOptions{.degree = 12, .precision = 1e-9};

// Writes a binary PLY file of doubles and calls `use` with its path.
void with_file(const Mesh& mesh, const std::function<void(const std::filesystem::path&)>& use) {
  const TemporaryFolder folder;
  write_shape(mesh, folder / "m.ply");
  use(folder / "m.ply");
}

std::optional<Expanded> mapped(const std::filesystem::path& path) {
  const std::optional<MappedMesh> map = map_mesh(path);
  EXPECT_TRUE(map.has_value());
  return map ? expand_mapped(*map, kOptions) : std::nullopt;
}

Expanded read(const std::filesystem::path& path) {
  return expand(std::get<Mesh>(read_shape(path).shape), kOptions);
}

void expect_equal(const Expanded& a, const Expanded& b) {
  const auto &x = a.transform.expansion, &y = b.transform.expansion;
  EXPECT_TRUE(std::ranges::equal(x.coefficients.values(), y.coefficients.values()));
  EXPECT_EQ(x.center, y.center);
  EXPECT_EQ(x.norm_squared, y.norm_squared);
  EXPECT_EQ(x.tail_strength, y.tail_strength);
  EXPECT_EQ(a.star.min_d, b.star.min_d);
  EXPECT_EQ(a.diagonal, b.diagonal);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.flipped, b.flipped);
}

TEST(expand_mapped, gives_what_the_same_file_gives_when_it_is_read) {
  const Mesh bumpy = test::rotated(bumpy_sphere(4)), cube = box({1, 2, 3}, 5);
  // Meshes have seams: each triangle has its own corners.
  for (const Mesh& mesh : {bumpy, cube, test::exploded(bumpy), test::random_octahedron(2)}) {
    with_file(mesh, [&](const auto& path) {
      const std::optional<Expanded> expanded = mapped(path);
      ASSERT_TRUE(expanded.has_value());
      expect_equal(*expanded, read(path));
      expect_equal(*expanded, expand_file(path, kOptions));
      EXPECT_EQ(expanded->faces, mesh.faces.size());
      EXPECT_EQ(expanded->edges, mesh.faces.size() / 2 * 3);
      EXPECT_TRUE(expanded->transform.fast.has_value());
    });
  }
}

// A mesh with seams has the coefficients of the welded mesh.
TEST(expand_mapped, does_not_mind_seams) {
  const Mesh mesh = test::rotated(bumpy_sphere(3));
  std::optional<Expanded> whole, soup;
  with_file(mesh, [&](const auto& path) { whole = mapped(path); });
  with_file(test::exploded(mesh), [&](const auto& path) { soup = mapped(path); });
  ASSERT_TRUE(whole && soup);
  const auto a = whole->transform.expansion.coefficients.values();
  const auto b = soup->transform.expansion.coefficients.values();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
}

TEST(expand_mapped, leaves_what_must_be_changed_first_to_the_reader) {
  Mesh inward = bumpy_sphere(3);
  flip(inward);
  with_file(inward, [&](const auto& path) {
    EXPECT_FALSE(mapped(path).has_value());
    const Expanded expanded = expand_file(path, kOptions);
    EXPECT_TRUE(expanded.flipped);
    expect_equal(expanded, read(path));
  });
  with_file(bumpy_sphere(3), [&](const auto& path) {
    const std::optional<MappedMesh> map = map_mesh(path);
    ASSERT_TRUE(map.has_value());
    ExpandOptions options = kOptions;
    options.weld_tolerance = 1e-9;
    EXPECT_FALSE(expand_mapped(*map, options).has_value());
    options = kOptions;
    options.engine = Engine::kDirect;
    EXPECT_FALSE(expand_mapped(*map, options).has_value());
    options = kOptions;
    options.method = Method::kGauge;
    EXPECT_FALSE(expand_mapped(*map, options).has_value());
  });
}

ErrorCode code_of(const std::filesystem::path& path) {
  try {
    expand_file(path, kOptions);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "not refused";
  return ErrorCode::kIo;
}

void expect_refused(const Mesh& mesh, ErrorCode code) {
  with_file(mesh, [&](const auto& path) {
    EXPECT_FALSE(mapped(path).has_value());
    EXPECT_EQ(code_of(path), code);
  });
}

TEST(expand_mapped, takes_no_mesh_that_is_not_closed_or_not_star_shaped) {
  Mesh open = bumpy_sphere(4);
  open.faces.pop_back();
  expect_refused(open, ErrorCode::kInvalidInput);
  Mesh misoriented = bumpy_sphere(4);
  std::swap(misoriented.faces[1000][0], misoriented.faces[1000][1]);
  expect_refused(misoriented, ErrorCode::kInvalidInput);
  expect_refused(torus(1, 0.3, 40, 20), ErrorCode::kNotStarShaped);
  expect_refused(test::joined(icosphere(3), bumpy_sphere(4)), ErrorCode::kNotStarShaped);
}

// Every face is oriented outwards, and all directions are covered twice. The second cover has so
// few triangles that a sample of the mesh may contain none of them.
TEST(expand_mapped, finds_a_second_sheet_of_few_triangles) {
  Mesh around = icosphere(0);
  for (Vec3& v : around.vertices) v *= 3;
  const Mesh fine = bumpy_sphere(6);
  expect_refused(test::joined(fine, around), ErrorCode::kNotStarShaped);
  expect_refused(test::joined(around, fine), ErrorCode::kNotStarShaped);
}

// The file has the size that its triangles need, but a quad and a pair replace two of them: only
// the counts show it.
TEST(expand_mapped, leaves_other_polygons_to_the_reader) {
  with_file(bumpy_sphere(3), [&](const auto& path) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-26, std::ios::end);
    std::array<std::uint32_t, 6> corners;
    file.seekg(-26, std::ios::end);
    std::array<char, 26> faces;
    file.read(faces.data(), faces.size());
    std::memcpy(corners.data(), faces.data() + 1, 12);
    std::memcpy(corners.data() + 3, faces.data() + 14, 12);
    faces[0] = 4;
    std::memcpy(faces.data() + 1, corners.data(), 16);
    faces[17] = 2;
    std::memcpy(faces.data() + 18, corners.data() + 4, 8);
    file.seekp(-26, std::ios::end);
    file.write(faces.data(), faces.size());
    file.close();
    EXPECT_FALSE(mapped(path).has_value());
    EXPECT_EQ(code_of(path), ErrorCode::kInvalidInput);  // a pair does not give a triangle
  });
}

// All faces are quads: a box with one quad per side.
TEST(expand_file, cuts_quads_into_triangles) {
  const Mesh cube = box({2, 2, 2});
  const TemporaryFolder folder;
  std::ofstream file(folder / "m.ply", std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\n"
          "property float y\nproperty float z\nelement face 6\n"
          "property list uchar int vertex_indices\nend_header\n";
  const auto put = [&](const auto& value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) put((i & bit) != 0 ? 1.0F : -1.0F);
  }
  const std::array<std::array<std::int32_t, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& side : sides) {
    put(std::uint8_t{4});
    for (const std::int32_t i : side) put(i);
  }
  file.close();
  EXPECT_FALSE(map_mesh(folder / "m.ply").has_value());
  const Expanded quads = expand_file(folder / "m.ply", kOptions);
  const Expanded triangles = expand(cube, kOptions);
  EXPECT_EQ(quads.faces, 12u);
  const auto a = quads.transform.expansion.coefficients.values();
  const auto b = triangles.transform.expansion.coefficients.values();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-8);
}

}  // namespace
}  // namespace rholm
