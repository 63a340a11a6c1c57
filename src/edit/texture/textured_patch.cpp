#include "edit/texture/textured_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "base/refuse.h"
#include "edit/patch/patch_cover.h"

namespace rholm {
namespace {

// A chart fails where the surface turns away from its centre by more than 84
// degrees (method 7.1). A small share of these points, at folds, is allowed.
constexpr double kLeastFacing = 0.1;
constexpr double kMayBeHidden = 0.02;
// The map of heights reaches this far, in radii: region and transition.
constexpr double kReach = 2;
// Below this value of 1 + cosine, axes count as opposite; the shortest turn is not unique there.
constexpr double kOpposite = 1e-9;
// Number of map samples per edge of the mesh.
constexpr double kSamplesPerEdge = 2;

std::vector<double> areas_of(const LocalMesh& local, std::span<const Vec3> positions) {
  std::vector<double> areas(positions.size(), 0);
  for (const Triangle& t : local.faces) {
    const double area =
        norm(cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]])) / 6;
    for (const std::uint32_t v : t) areas[v] += area;
  }
  return areas;
}

// Returns the chart over the base of the region.
PatchChart chart_of(const TexturedPatch& textured, const std::vector<std::uint32_t>& inside) {
  const std::vector<double> areas = areas_of(textured.local, textured.base);
  Vec3 middle, axis;
  double area = 0;
  for (const std::uint32_t v : inside) {
    middle += areas[v] * textured.base[v];
    axis += areas[v] * textured.normals[v];
    area += areas[v];
  }
  if (!(area > 0) || !(norm(axis) > 0)) refuse("the region has no side from which it can be seen");
  middle = middle / area;
  axis = normalized(axis);
  PatchChart chart;
  chart.unit = std::sqrt(area / std::numbers::pi);
  // The seed lies where the axis meets the surface: at the mean height of nearby points.
  double height = 0, near = 0;
  for (const std::uint32_t v : inside) {
    const Vec3 offset = textured.base[v] - middle;
    const double up = dot(offset, axis);
    const double d2 = (dot(offset, offset) - up * up) / (0.04 * chart.unit * chart.unit);
    const double w = areas[v] * std::exp(-d2);
    height += w * up;
    near += w;
  }
  const Vec3 seed = middle + (near > 0 ? height / near : 0) * axis;
  chart.frame =
      patch_frame({textured.base, textured.normals, areas, inside}, seed, axis, chart.unit);
  return chart;
}

void check_seen(const TexturedPatch& textured, const std::vector<std::uint32_t>& inside) {
  std::size_t hidden = 0;
  for (const std::uint32_t v : inside) {
    const Vec3 u = normalized(textured.base[v] - textured.chart.frame.center);
    if (!(dot(u, textured.normals[v]) > kLeastFacing)) ++hidden;
  }
  if (static_cast<double>(hidden) > kMayBeHidden * static_cast<double>(inside.size())) {
    refuse(
        fmt::format("{} of the region's {} vertices are hidden from its middle; take a smaller "
                    "region, one that a single view can show",
                    hidden, inside.size()));
  }
}

// Computes slopes at the corners as means over the adjacent triangles.
void find_slopes(const TexturedPatch& textured, std::vector<DetailCorner>& corners) {
  std::vector<double> areas(corners.size(), 0);
  for (const Triangle& t : textured.local.faces) {
    const DetailCorner &a = corners[t[0]], &b = corners[t[1]], &c = corners[t[2]];
    const double ux = b.at.p - a.at.p, uy = b.at.q - a.at.q, uh = b.height - a.height;
    const double vx = c.at.p - a.at.p, vy = c.at.q - a.at.q, vh = c.height - a.height;
    const double area = ux * vy - uy * vx;
    if (!(area > 0) || !textured.whole(t)) continue;
    for (const std::uint32_t v : t) {
      corners[v].slope.p += uh * vy - vh * uy;  // slope times the area
      corners[v].slope.q += vh * ux - uh * vx;
      areas[v] += area;
    }
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!(areas[i] > 0)) continue;
    corners[i].slope = {corners[i].slope.p / areas[i], corners[i].slope.q / areas[i]};
  }
}

}  // namespace

Place2 PatchChart::operator()(const Vec3& x) const {
  const Vec3 offset = x - frame.center;
  const double a = dot(offset, frame.x), b = dot(offset, frame.y), c = dot(offset, frame.z);
  const double across = std::hypot(a, b);
  if (!(across > 0)) return {};
  const double length = std::atan2(across, c) * frame.radius / unit;
  return {length * a / across, length * b / across};
}

double region_radius(const Mesh& mesh, std::span<const Region> regions) {
  const std::vector<double> weights = region_weights(mesh, regions, 0);
  double area = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3& a = mesh.vertices[t[0]];
    const double whole = norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
    area += whole * (weights[t[0]] + weights[t[1]] + weights[t[2]]) / 3;
  }
  if (!(area > 0) || !std::isfinite(area)) refuse("the region has no area");
  return std::sqrt(area / std::numbers::pi);
}

TexturedPatch texture_of(const Mesh& mesh, std::span<const Region> regions, double wavelength,
                         double transition, const Context& context) {
  TexturedPatch textured;
  textured.wavelength = wavelength;
  textured.patch = analyze_patch(
      mesh, regions,
      {.wavelength = wavelength, .transition = transition, .fitting = PatchFitting::kMean},
      context);
  const Patch& patch = textured.patch;
  textured.local = cut_out(mesh, bounds(patch.positions));
  const LocalMesh& local = textured.local;
  std::vector<std::uint32_t> row_of(mesh.vertices.size(), kNoRow);
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    row_of[patch.vertices[i]] = static_cast<std::uint32_t>(i);
  }
  textured.row.assign(local.points.size(), kNoRow);
  textured.base = local.points;
  const auto degree = static_cast<std::size_t>(patch.degree);
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < local.points.size(); ++i) {
    const std::uint32_t row = row_of[local.members_of(i).front()];
    textured.row[i] = row;
    if (row == kNoRow) continue;
    textured.base[i] = patch.positions[row] + patch.moves[row * (degree + 1) + degree];
    if (patch.weights[row] >= 1) inside.push_back(i);
  }
  textured.normals = point_normals(local, textured.base);
  textured.chart = chart_of(textured, inside);
  check_seen(textured, inside);
  return textured;
}

void count_azimuths_like(const PatchChart& like, PatchChart& chart) {
  const Vec3 a = like.frame.z, b = chart.frame.z, x = like.frame.x;
  const double cosine = dot(a, b);
  const Vec3 axis = cross(a, b);
  // For opposite axes, takes half a turn about x.
  chart.frame.x = x;
  if (1 + cosine > kOpposite) {
    chart.frame.x += cross(axis, x) + cross(axis, cross(axis, x)) / (1 + cosine);
  }
  chart.frame.x = normalized(chart.frame.x - dot(chart.frame.x, b) * b);
  chart.frame.y = cross(b, chart.frame.x);
}

DetailMap detail_of(const TexturedPatch& textured) {
  const LocalMesh& local = textured.local;
  std::vector<DetailCorner> corners(local.points.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t row = textured.row[i];
    if (row == kNoRow) continue;
    const double height = dot(local.points[i] - textured.base[i], textured.normals[i]);
    corners[i] = {textured.chart(local.points[i] - height * textured.normals[i]), height,
                  textured.patch.weights[row]};
  }
  find_slopes(textured, corners);
  double edges = 0, count = 0, reach = 0;
  for (const Triangle& t : local.faces) {
    if (textured.row[t[0]] == kNoRow || textured.row[t[1]] == kNoRow) continue;
    const Place2 &a = corners[t[0]].at, &b = corners[t[1]].at;
    edges += std::hypot(a.p - b.p, a.q - b.q);
    reach = std::max(reach, std::hypot(a.p, a.q));
    ++count;
  }
  const double step = count > 0 && edges > 0 ? edges / count / kSamplesPerEdge : 0.1;
  DetailMap map = empty_map(std::clamp(reach, 0.1, kReach), step);
  for (const Triangle& t : local.faces) {
    if (textured.whole(t)) draw({corners[t[0]], corners[t[1]], corners[t[2]]}, map);
  }
  return map;
}

}  // namespace rholm
