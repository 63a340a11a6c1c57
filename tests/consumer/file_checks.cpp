// Input and output of files.
#include <rholm/coefficients_io.h>
#include <rholm/compare.h>
#include <rholm/file.h>
#include <rholm/formats.h>
#include <rholm/large_mesh.h>
#include <rholm/mapped_mesh.h>
#include <rholm/point_stream.h>
#include <rholm/points.h>
#include <rholm/primitives.h>
#include <rholm/shape_io.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "check.h"

namespace {

namespace fs = std::filesystem;

void file() {
  const fs::path path = "written.bin";
  const std::string_view text = "r, l, m";
  rholm::write_file(path, text);
  expect(fs::file_size(path) == text.size(), "all bytes are written");
}

void shape_io() {
  const rholm::Mesh box = rholm::box({1, 2, 3});
  rholm::write_shape(box, "box.obj");
  const rholm::ShapeFile file = rholm::read_shape("box.obj");
  expect(file.format == rholm::ShapeFormat::kObj, "the content says the format");
  const auto& read = std::get<rholm::Mesh>(file.shape);
  expect(read.vertices == box.vertices && read.faces == box.faces, "what is written is read");
}

void formats() {
  for (const rholm::ShapeFormatInfo& known : rholm::shape_formats()) {
    expect(rholm::shape_format_of("a." + known.file.extensions.at(0).name) == known.format,
           "extensions name their format");
  }
  expect(rholm::is_model_name("a.h5") && !rholm::is_model_name("a.ply"), "models have their own");
}

void point_stream() {
  const rholm::Mesh box = rholm::box({1, 2, 3});
  rholm::write_shape(box, "box.ply");
  rholm::PointStream stream("box.ply");
  rholm::PointCloud piece;
  std::size_t n = 0;
  while (stream.read(3, piece)) n += piece.points.size();
  expect(n == box.vertices.size() && stream.size() == n, "all points come, three at a time");
  rholm::write_shape(rholm::sample_surface(box, {.points = 50}), "points.ply");
  expect(rholm::convert_points("points.ply", "points.xyz").points == 50, "and are converted");
}

void coefficients_io() {
  const std::string_view sphere = "0 0 2 0\n1 0 0 0\n1 1 0 0\n";  // 4-pi: C_00 is the radius
  const rholm::CoefficientsFile file = rholm::parse_coefficients(sphere, "sphere.sh");
  expect_near(file.expansion.coefficients.c(0, 0), 2 * std::sqrt(4 * std::numbers::pi), 1e-12,
              "C_00 of a sphere of radius 2");
  rholm::write_coefficients(file.expansion, "sphere.json");
  expect(rholm::read_coefficients("sphere.json").format == rholm::CoefficientsFormat::kJson,
         "the content says the format");
}

void mapped_mesh() {
  const rholm::Mesh sphere = rholm::icosphere(3);
  rholm::write_shape(sphere, "sphere.ply");
  const auto mapped = rholm::map_mesh("sphere.ply");
  expect(mapped && mapped->view().n_faces == sphere.faces.size(), "a mesh is mapped");
  expect(mapped->counts_are_three(0, sphere.faces.size()), "faces are triangles");
  expect(mapped->view().vertex(5) == sphere.vertices[5], "vertices lie where they should");
}

void large_mesh() {
  rholm::write_shape(rholm::icosphere(3), "large.ply");
  const auto mapped = rholm::map_mesh("large.ply");
  expect(mapped && rholm::has_triangles_only(*mapped) && !rholm::has_attributes(*mapped),
         "it is plain");
  expect(mapped && rholm::survey_mesh(*mapped).closed, "and closed");
  if (!mapped) return;
  const rholm::MeshInPlace large = rholm::in_place(*mapped);
  expect(rholm::compare(large, large, 1 << 20, {.samples = 100}).hausdorff < 1e-12, "no distance");
  expect(rholm::convert_mesh("large.ply", "large.off").has_value(), "and it is converted");
}

}  // namespace

std::vector<HeaderCheck> file_checks() {
  return {{"file.h", file},
          {"shape_io.h", shape_io},
          {"formats.h", formats},
          {"point_stream.h", point_stream},
          {"coefficients_io.h", coefficients_io},
          {"mapped_mesh.h", mapped_mesh},
          {"large_mesh.h", large_mesh}};
}
