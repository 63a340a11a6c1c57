#include <gtest/gtest.h>

#include "io/shapes/test_support.h"

namespace rholm {
namespace {

using testing::BytesBuilder;
using testing::expect_refused;
using testing::parse;
using testing::parse_mesh;
using testing::volume_of;

std::string ascii_facet(const Triangle& t) {
  std::string text = "  facet normal 0 0 0\n    outer loop\n";
  for (const std::uint32_t corner : t) {
    const Vec3& v = testing::kTetrahedronVertices[corner];
    text += "      vertex " + std::to_string(v.x) + " " + std::to_string(v.y) + " " +
            std::to_string(v.z) + "\n";
  }
  return text + "    endloop\n  endfacet\n";
}

std::string ascii_tetrahedron(const std::string& name = "tetrahedron") {
  std::string text = "solid " + name + "\n";
  for (const Triangle& t : testing::kTetrahedronTriangles) text += ascii_facet(t);
  return text + "endsolid " + name + "\n";
}

std::string binary_tetrahedron(const std::string& title, std::uint32_t count = 4) {
  BytesBuilder out;
  std::string header = title;
  header.resize(80, '\0');
  out.text(header).put<std::uint32_t>(count);
  for (const Triangle& t : testing::kTetrahedronTriangles) {
    out.put<float>(0, 0, 0);
    for (const std::uint32_t corner : t) {
      const Vec3& v = testing::kTetrahedronVertices[corner];
      out.put<float>(v.x, v.y, v.z);
    }
    out.put<std::uint16_t>(0x1234);
  }
  return out.bytes();
}

void expect_soup_of_tetrahedron(const Mesh& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 12u);
  ASSERT_EQ(mesh.faces.size(), 4u);
  for (std::uint32_t i = 0; i < 12; ++i) {
    EXPECT_EQ(mesh.faces[i / 3][i % 3], i);
    EXPECT_EQ(mesh.vertices[i],
              testing::kTetrahedronVertices[testing::kTetrahedronTriangles[i / 3][i % 3]]);
  }
  EXPECT_DOUBLE_EQ(volume_of(mesh), 1.0 / 6);
}

TEST(stl, both_encodings_give_three_vertices_per_facet) {
  const ShapeFile text = parse(ascii_tetrahedron());
  EXPECT_EQ(text.format, ShapeFormat::kStl);
  EXPECT_EQ(text.encoding, "ascii");
  expect_soup_of_tetrahedron(std::get<Mesh>(text.shape));
  const ShapeFile binary = parse(binary_tetrahedron("made by hand"));
  EXPECT_EQ(binary.format, ShapeFormat::kStl);
  EXPECT_EQ(binary.encoding, "binary little endian");
  expect_soup_of_tetrahedron(std::get<Mesh>(binary.shape));
}

TEST(stl, binary_file_that_begins_with_solid_is_binary) {
  const ShapeFile file = parse(binary_tetrahedron("solid exported by a program"));
  EXPECT_EQ(file.encoding, "binary little endian");
  expect_soup_of_tetrahedron(std::get<Mesh>(file.shape));
}

TEST(stl, keywords_are_read_in_either_case_and_spacing) {
  std::string upper = ascii_tetrahedron("");
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  expect_soup_of_tetrahedron(parse_mesh(upper));
  std::string crlf;
  for (const char c : ascii_tetrahedron("two words"))
    crlf += c == '\n' ? "\r\n\t" : std::string(1, c);
  expect_soup_of_tetrahedron(parse_mesh(crlf));
}

TEST(stl, several_solids_are_one_mesh) {
  const ShapeFile file = parse(ascii_tetrahedron("a") + "\n" + ascii_tetrahedron("b"));
  EXPECT_EQ(std::get<Mesh>(file.shape).faces.size(), 8u);
  EXPECT_EQ(file.warnings, (std::vector<std::string>{"2 solids read as one mesh"}));
}

TEST(stl, normals_may_be_anything) {
  for (const std::string normal : {"nan nan nan", "-1.#IND 0 0", "", "1e999 0 0"}) {
    expect_soup_of_tetrahedron([&] {
      std::string text = ascii_tetrahedron();
      const std::size_t place = text.find("0 0 0");
      return parse_mesh(text.replace(place, 5, normal));
    }());
  }
}

TEST(stl, files_of_the_wrong_size_are_refused) {
  const std::string bytes = binary_tetrahedron("x");
  expect_refused(bytes.substr(0, bytes.size() - 1),
                 {"truncated", "count of facets is 4", "284", "283", "3 facets"}, "a.stl");
  expect_refused(bytes.substr(0, 83), {"84", "83"}, "a.stl");
  expect_refused(binary_tetrahedron("x", 4000000000u), {"200000000084", "284"}, "a.stl");
  expect_refused(binary_tetrahedron("x", 0).substr(0, 84), {"no facets"}, "a.stl");
}

TEST(stl, bytes_behind_the_facets_are_passed_over_with_a_note) {
  const std::string more = std::string(7, '\0') + "end";
  for (const char* title : {"made by hand", "solid by a program"}) {
    for (const char* name : {"a.stl", "standard input"}) {
      const ShapeFile file = parse(binary_tetrahedron(title) + more, name);
      EXPECT_EQ(file.encoding, "binary little endian");
      expect_soup_of_tetrahedron(std::get<Mesh>(file.shape));
      ASSERT_EQ(file.warnings.size(), 1u);
      EXPECT_NE(file.warnings[0].find("10 bytes behind the last of 4 facets"), std::string::npos);
    }
  }
  // The warning names whole facets that follow the counted facets.
  const std::string bytes = binary_tetrahedron("x");
  const ShapeFile six = parse(bytes + bytes.substr(84, 100), "a.stl");
  EXPECT_EQ(std::get<Mesh>(six.shape).faces.size(), 4u);
  EXPECT_NE(six.warnings.at(0).find("2 more, which the count does not name"), std::string::npos);
  const ShapeFile text = parse(ascii_tetrahedron() + "\x1a rest");
  expect_soup_of_tetrahedron(std::get<Mesh>(text.shape));
  EXPECT_NE(text.warnings.at(0).find("6 bytes behind the last 'endsolid'"), std::string::npos);
}

TEST(stl, facets_that_nobody_counted_are_read_with_a_note) {
  for (const std::uint32_t count : {0u, 0xffffffffu}) {
    for (const char* title : {"made by hand", "solid by a program"}) {
      const ShapeFile file = parse(binary_tetrahedron(title, count), "a.stl");
      expect_soup_of_tetrahedron(std::get<Mesh>(file.shape));
      ASSERT_EQ(file.warnings.size(), 1u);
      EXPECT_NE(file.warnings[0].find("4 facets follow"), std::string::npos);
      EXPECT_EQ(parse(binary_tetrahedron(title, count) + "xyz", "a.stl").warnings.size(), 2u);
    }
  }
}

TEST(stl, coordinates_that_are_not_finite_are_refused) {
  std::string bytes = binary_tetrahedron("x");
  const float bad = NAN;
  std::memcpy(bytes.data() + 84 + 50 + 12 + 16, &bad, 4);  // facet 1, corner 1: the fifth corner
  expect_refused(bytes, {"facet corner 4", "not a finite number"});
  std::string text = ascii_tetrahedron();
  text.replace(text.find("1.000000"), 8, "infinity");
  expect_refused(text, {"line 5", "'infinity'"});
}

TEST(stl, broken_text_is_refused_with_its_line) {
  const std::string good = ascii_tetrahedron("");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_refused(with("vertex", "vortex"), {"line 4", "'vortex'", "'vertex'"});
  expect_refused(with("endloop", "vertex 0 0 0\nendloop"), {"line 7", "'endloop'"});
  expect_refused(with("normal 0 0 0", "normal 0 0 0 0"), {"line 2", "'outer'"});
  expect_refused(with("normal 0", "norm 0"), {"line 2", "'normal'"});
  expect_refused(with("  facet", "  fact"), {"line 2", "'fact'"}, "a.stl");
  expect_refused(with("1.000000", "one"), {"line 5", "'one'"});
  expect_refused(good.substr(0, good.find("endsolid")), {"truncated", "4 facets"});
  expect_refused(good + "facet", {"'facet'", "'solid'"});
  expect_refused("solid nothing\nendsolid nothing\n", {"no facets"});
}

}  // namespace
}  // namespace rholm
