#include "io/ply/ply_parts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"

namespace rholm {
namespace {

class PlyPartsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("rholm_parts_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    mesh_ = icosphere(2);
    Attribute shade{"shade", ScalarType::kUint8, {}}, far{"far", ScalarType::kFloat64, {}};
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      shade.values.push_back(static_cast<double>(v % 256));
      far.values.push_back(1.0 / (1 + static_cast<double>(v)));
    }
    mesh_.attributes = {shade, far};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  PlyLayout layout() const { return {mesh_.vertices.size(), mesh_.faces.size(), mesh_.attributes}; }
  // Returns a part of both lists.
  PlyPart part(std::size_t first_vertex, std::size_t end_vertex, std::size_t first_triangle,
               std::size_t end_triangle) const {
    PlyPart part{.first_vertex = first_vertex, .first_triangle = first_triangle};
    const auto cut = [](const auto& all, std::size_t first, std::size_t end) {
      return std::vector(all.begin() + static_cast<std::ptrdiff_t>(first),
                         all.begin() + static_cast<std::ptrdiff_t>(end));
    };
    part.vertices.vertices = cut(mesh_.vertices, first_vertex, end_vertex);
    for (const Attribute& attribute : mesh_.attributes) {
      part.vertices.attributes.push_back(
          {attribute.name, attribute.type, cut(attribute.values, first_vertex, end_vertex)});
    }
    for (const Triangle& t : cut(mesh_.faces, first_triangle, end_triangle)) {
      part.faces.push_back({t[0], t[1], t[2]});
    }
    return part;
  }

  Mesh mesh_;

 private:
  std::filesystem::path folder_;
};

TEST_F(PlyPartsTest, in_any_order_are_the_bytes_of_the_whole) {
  write_shape(mesh_, path("whole.ply"));
  PlyParts file(path("parts.ply"), layout());
  const std::size_t n = mesh_.vertices.size(), m = mesh_.faces.size();
  PlyParts::put(file.file(), layout(), part(100, n, 77, m));
  PlyParts::put(file.file(), layout(), part(13, 100, 0, 77));
  PlyParts::put(file.file(), layout(), part(0, 13, m, m));
  EXPECT_FALSE(std::filesystem::exists(path("parts.ply")));
  file.commit();
  EXPECT_TRUE(bytes("parts.ply") == bytes("whole.ply"));
}

TEST_F(PlyPartsTest, one_after_the_other_are_the_same) {
  write_shape(mesh_, path("whole.ply"));
  const PlyLayout places = layout();
  const PlyPart first = part(0, 50, 0, 200),
                rest = part(50, mesh_.vertices.size(), 200, mesh_.faces.size());
  std::string all = places.header();
  for (const std::vector<std::byte>& some :
       {ply_vertices(first.vertices), ply_vertices(rest.vertices), ply_triangles(first.faces),
        ply_triangles(rest.faces)}) {
    for (const std::byte b : some) all.push_back(static_cast<char>(b));
  }
  EXPECT_TRUE(all == bytes("whole.ply"));
  EXPECT_EQ(places.size(), all.size());
}

TEST_F(PlyPartsTest, leave_nothing_if_they_are_not_all_there) {
  {
    PlyParts file(path("parts.ply"), layout());
    PlyParts::put(file.file(), layout(), part(0, 10, 0, 10));
  }
  EXPECT_TRUE(std::filesystem::is_empty(path("")));
  EXPECT_THROW(PlyLayout((std::uint64_t{1} << 32) + 1, 1, {}), Error);
}

}  // namespace
}  // namespace rholm
