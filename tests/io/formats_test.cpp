// Properties that every line of the two tables of formats must have.
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "io/coefficients/coefficients_formats.h"
#include "io/shapes/shape_formats.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

template <typename Lines>
void expect_told_apart(const Lines& lines, std::set<std::string>& names,
                       std::set<std::string>& extensions) {
  for (const auto& line : lines) {
    const FileFormat& file = line.info.file;
    EXPECT_TRUE(names.insert(file.name).second) << file.name;
    EXPECT_TRUE(file.text || file.binary) << file.name;
    EXPECT_TRUE(file.read || file.written) << file.name;
    EXPECT_FALSE(file.title.empty() || file.help.empty()) << file.name;
    ASSERT_FALSE(file.extensions.empty()) << file.name;
    EXPECT_FALSE(file.extensions.front().shared || file.extensions.front().read_only) << file.name;
    for (const FileExtension& extension : file.extensions) {
      if (!extension.shared) {
        EXPECT_TRUE(extensions.insert(extension.name).second) << extension.name;
      }
      EXPECT_EQ(extension_of(file, "a.B." + extension.name), &extension);
    }
    if (line.told_by == ToldBy::kNothing) {
      EXPECT_EQ(line.looks_like, nullptr) << file.name;
    } else {
      EXPECT_NE(line.looks_like, nullptr) << file.name;
    }
  }
}

TEST(formats, are_told_apart_by_names_and_extensions) {
  std::set<std::string> names, extensions;
  expect_told_apart(shape_format_table(), names, extensions);
  expect_told_apart(coefficients_format_table(), names, extensions);
}

TEST(formats, of_shapes_are_found_by_name_extension_and_beginning) {
  for (const ShapeFormatInfo& known : shape_formats()) {
    EXPECT_EQ(parse_shape_format(known.file.name), known.format);
    EXPECT_EQ(to_string(known.format), known.file.name);
    for (const FileExtension& extension : known.file.extensions) {
      EXPECT_EQ(shape_format_of("a." + extension.name), known.format);
      const std::optional<bool> wanted = extension.shared ? std::nullopt : std::optional(true);
      EXPECT_EQ(is_shape_file({}, "a." + extension.name), wanted) << extension.name;
    }
  }
  for (const ShapeFormatLine& line : shape_format_table()) {
    if (!line.mark.empty()) {
      EXPECT_EQ(is_shape_file(line.mark, "a.h5"), std::optional(true)) << line.mark;
    }
  }
  EXPECT_EQ(shape_format_of("A.PLY"), std::optional(ShapeFormat::kPly));
  EXPECT_EQ(shape_format_of("ply"), std::nullopt);
}

TEST(formats, of_coefficients_are_found_by_name_and_extension) {
  for (const CoefficientsFormatInfo& known : coefficients_formats()) {
    for (const FileExtension& extension : known.file.extensions) {
      const std::string path = "a." + extension.name;
      EXPECT_EQ(coefficients_format_of(path), known.format) << path;
      EXPECT_EQ(is_model_name(path), !known.format) << path;
      const std::optional<bool> wanted = extension.shared ? std::nullopt : std::optional(false);
      EXPECT_EQ(is_shape_file({}, path), wanted) << path;
    }
    if (known.format) {
      EXPECT_EQ(parse_coefficients_format(known.file.name), *known.format);
    }
  }
}

// A mesh with every attribute that a format can hold.
TEST(formats, of_shapes_keep_what_they_say_they_hold) {
  Mesh mesh = icosphere(0);
  for (const char* name : {"nx", "ny", "nz", "red", "green", "blue", "alpha", "u", "v", "heat"}) {
    mesh.attributes.push_back({.name = name, .type = ScalarType::kUint8, .values = {}});
    mesh.attributes.back().values.assign(mesh.vertices.size(), 1);
  }
  for (const ShapeFormatInfo& known : shape_formats()) {
    if (!known.faces) continue;
    const auto path = std::filesystem::path(::testing::TempDir()) / ("held." + known.file.name);
    write_shape(mesh, path, {.format = known.format});
    const Mesh read = std::get<Mesh>(read_shape(path).shape);
    std::filesystem::remove(path);
    const std::vector<std::string> lost = attributes_left_out(mesh.attributes, known.format);
    const auto is_held = [&](const std::string& name) {
      const bool is_read = find_attribute(read.attributes, name) != nullptr;
      const bool is_said = std::find(lost.begin(), lost.end(), name) == lost.end();
      EXPECT_EQ(is_read, is_said) << known.file.name << " " << name;
      return is_read;
    };
    EXPECT_EQ(is_held("nx"), known.normals) << known.file.name;
    EXPECT_EQ(is_held("red"), known.colors) << known.file.name;
    EXPECT_EQ(is_held("alpha"), known.alpha) << known.file.name;
    EXPECT_EQ(is_held("u"), known.texture) << known.file.name;
    EXPECT_EQ(is_held("heat"), known.any_attributes) << known.file.name;
  }
}

}  // namespace
}  // namespace rholm
