// Finds the gap of a seam: two borders face each other at a smaller distance
// than their own vertices have.
#include <algorithm>
#include <cmath>

#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/topology/half_edges.h"

namespace rholm {
namespace {

// Largest fraction of a border that a useful tolerance may leave open.
constexpr double kLeftOpen = 0.1;
// Smallest tolerance relative to the border's median edge; smaller gaps are closed by the first
// try. Chosen: no shape has such fine detail between its vertices.
constexpr double kFinest = 0x1p-20;
constexpr int kMoreTries = 3;  // chosen: gaps of a seam vary by a factor of a few

// The triangles along a border, as a mesh.
struct Border {
  Mesh mesh;
  std::size_t edges = 0;  // number of edges of the border
  std::size_t inner = 0;  // number of edges of a single triangle, off the border
  double median = 0;      // length of an edge of the border
};

std::size_t single_edges(const Mesh& mesh) {
  std::size_t n = 0;
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
  half_edges.for_each_edge(
      [&](std::uint32_t, std::span<const HalfEdge> group) { n += group.size() == 1; });
  return n;
}

Border border_of(const Mesh& mesh) {
  Border border;
  std::vector<char> at_border(mesh.faces.size(), 0);
  std::vector<double> lengths;
  const double scale = unit_frame(bounds(mesh.vertices)).scale;
  const HalfEdges half_edges = sort_half_edges(mesh.vertices.size(), mesh.faces);
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
    if (at_border[t]) border.mesh.faces.push_back(mesh.faces[t]);
  }
  border.mesh = weld(border.mesh).mesh;  // drops the vertices of other triangles
  border.inner = single_edges(border.mesh) - border.edges;
  std::sort(lengths.begin(), lengths.end());
  border.median = lengths[lengths.size() / 2];
  return border;
}

// Rounds up to two digits.
double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit * (1 + 1e-9)) * unit;
}

// Returns the number of border edges that stay open when the border is welded.
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
  // Doubles the tolerance from the smallest one. Takes the first that closes enough, or one of the
  // next kMoreTries if it leaves less open.
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
  // Rejects the tolerance if welding the whole mesh leaves too many edges open.
  if (!best || static_cast<double>(single_edges(weld(mesh, *best).mesh)) > enough) {
    return std::nullopt;
  }
  return best;
}

}  // namespace rholm
