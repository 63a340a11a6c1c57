#include "rholm/synthesize.h"

#include <algorithm>
#include <string>

#include "base/cancel.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

void set_normals(Mesh& mesh, const std::vector<Vec3>& normals) {
  const auto add = [&](const char* name, double Vec3::*part) {
    Attribute attribute{.name = name, .type = ScalarType::kFloat32, .values = {}};
    attribute.values.reserve(normals.size());
    for (const Vec3& n : normals) attribute.values.push_back(n.*part);
    mesh.attributes.push_back(std::move(attribute));
  };
  add("nx", &Vec3::x);
  add("ny", &Vec3::y);
  add("nz", &Vec3::z);
}

[[noreturn]] void throw_no_surface(const Vec3& u, double q, int degree) {
  throw Error(ErrorCode::kInvalidInput,
              "the gauge is " + std::to_string(q) + " in the direction (" + std::to_string(u.x) +
                  ", " + std::to_string(u.y) + ", " + std::to_string(u.z) + ") at degree " +
                  std::to_string(degree) +
                  ": no surface point lies there; take another degree, or the radius");
}

// x = center + r u, and the unit normal is along r u -
// grad_S r; with q = 1/r it is along q u + grad_S q.
Mesh surface_of_degree(const Expansion& expansion, const Mesh& sphere, int degree,
                       const Context& context) {
  require_surface(expansion);
  const bool gauge = expansion.function == RadialFunction::kGauge;
  const ValuesAndGradients f =
      evaluate_with_gradient(expansion.coefficients.resized(degree), sphere.vertices, {}, context);
  Mesh mesh;
  mesh.faces = sphere.faces;
  mesh.vertices.reserve(sphere.vertices.size());
  std::vector<Vec3> normals;
  normals.reserve(sphere.vertices.size());
  CancelPoll poll;
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    poll();
    const Vec3& u = sphere.vertices[i];
    const double value = f.values[i];
    if (gauge && !(value > 0)) throw_no_surface(u, value, degree);
    mesh.vertices.push_back(expansion.center + (gauge ? 1 / value : value) * u);
    const Vec3 slope = gauge ? -f.gradients[i] : f.gradients[i];
    normals.push_back(normalized(value * u - slope));
  }
  set_normals(mesh, normals);
  validate(mesh);  // a coefficient near the largest double may overflow the sum
  return mesh;
}

}  // namespace

std::vector<Mesh> synthesize(const Expansion& expansion, const Mesh& sphere,
                             std::span<const int> degrees, const Context& context) {
  std::vector<Mesh> meshes;
  for (const int degree : degrees) {
    if (degree < 0) {
      throw Error(ErrorCode::kInvalidInput,
                  "a degree must not be negative, as " + std::to_string(degree) + " is");
    }
    const int used = std::min(degree, expansion.coefficients.degree());
    meshes.push_back(surface_of_degree(expansion, sphere, used, context));
  }
  return meshes;
}

Mesh synthesize(const Expansion& expansion, const Mesh& sphere, const Context& context) {
  return surface_of_degree(expansion, sphere, expansion.coefficients.degree(), context);
}

Mesh directions_of(const Mesh& mesh, const Vec3& center) {
  Mesh sphere;
  sphere.faces = mesh.faces;
  sphere.vertices.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 x = mesh.vertices[i] - center;
    // Scaled first, because squares of coordinates beyond 1e150 would overflow.
    const double largest = std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    if (!(largest > 0)) {
      throw Error(
          ErrorCode::kInvalidInput,
          "vertex " + std::to_string(i) + " lies on the centre: it has no direction from there");
    }
    sphere.vertices.push_back(normalized(x / largest));
  }
  return sphere;
}

}  // namespace rholm
