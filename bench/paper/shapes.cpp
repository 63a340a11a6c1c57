#include "shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <variant>

#include "base/random.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"
#include "rholm/topology.h"

namespace rholm::paper {
namespace {

std::filesystem::path find_file(const Data& data, const std::string& key) {
  if (data.folder.empty() || key.empty()) return {};
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(data.folder)) {
    std::string name = entry.path().filename().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (entry.is_regular_file() && name.find(key) != std::string::npos) {
      found.push_back(entry.path());
    }
  }
  if (found.empty()) return {};
  return *std::min_element(found.begin(), found.end());
}

// Splits each triangle into four at the middles of its edges, which stay in its plane.
Mesh quartered(const Mesh& mesh) {
  Mesh fine;
  fine.vertices = mesh.vertices;
  fine.faces.reserve(4 * mesh.faces.size());
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    const auto [at, is_new] =
        middles.try_emplace(key, static_cast<std::uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / 2);
    return at->second;
  };
  for (const Triangle& t : mesh.faces) {
    const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
    for (const Triangle& part :
         {Triangle{t[0], a, c}, Triangle{t[1], b, a}, Triangle{t[2], c, b}, Triangle{a, b, c}}) {
      fine.faces.push_back(part);
    }
  }
  return fine;
}

StarChart chart_of_file(const Mesh& mesh, const Context& context) {
  Mesh welded = weld(mesh).mesh;
  if (inspect(welded).inside_out) flip(welded);
  return make_star_chart(welded, {.allow_signed = true}, context);
}

// Values are uniform in +-sqrt 3, which has the variance 1.
Coefficients random_coefficients(int degree, double exponent, double rms, std::uint64_t seed) {
  Coefficients result(degree);
  double energy = 0;
  std::uint64_t counter = 0;
  const auto draw = [&] { return (2 * random_uniform(seed, ++counter) - 1) * std::sqrt(3.0); };
  for (int l = 2; l <= degree; ++l) {
    const double scale = std::pow(l, exponent / 2) / std::sqrt(2 * l + 1.0);
    for (int m = 0; m <= l; ++m) {
      result.c(l, m) = scale * draw();
      if (m > 0) result.s(l, m) = scale * draw();
    }
    energy += std::pow(l, exponent);
  }
  // The rms over directions is the sum of squares / 4 pi, to the power 1/2.
  const double factor = rms * std::sqrt(4 * std::numbers::pi / energy);
  for (double& value : result.values()) value *= factor;
  return result;
}

// Outline of the vase from lip to foot: distance from the axis, and height.
constexpr std::array<std::array<double, 2>, 9> kOutline = {{{0.50, 1.00},
                                                            {0.47, 0.88},
                                                            {0.46, 0.74},
                                                            {0.58, 0.50},
                                                            {0.76, 0.20},
                                                            {0.80, -0.15},
                                                            {0.68, -0.52},
                                                            {0.49, -0.82},
                                                            {0.50, -1.00}}};

// Returns the radius of the side for a colatitude: Hermite's cubics with slopes of central
// differences, and straight lines beyond the ends.
double side_radius(double theta) {
  const std::size_t last = kOutline.size() - 1;
  const auto angle = [](std::size_t i) { return std::atan2(kOutline[i][0], kOutline[i][1]); };
  const auto radius = [](std::size_t i) { return std::hypot(kOutline[i][0], kOutline[i][1]); };
  const auto slope = [&](std::size_t k) {
    const std::size_t a = k > 0 ? k - 1 : k, b = std::min(k + 1, last);
    return (radius(b) - radius(a)) / (angle(b) - angle(a));
  };
  if (theta <= angle(0)) return radius(0) + (theta - angle(0)) * slope(0);
  if (theta >= angle(last)) return radius(last) + (theta - angle(last)) * slope(last);
  std::size_t i = 0;
  while (theta > angle(i + 1)) ++i;
  const double h = angle(i + 1) - angle(i), t = (theta - angle(i)) / h;
  return (1 + 2 * t) * (1 - t) * (1 - t) * radius(i) + t * (1 - t) * (1 - t) * h * slope(i) +
         t * t * (3 - 2 * t) * radius(i + 1) - t * t * (1 - t) * h * slope(i + 1);
}

// Returns the smaller radius of side and flat lid or foot (height 1 or -1), rounded at their edge.
double vase_radius(double theta) {
  constexpr double kRounding = 0.015;  // chosen: a few triangles wide
  const double side = side_radius(theta), c = std::abs(std::cos(theta));
  if (c * side < 0.8) return side;
  return -kRounding * std::log(std::exp(-side / kRounding) + std::exp(-1 / c / kRounding));
}

}  // namespace

Subject subject(const std::string& name, const std::string& key, const Data& data,
                std::size_t faces, const Mesh& stand_in, const std::string& made,
                const Context& context) {
  const std::filesystem::path path = find_file(data, key);
  if (path.empty()) return subject_of(name, made, stand_in, {}, context);
  const ShapeFile file = read_shape(path);
  Mesh mesh = weld(std::get<Mesh>(file.shape)).mesh;
  mesh.attributes.clear();
  std::string source = path.filename().string();
  std::size_t parts = 1;
  for (; 2 * mesh.faces.size() < faces; parts *= 4) mesh = quartered(mesh);
  if (parts > 1) source += fmt::format(", each face cut into {}", parts);
  return {name, source, true, chart_of_file(mesh, context)};
}

Subject subject_of(const std::string& name, const std::string& made, const Mesh& mesh,
                   const Vec3& center, const Context& context) {
  const CenterOptions at = {.kind = CenterKind::kGiven, .point = center};
  return {name, made, false, make_star_chart(mesh, {.center = at}, context)};
}

Mesh sphere_of_faces(std::size_t faces) {
  const double squares = std::sqrt(static_cast<double>(faces) / 12.0);
  Mesh mesh = box({2, 2, 2}, std::max(1, static_cast<int>(std::lround(squares))));
  for (Vec3& x : mesh.vertices) {
    const auto at = [](double t) { return std::tan(std::numbers::pi / 4 * t); };
    x = normalized({at(x.x), at(x.y), at(x.z)});
  }
  return mesh;
}

Mesh rough_body(std::size_t faces, int degree, std::uint64_t seed, const Context& context) {
  Mesh mesh = sphere_of_faces(faces);
  const Coefficients detail = random_coefficients(degree, -3.5, 0.12, seed);
  const std::vector<double> values = evaluate(detail, mesh.vertices, {.precision = 1e-9}, context);
  for (std::size_t i = 0; i < values.size(); ++i) mesh.vertices[i] *= 1 + values[i];
  return mesh;
}

Mesh vase(std::size_t faces, const Context& context) {
  Mesh mesh = sphere_of_faces(faces);
  const Coefficients detail = random_coefficients(400, -2.5, 0.004, 5);
  const std::vector<double> values = evaluate(detail, mesh.vertices, {.precision = 1e-9}, context);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3 u = mesh.vertices[i];
    const double theta = std::atan2(std::hypot(u.x, u.y), u.z), phi = std::atan2(u.y, u.x);
    const double belly = std::exp(-std::pow((theta - 1.75) / 0.42, 4));
    const double flutes = 0.018 * belly * std::abs(std::cos(14 * phi));
    mesh.vertices[i] *= vase_radius(theta) * (1 + flutes + values[i]);
  }
  return mesh;
}

Mesh octahedron() {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t i = 0; i < 6; ++i) mesh.vertices[i] *= 0.6 + random_uniform(1, i);
  mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return mesh;
}

Mesh rough_asteroid(int subdivisions) {
  Mesh mesh = bumpy_sphere(subdivisions, 0.35, 7);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Vec3& v = mesh.vertices[i];
    v *= 0.97 + 0.06 * random_uniform(3, i);
    v = {1.8 * v.x, v.y, 0.8 * v.z};
  }
  return mesh;
}

}  // namespace rholm::paper
