// Triangles and points.
#include <rholm/error.h>
#include <rholm/mesh.h>
#include <rholm/mesh_view.h>
#include <rholm/outward.h>
#include <rholm/points.h>
#include <rholm/polygon.h>
#include <rholm/primitives.h>
#include <rholm/repair.h>
#include <rholm/simplify.h>
#include <rholm/topology.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "check.h"

namespace {

void mesh() {
  rholm::Mesh mesh = rholm::box({1, 1, 1});
  mesh.attributes.push_back({"quality", rholm::ScalarType::kFloat64, std::vector<double>(8, 0.5)});
  rholm::validate(mesh);
  expect(rholm::find_attribute(mesh.attributes, "quality")->values[7] == 0.5,
         "attributes are found");
  mesh.faces[0][0] = 8;
  try {
    rholm::validate(mesh);
  } catch (const rholm::Error&) {
    return;
  }
  expect(false, "vertex 8 of 8 is refused");
}

void outward() {
  rholm::Mesh mesh = rholm::box({1, 1, 1});
  rholm::flip(mesh);
  expect(rholm::enclosed_volume(rholm::outward(mesh).welded.mesh) > 0, "a box faces outwards");
}

void polygon() {
  const std::vector<rholm::Vec3> corners = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}};
  std::vector<rholm::Triangle> triangles;
  rholm::triangulate_polygon(corners, std::vector<std::uint32_t>{0, 1, 2, 3, 4}, triangles);
  expect(triangles.size() == 3, "a pentagon is three triangles");
}

// Coordinates in single precision in another program's arrays, with a colour after each vertex.
void mesh_view() {
  struct Vertex {
    float x, y, z;
    std::uint8_t rgba[4];
  };
  const Vertex corners[3] = {{0, 0, 0, {}}, {2, 0, 0, {}}, {0, 2, 0.5F, {}}};
  const std::uint32_t faces[3] = {0, 1, 2};
  const rholm::MeshView view{
      reinterpret_cast<const std::byte*>(corners), 3, sizeof(Vertex), rholm::ScalarType::kFloat32,
      reinterpret_cast<const std::byte*>(faces),   1, sizeof faces};
  rholm::validate(view);
  expect(view.vertex(view.triangle(0)[2]) == rholm::Vec3{0, 2, 0.5}, "a view shows what is there");
}

void points() {
  rholm::PointCloud cloud = rholm::sample_surface(rholm::icosphere(4), {.points = 2000});
  cloud.points.push_back(cloud.points[0]);
  cloud.normals.clear();
  expect(rholm::clean(cloud).duplicates == 1 && cloud.points.size() == 2000, "a point goes");
  rholm::orient(cloud);
  double least = 1;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    least = std::min(least, rholm::dot(cloud.points[i], cloud.normals[i]));
  }
  expect(least > 0.9, "normals of a sphere point away from its centre");
}

void primitives() {
  const rholm::Mesh torus = rholm::torus(2, 0.5, 192, 96);
  expect(torus.vertices.size() == 192 * 96, "a torus is a grid");
  // A polygon of n corners in a circle has less area than the circle by (2 pi / n)^2 / 6, here
  // 7e-4.
  const double volume = 2 * std::pow(std::numbers::pi, 2) * 2 * 0.5 * 0.5;
  expect_near(rholm::enclosed_volume(torus), volume, 2e-3 * volume, "the volume of a torus");
}

void repair() {
  rholm::Mesh open = rholm::box({1, 1, 1}, 4);
  open.faces.pop_back();
  const rholm::Repaired mended = rholm::repair(open);
  expect(mended.report.closed_holes == 1 && mended.report.after.closed, "a hole is closed");
  expect_near(rholm::enclosed_volume(mended.mesh), 1, 1e-12, "the volume of the mended box");
}

void simplify() {
  const rholm::Simplification fewer = rholm::simplify(rholm::box({1, 1, 1}, 8), {.faces = 12});
  expect(fewer.mesh.faces.size() == 12, "a box needs 12 triangles");
  expect_near(rholm::surface_area(fewer.mesh), 6, 1e-12, "its area stays");
}

void topology() {
  const rholm::Inspection box = rholm::inspect(rholm::box({2, 3, 4}, 5));
  expect(box.closed && box.manifold && box.oriented && box.genus == 0, "a box is closed");
  expect_near(box.volume, 24, 1e-12, "the volume of a box");
  expect_near(box.area, 52, 1e-12, "the area of a box");
  expect(rholm::inspect(rholm::torus(2, 0.5, 24, 12)).genus == 1, "a torus has a handle");
  expect(rholm::pair_edges(rholm::box({1, 1, 1})).size() == 18, "12 triangles have 18 edges");
}

}  // namespace

std::vector<HeaderCheck> shape_checks() {
  return {{"mesh.h", mesh},     {"mesh_view.h", mesh_view}, {"outward.h", outward},
          {"points.h", points}, {"polygon.h", polygon},     {"primitives.h", primitives},
          {"repair.h", repair}, {"simplify.h", simplify},   {"topology.h", topology}};
}
