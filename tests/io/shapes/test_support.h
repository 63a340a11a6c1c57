// Small shapes and helpers for the tests of readers and writers.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "rholm/error.h"
#include "rholm/shape_io.h"

namespace rholm::testing {

inline ShapeFile parse(std::string_view text, const std::string& name = "test",
                       const ShapeReadOptions& options = {}) {
  ShapeFile file = parse_shape({text.data(), text.size()}, name, options);
  std::visit([](const auto& shape) { validate(shape); }, file.shape);
  return file;
}
inline Mesh parse_mesh(std::string_view text, const std::string& name = "test") {
  return std::get<Mesh>(parse(text, name).shape);
}
inline PointCloud parse_points(std::string_view text, const std::string& name = "test") {
  return std::get<PointCloud>(parse(text, name).shape);
}

// Checks that `action` throws rholm::Error with the code and all words in its message.
template <class Action>
void expect_error(Action&& action, ErrorCode code, std::initializer_list<const char*> words = {}) {
  try {
    action();
    ADD_FAILURE() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(to_string(error.code()), std::string(to_string(code))) << error.what();
    for (const char* word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
          << "'" << word << "' is not in: " << error.what();
    }
  }
}
inline void expect_refused(std::string_view text, std::initializer_list<const char*> words,
                           const std::string& name = "test") {
  SCOPED_TRACE(text.substr(0, 200));
  expect_error([&] { parse(text, name); }, ErrorCode::kInvalidInput, words);
}

// The tetrahedron of the origin and the unit points: volume 1/6, faces oriented outwards.
inline const std::vector<Vec3> kTetrahedronVertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const std::vector<Triangle> kTetrahedronTriangles = {
    {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline void expect_tetrahedron(const Mesh& mesh) {
  EXPECT_EQ(mesh.vertices, kTetrahedronVertices);
  EXPECT_EQ(mesh.faces, kTetrahedronTriangles);
}

// By the divergence theorem, the volume is a sixth of the sum of triple products. Every missing,
// doubled or flipped triangle of a cube changes it.
inline double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.faces) {
    sum += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
  }
  return sum;
}

// Collects bytes in a chosen byte order.
class BytesBuilder {
 public:
  explicit BytesBuilder(bool big_endian = false) : big_endian_(big_endian) {}
  BytesBuilder& text(std::string_view text) {
    bytes_ += text;
    return *this;
  }
  template <class T, class... Values>
  BytesBuilder& put(Values... values) {
    (put_one(static_cast<T>(values)), ...);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  void put_one(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    const bool host_is_big = std::endian::native == std::endian::big;
    if (host_is_big != big_endian_) std::reverse(std::begin(raw), std::end(raw));
    bytes_.append(raw, sizeof(T));
  }
  bool big_endian_;
  std::string bytes_;
};

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_all(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// A folder for one test, which is removed afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("rholm-") + info->test_suite_name() + "-" + info->name() + "-" +
             std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t n_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace rholm::testing
