#include "rholm/primitives.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/cancel.h"
#include "base/random.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

using std::numbers::pi;

constexpr int kMaxSubdivisions = 12;
constexpr int kMaxBoxSquares = 4096;  // 12 n^2 triangles: 2e8

void require(bool good, const std::string& message) {
  if (!good) throw Error(ErrorCode::kInvalidInput, message);
}

void require_between(int value, int low, int high, const char* what) {
  require(value >= low && value <= high, std::string(what) + " is " + std::to_string(value) +
                                             ", it must be " + std::to_string(low) + " ... " +
                                             std::to_string(high));
}

void require_length(double value, const char* what) {
  require(std::isfinite(value) && value > 0, std::string(what) + " is " + std::to_string(value) +
                                                 ", it must be a positive, finite number");
}

void require_grid(int n, int least_n, int m, int least_m, const char* what) {
  require(n >= least_n && m >= least_m && static_cast<long long>(n) * m <= kMaxGridVertices,
          std::string(what) + " has " + std::to_string(n) + " x " + std::to_string(m) +
              " vertices, it must have at least " + std::to_string(least_n) + " x " +
              std::to_string(least_m) + " and at most " + std::to_string(kMaxGridVertices) +
              " in all");
}

// Makes the vertices (0, +-1, +-golden ratio) and their cyclic permutations, on the unit sphere.
Mesh icosahedron() {
  const double length = std::sqrt(1 + std::numbers::phi * std::numbers::phi);
  const double a = 1 / length, b = std::numbers::phi / length;
  Mesh mesh;
  mesh.vertices = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                   {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

// Splits each triangle into four; the midpoint of every edge moves to the unit sphere. New vertices
// are numbered in the order of the edges.
Mesh subdivide_on_sphere(const Mesh& mesh) {
  const HalfEdges edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
  Mesh fine;
  fine.vertices = mesh.vertices;
  fine.vertices.reserve(mesh.vertices.size() + edges.sorted.size() / 2);
  std::vector<std::uint32_t> middle(3 * mesh.faces.size());  // per corner: of the edge it begins
  edges.for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> group) {
    for (const HalfEdge& half_edge : group) {
      middle[half_edge.corner()] = static_cast<std::uint32_t>(fine.vertices.size());
    }
    fine.vertices.push_back(normalized(mesh.vertices[smaller] + mesh.vertices[group[0].larger()]));
  });
  fine.faces.reserve(4 * mesh.faces.size());
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    const auto [a, b, c] = mesh.faces[t];
    const std::uint32_t ab = middle[3 * t], bc = middle[3 * t + 1], ca = middle[3 * t + 2];
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return fine;
}

// Adds the two triangles of the square a b c d, counter-clockwise.
void add_square(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.faces.push_back({a, b, c});
  mesh.faces.push_back({a, c, d});
}

// Adds the face of a box on which axis `k` has its largest value (side 1) or smallest
// (side 0). It has n x n squares with their own vertices. Coordinates of a lattice point
// have the same bits on all faces.
void add_box_face(Mesh& mesh, const Vec3& size, int n, int k, int side) {
  const double lengths[3] = {size.x, size.y, size.z};
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  // Seen from the positive side, axes k + 1, k + 2 are counter-clockwise.
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      double x[3];
      x[k] = lengths[k] * (side - 0.5);
      x[(k + 1) % 3] = lengths[(k + 1) % 3] * (static_cast<double>(i) / n - 0.5);
      x[(k + 2) % 3] = lengths[(k + 2) % 3] * (static_cast<double>(j) / n - 0.5);
      mesh.vertices.push_back({x[0], x[1], x[2]});
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const std::uint32_t a = first + static_cast<std::uint32_t>(j * (n + 1) + i);
      const std::uint32_t up = static_cast<std::uint32_t>(n + 1);
      if (side == 1) {
        add_square(mesh, a, a + 1, a + up + 1, a + up);
      } else {
        add_square(mesh, a, a + up, a + up + 1, a + 1);
      }
    }
  }
}

// One wave weight * cos(k . u + phase) of the bumps.
struct Wave {
  Vec3 k;
  double phase = 0;
  double weight = 0;
};

// Returns eight waves. Their weights add up to 1, so that the sum is at most 1 in modulus. Wave
// numbers are 2 to 7 (chosen: several bumps per radian, resolved by a few hundred triangles).
std::vector<Wave> random_waves(std::uint64_t seed) {
  constexpr int n = 8;
  std::vector<Wave> waves(n);
  std::uint64_t counter = 0;
  const auto uniform = [&] { return random_uniform(seed, counter++); };
  for (Wave& wave : waves) {
    const double z = 2 * uniform() - 1, phi = 2 * pi * uniform();
    const double s = std::sqrt(1 - z * z), length = 2 + 5 * uniform();
    wave.k = length * Vec3{s * std::cos(phi), s * std::sin(phi), z};
    wave.phase = 2 * pi * uniform();
    wave.weight = 1.0 / n;
  }
  return waves;
}

}  // namespace

Mesh icosphere(int subdivisions) {
  require_between(subdivisions, 0, kMaxSubdivisions, "the number of subdivisions");
  Mesh mesh = icosahedron();
  for (int i = 0; i < subdivisions; ++i) mesh = subdivide_on_sphere(mesh);
  return mesh;
}

Mesh latitude_longitude_sphere(int n_theta, int n_phi) {
  require_grid(n_theta, 1, n_phi, 3, "the grid of the sphere");
  Mesh mesh;
  mesh.vertices.push_back({0, 0, 1});
  for (int i = 0; i < n_theta; ++i) {
    const double theta = pi * (i + 0.5) / n_theta;
    for (int j = 0; j < n_phi; ++j) {
      const double phi = 2 * pi * j / n_phi;
      mesh.vertices.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  mesh.vertices.push_back({0, 0, -1});
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(1 + i * n_phi + j % n_phi);
  };
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (int j = 0; j < n_phi; ++j) mesh.faces.push_back({0, index(0, j), index(0, j + 1)});
  for (int i = 0; i + 1 < n_theta; ++i) {
    for (int j = 0; j < n_phi; ++j) {
      add_square(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  for (int j = 0; j < n_phi; ++j) {
    mesh.faces.push_back({south, index(n_theta - 1, j + 1), index(n_theta - 1, j)});
  }
  return mesh;
}

Mesh ellipsoid(const Vec3& semi_axes, int subdivisions) {
  for (const double axis : {semi_axes.x, semi_axes.y, semi_axes.z}) {
    require_length(axis, "a semi-axis of the ellipsoid");
  }
  Mesh mesh = icosphere(subdivisions);
  for (Vec3& v : mesh.vertices) v = {semi_axes.x * v.x, semi_axes.y * v.y, semi_axes.z * v.z};
  return mesh;
}

Mesh box(const Vec3& size, int n) {
  for (const double length : {size.x, size.y, size.z}) {
    require_length(length, "an edge length of the box");
  }
  require_between(n, 1, kMaxBoxSquares, "the number of squares per edge of the box");
  Mesh mesh;
  for (int k = 0; k < 3; ++k) {
    for (int side = 0; side < 2; ++side) add_box_face(mesh, size, n, k, side);
  }
  return weld(mesh).mesh;
}

Mesh torus(double ring_radius, double tube_radius, int n_ring, int n_tube) {
  require_length(tube_radius, "the radius of the tube");
  require_length(ring_radius, "the radius of the torus' centre line");
  require(tube_radius < ring_radius, "the radius of the tube is " + std::to_string(tube_radius) +
                                         ", it must be below that of the centre line, " +
                                         std::to_string(ring_radius));
  require_grid(n_ring, 3, n_tube, 3, "the torus");
  Mesh mesh;
  for (int i = 0; i < n_ring; ++i) {
    const double phi = 2 * pi * i / n_ring;
    for (int j = 0; j < n_tube; ++j) {
      const double psi = 2 * pi * j / n_tube;
      const double rho = ring_radius + tube_radius * std::cos(psi);
      mesh.vertices.push_back(
          {rho * std::cos(phi), rho * std::sin(phi), tube_radius * std::sin(psi)});
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % n_ring) * n_tube + j % n_tube);
  };
  for (int i = 0; i < n_ring; ++i) {
    for (int j = 0; j < n_tube; ++j) {
      add_square(mesh, index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1));
    }
  }
  return mesh;
}

Mesh bumpy_sphere(int subdivisions, double amplitude, std::uint64_t seed) {
  require(amplitude >= 0 && amplitude < 1, "the amplitude of the bumps is " +
                                               std::to_string(amplitude) +
                                               ", it must be at least 0 and below 1");
  const std::vector<Wave> waves = random_waves(seed);
  Mesh mesh = icosphere(subdivisions);
  CancelPoll poll;
  for (Vec3& u : mesh.vertices) {
    poll();
    double bumps = 0;
    for (const Wave& wave : waves) bumps += wave.weight * std::cos(dot(wave.k, u) + wave.phase);
    u = (1 + amplitude * bumps) * u;
  }
  return mesh;
}

}  // namespace rholm
