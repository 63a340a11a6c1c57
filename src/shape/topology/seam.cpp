// The gap of a seam: borders that face each other across less than they have between their own
// vertices.
#include <algorithm>
#include <cmath>

#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Of the border: tolerances that leave more open are not worth telling.
constexpr double kLeftOpen = 0.1;
// Of the median edge of a border: smaller gaps are closed by the first try. Chosen: no shape has
// detail so fine between its vertices.
constexpr double kFinest = 0x1p-20;
constexpr int kMoreTries = 3;  // chosen: gaps of a seam vary by a factor of a few

// The triangles along a border.
struct Border {
  Mesh mesh;
  std::size_t edges = 0;  // of the border
  std::size_t inner = 0;  // of these triangles, in no other of them, but not of the border
  double median = 0;      // length of an edge of the border
};

std::size_t single_edges(const Mesh& mesh) {
  std::size_t n = 0;
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.triangles);
  half_edges.for_each_edge(
      [&](std::uint32_t, std::span<const HalfEdge> group) { n += group.size() == 1; });
  return n;
}

Border border_of(const Mesh& mesh) {
  Border border;
  std::vector<char> at_border(mesh.triangles.size(), 0);
  std::vector<double> lengths;
  const double scale = unit_frame(bounds(mesh.vertices)).scale;
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.triangles);
  half_edges.for_each_edge([&](std::uint32_t smaller, std::span<const HalfEdge> group) {
    if (group.size() != 1) return;
    at_border[group[0].triangle()] = 1;
    const Vec3 along = scale * mesh.vertices[group[0].larger()] - scale * mesh.vertices[smaller];
    lengths.push_back(norm(along) / scale);
  });
  border.edges = lengths.size();
  if (lengths.empty()) return border;
  border.mesh.vertices = mesh.vertices;
  for (std::size_t t = 0; t < at_border.size(); ++t) {
    if (at_border[t]) border.mesh.triangles.push_back(mesh.triangles[t]);
  }
  border.mesh = weld(border.mesh).mesh;  // drops the vertices of the others
  border.inner = single_edges(border.mesh) - border.edges;
  std::sort(lengths.begin(), lengths.end());
  border.median = lengths[lengths.size() / 2];
  return border;
}

// Up, with two digits.
double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit * (1 + 1e-9)) * unit;
}

// Edges of the border that are left when it is welded.
std::size_t left_open(const Border& border, double tolerance) {
  const std::size_t single = single_edges(weld(border.mesh, tolerance).mesh);
  return single - std::min(single, border.inner);
}

}  // namespace

std::optional<double> closing_tolerance(const Mesh& mesh) {
  validate(mesh);
  const Border border = border_of(mesh);
  if (border.edges == 0) return std::nullopt;
  const double enough = kLeftOpen * static_cast<double>(border.edges);
  // From below what can be told apart, doubled: the first that is enough, and one of the next where
  // it leaves less.
  std::optional<double> best;
  std::size_t least = border.edges;
  int more = kMoreTries;
  for (double t = kFinest * border.median; t < border.median / 2 && more > 0; t *= 2) {
    const double tolerance = rounded_up(t);
    const std::size_t left = left_open(border, tolerance);
    if (static_cast<double>(left) <= enough && left < least) {
      best = tolerance;
      least = left;
    }
    if (best && (least == 0 || --more == 0)) break;
  }
  // The rest of the mesh must bear it.
  if (!best || static_cast<double>(single_edges(weld(mesh, *best).mesh)) > enough) {
    return std::nullopt;
  }
  return best;
}

}  // namespace rholm
