// The corrected field of the paper: c_lm = sum_T oint F_theta dtheta, (M1), with
//   F_theta = -Pbar_lm(cos theta) sin(theta) d_T e^{-i m phi_n} K_m.
// This differs from (P22): the line integral is over F dtheta, not F ds. It also differs from
// (P30)-(P31): the factor kappa depends on phi and stays under the integral K_m. Along an edge
// x = a + t e, sin(theta) dtheta = -d(u_z) = -(e_z - u_z (u.e)) / |x| dt, without a division by
// sin(theta). Faces that contain or nearly meet the z axis are left to cubature of r dOmega,
// because phi is not single-valued on their boundary.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/parallel.h"
#include "harmonic/legendre/order_sums.h"
#include "paper/methods/curl_integrals.h"
#include "paper/methods/paper_methods.h"
#include "transform/methods/methods.h"
#include "transform/methods/radius_cubature.h"
#include "transform/methods/sources.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

// A node of a face's boundary: data of G_m = -w sin(theta) theta' d e^{-i m phi_n} K_m.
struct CurlNode {
  Vec3 direction;
  double factor = 0;      // weight times d_T times -sin(theta) dtheta/dt
  double C = 0, rho = 0;  // coefficients in (M2)
  double psi = 0, phi_n = 0;
  double end_value = 0;  // d_T / |x|
};

// Returns the distance of a segment from the z axis.
double axis_distance(const Vec3& a, const Vec3& b) {
  return segment_distance({a.x, a.y, 0}, {b.x, b.y, 0});
}

// Returns true if the z axis cuts the face, or is nearer to it than a tenth of its longest edge.
// (Chosen: if nearer, the edge would be halved more than three times.)
bool near_axis(const std::array<Vec3, 3>& p) {
  double longest = 0, nearest = INFINITY;
  bool left = true, right = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    longest = std::max(longest, norm(b - a));
    nearest = std::min(nearest, axis_distance(a, b));
    const double side = a.x * b.y - a.y * b.x;
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right || nearest < 0.1 * longest;
}

double wrapped(double angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

void add_face_nodes(const std::array<Vec3, 3>& p, const FaceGeometry& face,
                    const Allowance& allowance, std::vector<CurlNode>& nodes) {
  // A face that turns inwards has the same radius d/(n.u) with both signs changed; the direction of
  // its boundary makes it count negative.
  const double side = face.d < 0 ? -1 : 1;
  const Vec3 n = (side / norm(face.twice_area)) * face.twice_area;
  const double d = side * face.d;
  const double slant = std::hypot(n.x, n.y);
  const double phi_n = slant > 0 ? std::atan2(n.y, n.x) : 0.0;
  // psi is continuous over a face that does not meet the axis: its middle chooses the branch.
  const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0;
  const double phi_middle = std::atan2(middle.y, middle.x);
  const double psi_middle = wrapped(phi_middle - phi_n);
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    const Vec3 e = b - a;
    visit_segment(a, b, allowance, axis_distance, [&](const Vec3& x, double weight) {
      const double r = norm(x);
      const Vec3 u = x / r;
      CurlNode node;
      node.direction = u;
      node.factor = weight * d * (e.z - u.z * dot(u, e)) / r;
      node.C = n.z * u.z;
      node.rho = slant * std::hypot(u.x, u.y);
      node.psi = psi_middle + wrapped(std::atan2(u.y, u.x) - phi_middle);
      node.phi_n = phi_n;
      node.end_value = d / r;
      nodes.push_back(node);
    });
  }
}

// Adds Pt_lm(theta_j) G_m(j) for a block of nodes.
void add_nodes(std::span<const CurlNode> nodes, Coefficients& sum, const Context& context,
               const ParallelStage& stage) {
  std::vector<Vec3> directions;
  for (const CurlNode& node : nodes) directions.push_back(node.direction);
  const DirectionBlock block(directions);
  OrderTable table;
  table.reset(sum.degree(), block);
  const std::size_t orders = sum.degree() + std::size_t{1};
  const Context silent{.threads = context.threads};
  parallel_for(nodes.size(), 64, silent, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Complex> k(orders);
    for (std::size_t j = begin; j < end; ++j) {
      const CurlNode& node = nodes[j];
      curl_integrals(node.C, node.rho, node.psi, node.end_value, k);
      const Complex turn = std::polar(1.0, -node.phi_n);
      Complex phase = 1;
      for (std::size_t m = 0; m < orders; ++m) {
        const Complex g = node.factor * phase * k[m];
        // f is real: C_lm belongs to the real part, S_lm to minus the imaginary part.
        table.re_row(static_cast<int>(m))[j] = g.real();
        table.im_row(static_cast<int>(m))[j] = -g.imag();
        phase *= turn;
      }
    }
  });
  add_order_sums(block, table, sum, context, stage);
}

// Estimates the total |d_T| |K| |sin theta dtheta| of a face's boundary: the integral of r over the
// solid angle between the boundary and psi = 0.
double boundary_weight(const std::array<Vec3, 3>& p) {
  double radius = 0, length = 0;
  for (int i = 0; i < 3; ++i) {
    radius = std::max(radius, norm(p[i]));
    length += norm(normalized(p[(i + 1) % 3]) - normalized(p[i]));
  }
  return radius * length;
}

}  // namespace

MethodResult curl_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context) {
  const std::size_t n = geometry.faces.size();
  std::vector<bool> by_area(n, false);
  double boundary = 0, area = 0;
  for (std::size_t t = 0; t < n; ++t) {
    by_area[t] = near_axis(geometry.corners(t));
    (by_area[t] ? area : boundary) +=
        by_area[t] ? radius_weight(geometry, t) : boundary_weight(geometry.corners(t));
  }
  Allowance allowance =
      undivided_allowance(options.allowed / 2, std::max(boundary, 1e-300), options.degree);
  allowance.growth = Growth::kFlat;
  // The node's function has the singular set of theta and phi, the axis. Its phases are e^{-i m
  // phi} and the phases of K_m at both ends of its integral: twice the degree.
  allowance.degree = std::max(1, 2 * options.degree);
  MethodResult result;
  result.coefficients = Coefficients(options.degree);
  std::vector<CurlNode> nodes;
  const std::size_t block = chunk_size(options.degree);
  const auto flush = [&](std::size_t done) {
    const double part = static_cast<double>(done) / static_cast<double>(n);
    add_nodes(nodes, result.coefficients, context, {"transform", part, part});
    result.edge_nodes += nodes.size();
    nodes.clear();
  };
  for (std::size_t t = 0; t < n; ++t) {
    const FaceGeometry& face = geometry.faces[t];
    if (by_area[t] || face.degenerate || face.d == 0) continue;
    add_face_nodes(geometry.corners(t), face, allowance, nodes);
    if (nodes.size() >= block) flush(t);
  }
  flush(n);
  if (area > 0) {
    const Allowance cubature = undivided_allowance(options.allowed / 2, area, options.degree);
    Sources sources({.degree = options.degree}, Context{.threads = context.threads});
    for (std::size_t t = 0; t < n; ++t) {
      if (!by_area[t]) continue;
      visit_radius(geometry, t, cubature, [&](const Vec3& x, double w) { sources.add(x, w); });
    }
    result.face_nodes = sources.count();
    const Coefficients polar = sources.finish();
    for (std::size_t i = 0; i < polar.values().size(); ++i) {
      result.coefficients.values()[i] += polar.values()[i];
    }
  }
  return result;
}

}  // namespace rholm
