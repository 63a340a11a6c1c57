#include "transform/mesh_pass/own_nodes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/error.h"
#include "shape/face.h"
#include "transform/geometry/star_geometry.h"
#include "transform/rules/bernstein_rules.h"
#include "transform/rules/triangle_pieces.h"

namespace rholm {
namespace {

// Elements longer than half their distance are halved. In longer elements x/|x| bends so much that
// rules for plane waves are not reliable.
constexpr double kLongest = 0.5;
constexpr int kMaxDepth = 100;  // doubles resolve nothing after these halvings

[[noreturn]] void throw_on_surface() {
  throw Error(ErrorCode::kInvalidInput,
              "the surface passes through the centre of the expansion: choose a centre inside it");
}

Extent extent(const Vec3& a, const Vec3& b, double distance, int degree) {
  const Vec3 across = cross(a, b), e = b - a;
  const double over = 1 / (distance * distance);
  const double l = degree * over;
  return {.wave2 = l * l * dot(across, across), .bend2 = over * dot(e, e)};
}

Extent extent(const std::array<Vec3, 3>& p, double distance, int degree) {
  Extent most;
  for (int i = 0; i < 3; ++i) {
    const Extent z = extent(p[i], p[(i + 1) % 3], distance, degree);
    most.wave2 = std::max(most.wave2, z.wave2);
    most.bend2 = std::max(most.bend2, z.bend2);
  }
  return most;
}

// Returns the squares of the edges' lengths; edge i begins at corner i.
std::array<double, 3> edge_squares(const std::array<Vec3, 3>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[1], c = p[0] - p[2];
  return {dot(a, a), dot(b, b), dot(c, c)};
}

// Returns a lower bound on the distance from the centre, close where edges are short.
double distance_of(const Vec3& a, const Vec3& b) {
  const double nearest = std::sqrt(std::min(dot(a, a), dot(b, b)));
  const Vec3 e = b - a;
  const double half = 0.5 * std::sqrt(dot(e, e));
  return half < 0.1 * nearest ? nearest - half : segment_distance(a, b);
}

double distance_of(const std::array<Vec3, 3>& p) {
  const double nearest = std::sqrt(std::min({dot(p[0], p[0]), dot(p[1], p[1]), dot(p[2], p[2])}));
  // No point is farther from its nearest corner than 1/sqrt(3) of the longest edge.
  const double reach = 0.58 * std::sqrt(std::ranges::max(edge_squares(p)));
  return reach < 0.1 * nearest ? nearest - reach : triangle_distance(p);
}

// Returns the crowd of the face, at this distance, and of its edges; `d2` is the normal of length
// twice the area, times a corner.
Crowd crowd_of(const std::array<Vec3, 3>& p, double d2, double distance, int degree) {
  const std::array<double, 3> r = {norm(p[0]), norm(p[1]), norm(p[2])}, e2 = edge_squares(p);
  double chord2 = 0;  // of directions; of an edge: (e^2 - (r_i - r_j)^2) / (r_i r_j)
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    chord2 = std::max(chord2, (e2[i] - (r[i] - r[j]) * (r[i] - r[j])) / (r[i] * r[j]));
  }
  const double length = degree * std::sqrt(chord2);
  // A face's height is twice its solid angle over its length.
  const bool is_far = std::max({r[0], r[1], r[2]}) > 2 * distance;
  const double twice_area =
      static_cast<double>(degree) * degree *
      (is_far ? 2 * std::abs(solid_angle(p)) : std::abs(d2) / (distance * distance * distance));
  return {.per_wave = twice_area > 0 ? static_cast<float>(length / twice_area) : 0.0F,
          .needle = length > 2 * std::numbers::pi};
}

bool is_long(double length2, double distance) {
  return !(length2 <= kLongest * kLongest * distance * distance);
}

// Returns the allowance of a piece, which is `share` of an element: errors of pieces add up in
// squares.
NodeAllowance part_of(NodeAllowance allowance, double share) {
  if (share < 1) allowance.allowed *= std::sqrt(share);
  return allowance;
}

// Visits nodes of r dOmega = d_T dS / |x|^2; `factor` is d_T times the area. A piece may have its
// part of `allowance`, or the part `relative` of its own integral. All integrals have one sign.
// Near a plane through the centre, no share of the whole is so small that it keeps the error there.
// Returns the sum of the squares of the errors.
template <typename Visit>
double visit_radius(const std::array<Vec3, 3>& p, double factor, const NodeAllowance& allowance,
                    const Crowd& crowd, double relative, int depth, const Visit& visit) {
  const double distance = distance_of(p);
  if (depth == 0 && distance == 0) throw_on_surface();
  if (factor == 0) return 0;
  FaceRule rule;
  if (!is_long(std::ranges::max(edge_squares(p)), distance)) {
    // 1/|x|^2 counts as two degrees more.
    Extent z = extent(p, distance, allowance.degree);
    z.wave2 = std::pow(std::sqrt(z.wave2) + 2 * std::sqrt(z.bend2), 2);
    z.crowd = crowd;
    const double weight = factor / (distance * distance);
    NodeAllowance piece = allowance;
    // A piece that is not long reaches to 3/2 of its distance.
    piece.allowed = std::max(piece.allowed, relative * std::abs(weight) / 2.25);
    rule = face_rule(piece, z, weight);
  }
  if (rule.nodes.empty()) {
    if (depth == kMaxDepth) throw_on_surface();
    double error2 = 0;
    cut_triangle(p, kLongest, [&](const std::array<Vec3, 3>& piece, double share) {
      error2 += visit_radius(piece, factor * share, part_of(allowance, share), crowd, relative,
                             depth + 1, visit);
    });
    return error2;
  }
  for (const FaceNode& node : rule.nodes) {
    const Vec3 x = node.at[0] * p[0] + node.at[1] * p[1] + node.at[2] * p[2];
    visit(x, node.weight * factor / dot(x, x));
  }
  return rule.error * rule.error;
}

}  // namespace

NodeWriter::NodeWriter(const NodeOptions& options, const ScaledVertices& vertices, NodeSink& sink)
    : options_(options),
      undivided_{
          .degree = options.divided.degree, .allowed = options.divided.allowed, .divided = false},
      vertices_(vertices),
      grazing_(grazing_slope(options.divided.degree)),
      sink_(sink),
      nodes_(sink) {}

void NodeWriter::add_triangle(const std::array<Vec3, 3>& corners,
                              const std::array<std::uint32_t, 3>& vertices,
                              const std::array<bool, 3>& edges, bool face) {
  const std::array<Vec3, 3>& p = corners;
  const FaceNormal normal = face_normal(p);
  if (normal.degenerate) return;
  const Vec3& n = normal.twice_area;
  // The corner nearest to the centre loses least to rounding.
  const Vec3& nearest = *std::min_element(
      p.begin(), p.end(), [](const Vec3& a, const Vec3& b) { return dot(a, a) < dot(b, b); });
  const double d2 = dot(n, nearest);
  const double slope = std::abs(d2) / (norm(n) * norm(nearest));
  // Bounded terms need all edges of a face. They are for grazing faces, and for weights whose
  // rounding is more than a face may have.
  const bool whole = face && edges[0] && edges[1] && edges[2];
  const bool cancels = kWeightRounding * dot(n, n) > options_.rounding * std::abs(d2);
  const bool grazing = slope < grazing_ || (whole && cancels);
  const double distance = distance_of(p);
  const Crowd crowd = crowd_of(p, d2, distance, options_.divided.degree);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (!edges[i]) continue;
    const double weight = grazing ? 0 : dot(n, cross(p[i], p[j])) / d2;
    add_edge(vertices[i], vertices[j],
             {.weight = weight, .gradient = grazing ? 1.0F : 0.0F, .crowd = crowd});
  }
  if (!face) return;
  if (grazing) {
    error2_ += visit_radius(p, d2 / 2, undivided_, crowd, 0, 0,
                            [&](const Vec3& x, double weight) { sink_.add_undivided(x, weight); });
  } else {
    write_face(p, -dot(n, n) / d2, crowd, distance, 1, 0);
  }
}

void NodeWriter::add_edge(std::uint32_t i, std::uint32_t j, HalfEdge edge) {
  // The half-edge is seen from its lower vertex: a weight has no direction, a gradient changes
  // sign.
  if (j < i) edge.gradient = -edge.gradient;
  const auto join = [](HalfEdge& twin, const HalfEdge& other) {
    twin.weight += other.weight;
    twin.gradient += other.gradient;
    if (other.crowd.per_wave > twin.crowd.per_wave) twin.crowd = other.crowd;
    return true;
  };
  waiting_.add(i, j, edge, join, [&](std::uint32_t low, std::uint32_t high, const HalfEdge& whole) {
    write_edge(low, high, whole);
  });
}

void NodeWriter::flush() {
  waiting_.flush([&](std::uint32_t low, std::uint32_t high, const HalfEdge& edge) {
    write_edge(low, high, edge);
  });
  nodes_.flush();
}

void NodeWriter::write_edge(std::uint32_t low, std::uint32_t high, const HalfEdge& edge) {
  if (edge.weight == 0 && edge.gradient == 0) return;
  const Vec3 a = vertices_[low], b = vertices_[high];
  const Vec3 across = edge.gradient == 0 ? Vec3{} : -double{edge.gradient} * cross(a, b);
  write_piece(edge, across, a, b, 1);
}

void NodeWriter::write_piece(const HalfEdge& edge, const Vec3& across, const Vec3& a, const Vec3& b,
                             double share) {
  const double distance = distance_of(a, b);
  const Vec3 e = b - a;
  EdgeRule rule;
  if (!is_long(dot(e, e), distance)) {
    // A gradient is up to L / |x| times the harmonic, and bends more (6 times; adversarial_test
    // checks it).
    const double slope = 2 * norm(across) * options_.divided.degree / distance;
    Extent z = extent(a, b, distance, options_.divided.degree);
    z.crowd = edge.crowd;
    rule = edge_rule(part_of(options_.divided, share), z, share * (std::abs(edge.weight) + slope),
                     likely_edge_rule_);
  }
  if (rule.nodes.empty()) {
    if (!(share > std::exp2(-kMaxDepth))) throw_on_surface();
    const Vec3 middle = 0.5 * (a + b);
    write_piece(edge, across, a, middle, share / 2);
    write_piece(edge, across, middle, b, share / 2);
    return;
  }
  error2_ += rule.error * rule.error;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    const Vec3 x = a + rule.nodes[k] * e;
    const double weight = share * rule.weights[k];
    if (edge.weight != 0) nodes_.add(x, weight * edge.weight);
    if (edge.gradient != 0) sink_.add_gradient({x, weight * across});
  }
}

void NodeWriter::write_face(const std::array<Vec3, 3>& p, double weight, const Crowd& crowd,
                            double distance, double share, int depth) {
  FaceRule rule;
  if (!is_long(std::ranges::max(edge_squares(p)), distance)) {
    Extent z = extent(p, distance, options_.divided.degree);
    z.crowd = crowd;
    rule = face_rule(part_of(options_.divided, share), z, weight, likely_face_rule_);
  }
  if (rule.nodes.empty()) {
    if (depth == kMaxDepth) throw_on_surface();
    cut_triangle(p, kLongest, [&](const std::array<Vec3, 3>& piece, double part) {
      write_face(piece, weight * part, crowd, distance_of(piece), share * part, depth + 1);
    });
    return;
  }
  error2_ += rule.error * rule.error;
  for (const FaceNode& node : rule.nodes) {
    nodes_.add(node.at[0] * p[0] + node.at[1] * p[1] + node.at[2] * p[2], node.weight * weight);
  }
}

double radius_integral(const std::array<Vec3, 3>& corners, double allowed) {
  const FaceNormal normal = face_normal(corners);
  if (normal.degenerate) return 0;
  const double factor = dot(normal.twice_area, corners[0]) / 2;
  const double distance = triangle_distance(corners);
  // The modulus of int r dOmega is at least the solid angle times the smallest radius.
  const double least = std::abs(solid_angle(corners)) * distance;
  const NodeAllowance allowance{.degree = 0, .allowed = allowed * least, .divided = false};
  double sum = 0;
  visit_radius(corners, factor, allowance, {}, allowed, 0,
               [&](const Vec3&, double weight) { sum += weight; });
  return sum;
}

}  // namespace rholm
