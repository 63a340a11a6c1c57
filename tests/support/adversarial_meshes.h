// Star-shaped closed meshes for which estimates from a sample of the triangles fail, and meshes
// whose few unusual triangles do not follow the behaviour of the others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "base/random.h"
#include "rholm/mesh.h"
#include "rholm/primitives.h"

namespace rholm::test {

struct AdversarialMesh {
  std::string name;
  Mesh mesh;   // star-shaped about the origin
  int degree;  // degree to analyse to
  double precision;
};

namespace adversarial {

inline double smooth_radius(const Vec3& u) {
  return 1 + 0.05 * (std::sin(3 * u.x + u.y + 1) + std::cos(4 * u.y - 2 * u.z) +
                     std::sin(5 * u.z + 3 * u.x + 2) + std::cos(6 * u.x - 2 * u.y + 1));
}

// Moves each vertex along its ray to the radius that a function of the direction returns.
inline Mesh shaped(Mesh mesh, const std::function<double(const Vec3&)>& radius) {
  for (Vec3& v : mesh.vertices) {
    const Vec3 u = normalized(v);
    v = radius(u) * u;
  }
  return mesh;
}

// Returns the faces of a cube, row by row, with 12 n^2 triangles.
inline Mesh cube_sphere(int n) { return shaped(box({2, 2, 2}, n), smooth_radius); }
inline Mesh ico(int subdivisions) { return shaped(icosphere(subdivisions), smooth_radius); }

inline double signed_random(std::uint64_t stream, std::uint64_t i) {
  return 2 * random_uniform(stream, i) - 1;
}

// Returns the vertices of the triangles [first, first + n), without repetition.
inline std::vector<std::uint32_t> vertices_of_run(const Mesh& mesh, std::size_t first,
                                                  std::size_t n) {
  std::vector<std::uint32_t> found;
  for (std::size_t t = first; t < std::min(first + n, mesh.faces.size()); ++t) {
    for (const std::uint32_t v : mesh.faces[t]) found.push_back(v);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// Multiplies the radii of the vertices of n triangles by 1 + amplitude * random.
inline Mesh rough_run(Mesh mesh, std::size_t first, std::size_t n, double amplitude) {
  for (const std::uint32_t v : vertices_of_run(mesh, first, n)) {
    mesh.vertices[v] = (1 + amplitude * signed_random(7, v)) * mesh.vertices[v];
  }
  return mesh;
}

// Shifts the vertices of n triangles along the sphere by a part of an edge, then back onto the
// surface. The surface stays smooth, but its triangles become irregular.
inline Mesh shifted_run(Mesh mesh, std::size_t first, std::size_t n, double by) {
  for (const std::uint32_t v : vertices_of_run(mesh, first, n)) {
    Vec3 u = normalized(mesh.vertices[v]);
    u = normalized(u + by * Vec3{signed_random(11, v), signed_random(12, v), signed_random(13, v)});
    mesh.vertices[v] = smooth_radius(u) * u;
  }
  return mesh;
}

// Pulls directions towards the pole z, so that triangles have very different sizes.
inline Mesh pulled(Mesh mesh, double power) {
  for (Vec3& v : mesh.vertices) {
    Vec3 u = normalized(v);
    const double h = 2 * std::pow((1 + u.z) / 2, power) - 1;
    const double s = std::sqrt(std::max(0.0, 1 - h * h)), r = std::hypot(u.x, u.y);
    u = r > 0 ? Vec3{u.x / r * s, u.y / r * s, h} : Vec3{0, 0, u.z > 0 ? 1.0 : -1.0};
    v = smooth_radius(u) * u;
  }
  return mesh;
}

// Scales along the axes: triangles become needles as seen from the centre.
inline Mesh stretched(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v = {by.x * v.x, by.y * v.y, by.z * v.z};
  return mesh;
}

// Sorts the triangles by a key.
inline Mesh ordered(Mesh mesh, const std::function<double(std::size_t)>& key) {
  std::vector<std::size_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<Triangle> triangles;
  triangles.reserve(order.size());
  for (const std::size_t t : order) triangles.push_back(mesh.faces[t]);
  mesh.faces = std::move(triangles);
  return mesh;
}
inline Mesh in_random_order(Mesh mesh) {
  return ordered(std::move(mesh), [](std::size_t t) { return random_uniform(21, t); });
}
// Puts every triangle far from its neighbours, at a regular stride.
inline Mesh dealt_out(Mesh mesh, std::size_t stride) {
  return ordered(std::move(mesh), [=](std::size_t t) {
    return static_cast<double>(t % stride) * 1e9 + static_cast<double>(t);
  });
}

// Repeats some faces, once as they are and once flipped: the surface does not change.
inline Mesh with_duplicates(Mesh mesh, std::size_t every) {
  const std::size_t n = mesh.faces.size();
  for (std::size_t t = 0; t < n; t += every) {
    const Triangle f = mesh.faces[t];
    mesh.faces.push_back(f);
    mesh.faces.push_back({f[0], f[2], f[1]});
  }
  return mesh;
}

inline Mesh moved(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v = v + by;
  return mesh;
}

inline Mesh turned(Mesh mesh, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3& v : mesh.vertices) v = {v.x, c * v.y - s * v.z, s * v.y + c * v.z};
  return mesh;
}

// Multiplies the radius of one vertex in `every` by 1 + `by`.
inline Mesh spiked(Mesh mesh, std::size_t every, double by) {
  for (std::size_t v = every / 2; v < mesh.vertices.size(); v += every) {
    mesh.vertices[v] = (1 + by) * mesh.vertices[v];
  }
  return mesh;
}

inline Mesh lattice(int n_theta, int n_phi) {
  return shaped(latitude_longitude_sphere(n_theta, n_phi), smooth_radius);
}

// Returns a body that is nearly a ball.
inline Mesh planet(int n_theta, int n_phi) {
  return shaped(latitude_longitude_sphere(n_theta, n_phi),
                [](const Vec3& u) { return 1 + 1e-2 * (smooth_radius(u) - 1); });
}

// Moves the vertices of the northern third out of their rows.
inline Mesh half_lattice(int n_theta, int n_phi) {
  Mesh mesh = lattice(n_theta, n_phi);
  for (Vec3& v : mesh.vertices) {
    if (v.z <= 0.3) continue;
    const Vec3 u = normalized(v + 0.004 * Vec3{std::sin(40 * v.x), std::cos(37 * v.y), 0});
    v = smooth_radius(u) * u;
  }
  return mesh;
}

inline std::vector<AdversarialMesh> few_adversaries() {
  return {{"rough run", rough_run(cube_sphere(30), 128 * 50, 32, 3e-2), 48, 1e-4},
          {"lattice in step with 2 L", lattice(32, 64), 16, 1e-6},
          {"lattice, half of it", half_lattice(48, 96), 32, 1e-5},
          {"needles along", lattice(300, 12), 32, 1e-4},
          {"spikes", spiked(cube_sphere(30), 1001, 0.5), 32, 1e-4}};
}

}  // namespace adversarial

// kAll: all meshes, of 12 000 to 100 000 triangles. kFew: five small meshes that each stand for one
// kind of difficulty; their direct sums take a second.
enum class Adversaries { kAll, kFew };
inline std::vector<AdversarialMesh> adversarial_meshes(Adversaries which) {
  using namespace adversarial;
  std::vector<AdversarialMesh> all;
  if (which == Adversaries::kFew) return few_adversaries();
  const auto add = [&](std::string name, Mesh mesh, int degree, double precision) {
    all.push_back({std::move(name), std::move(mesh), degree, precision});
  };
  // A rough patch between the samples: runs of 128 triangles are sampled at multiples of n / 24.
  const Mesh cube = cube_sphere(60);  // 43 200 triangles, 337 runs of 128, one in 14 sampled
  for (const double amplitude : {3e-4, 3e-3, 3e-2}) {
    for (const auto& [degree, precision] :
         std::vector<std::pair<int, double>>{{32, 1e-5}, {64, 1e-4}, {64, 1e-6}, {96, 1e-4}}) {
      add("rough run " + std::to_string(amplitude), rough_run(cube, 128 * 100, 64, amplitude),
          degree, precision);
    }
  }
  add("rough run of 16", rough_run(cube, 128 * 203 + 40, 16, 1e-2), 96, 1e-4);
  add("rough run of 2", rough_run(cube, 128 * 203 + 40, 2, 5e-2), 96, 1e-4);
  add("rough run, fine", rough_run(cube_sphere(90), 128 * 333, 64, 1e-3), 128, 1e-4);
  // The surface is smooth, but some of its triangles are irregular.
  for (const double by : {2e-3, 8e-3}) {
    add("shifted run " + std::to_string(by), shifted_run(cube, 128 * 100, 128, by), 96, 1e-4);
    add("shifted quarter " + std::to_string(by), shifted_run(cube, 128 * 100, 128 * 80, by), 96,
        1e-4);
    add("shifted quarter " + std::to_string(by), shifted_run(cube, 128 * 100, 128 * 80, by), 48,
        1e-6);
  }
  // Triangles have two length scales.
  for (const double power : {2.0, 5.0, 0.3}) {
    add("pulled " + std::to_string(power), pulled(cube_sphere(40), power), 64, 1e-5);
    add("pulled " + std::to_string(power), pulled(ico(5), power), 48, 1e-4);
  }
  {
    const Mesh pole = pulled(cube_sphere(40), 5);
    add("pulled, large ones last",
        ordered(pole, [&](std::size_t t) { return -pole.vertices[pole.faces[t][0]].z; }), 64, 1e-5);
  }
  // Lattices that are aligned with the grid, aligned in part, and turned by a small angle.
  add("lattice", lattice(80, 160), 64, 1e-5);
  add("lattice in step with L", lattice(64, 128), 64, 1e-4);
  add("lattice in step with 2 L", lattice(96, 192), 48, 1e-6);
  add("lattice turned", turned(lattice(80, 160), 1e-3), 64, 1e-5);
  add("lattice turned over", turned(lattice(80, 160), 1.5707963267948966), 64, 1e-5);
  add("lattice, half of it", half_lattice(90, 180), 64, 1e-5);
  add("lattice of a ball", latitude_longitude_sphere(80, 160), 64, 1e-6);
  add("lattice of a ball", latitude_longitude_sphere(80, 160), 32, 1e-6);
  add("lattice of a ball", latitude_longitude_sphere(64, 128), 64, 1e-3);
  add("lattice of a ball", latitude_longitude_sphere(80, 160), 16, 1e-6);
  add("lattice of a planet", planet(80, 160), 48, 1e-6);
  add("lattice of a planet", planet(64, 128), 64, 1e-4);
  add("ball", icosphere(5), 48, 1e-4);
  // Meshes whose sums use Hessians at vertices; their spacing matches the width of the windows.
  add("Hessians", bumpy_sphere(5, 0.2), 48, 1e-8);
  add("Hessians", bumpy_sphere(6, 0.2), 64, 1e-9);
  add("Hessians", bumpy_sphere(6, 0.2), 128, 1e-7);
  add("prism", box({2, 2, 2}, 40), 64, 1e-4);
  add("prism, long", box({1, 1, 6}, 40), 48, 1e-4);
  // Triangles are needles.
  add("needles around", lattice(24, 800), 64, 1e-4);
  add("needles along", lattice(800, 24), 64, 1e-4);
  add("needles by stretching", stretched(ico(5), {1, 1, 12}), 48, 1e-4);
  add("needles by flattening", stretched(ico(5), {1, 1, 0.05}), 32, 1e-4);
  // Surfaces with creases, across runs of triangles and everywhere.
  add("box", box({3, 2, 1}, 35), 64, 1e-5);
  add("creased rows",
      shaped(box({2, 2, 2}, 45),
             [](const Vec3& u) {
               return smooth_radius(u) * (1 + 0.004 * std::abs(std::sin(40 * u.z)));
             }),
      64, 1e-4);
  add("creased, dealt out", dealt_out(box({3, 2, 1}, 35), 97), 64, 1e-4);
  add("dealt out", dealt_out(cube_sphere(50), 101), 96, 1e-4);
  add("random order", in_random_order(cube_sphere(50)), 96, 1e-4);
  add("rough run, random order", in_random_order(rough_run(cube, 12800, 64, 3e-3)), 96, 1e-4);
  // Radii alternate from vertex to vertex: the shortest wave that the mesh can hold.
  add("up and down",
      shaped(box({2, 2, 2}, 50),
             [k = 0](const Vec3& u) mutable {
               return smooth_radius(u) * (1 + (k++ % 2 == 0 ? 1e-3 : -1e-3));
             }),
      64, 1e-4);
  add("noise", rough_run(cube, 0, 1u << 20, 1e-2), 64, 1e-5);
  add("spikes", spiked(cube, 4001, 0.5), 64, 1e-4);
  add("one spike", spiked(cube, 40001, 3), 64, 1e-4);
  add("dents", spiked(cube, 4001, -0.6), 64, 1e-4);
  // Repeated faces cancel each other.
  add("duplicates", with_duplicates(cube, 50), 64, 1e-5);
  add("duplicates of a rough run", with_duplicates(rough_run(cube, 12800, 64, 3e-2), 7), 64, 1e-4);
  // The centre lies off the middle.
  add("eccentric", moved(cube, {0.6, 0.2, 0.1}), 64, 1e-5);
  add("nearly on the surface", moved(icosphere(5), {0.93, 0, 0}), 48, 1e-4);
  add("rough run, eccentric", moved(rough_run(cube, 128 * 100, 64, 3e-3), {0.3, -0.5, 0}), 64,
      1e-5);
  return all;
}

}  // namespace rholm::test
