#include "transform/error/error_points.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/random.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "shape/face.h"
#include "transform/error/long_faces.h"

namespace rholm {
namespace {

struct Face {
  std::array<Vec3, 3> corners;  // relative to the centre
  FaceNormal normal;
  double twice_area = 0;
};

Face face_of(const std::array<Vec3, 3>& corners) {
  Face face;
  face.corners = corners;
  face.normal = face_normal(face.corners);
  face.twice_area = norm(face.normal.twice_area);
  return face;
}

// Adds the point x, relative to the centre, unless it is 0 and has no direction.
void add_point(ErrorPoints& points, const Vec3& x, double cosine, std::int64_t owner) {
  const double r = norm(x);
  if (r > 0) points.add(x / r, r, cosine, owner);
}

// Drops the points that were not set: their radius is 0.
void drop_unset(ErrorPoints& points) {
  std::vector<std::size_t> set;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.radii[i] > 0) set.push_back(i);
  }
  points = points.subset(set);
}

// Returns cos gamma at the point x of the face, or nothing if x or the face's area is 0.
std::optional<double> cosine_at(const Face& face, const Vec3& x) {
  const double size = norm(x) * face.twice_area;
  if (!(size > 0)) return std::nullopt;
  return std::abs(dot(face.normal.twice_area, x)) / size;
}

}  // namespace

void ErrorPoints::reserve(std::size_t n) {
  directions.reserve(n);
  radii.reserve(n);
  cosines.reserve(n);
  owners.reserve(n);
}

void ErrorPoints::resize(std::size_t n) {
  directions.resize(n);
  radii.resize(n);
  cosines.resize(n);
  owners.resize(n);
}

void ErrorPoints::add(const Vec3& direction, double radius, double cosine, std::int64_t owner) {
  directions.push_back(direction);
  radii.push_back(radius);
  cosines.push_back(cosine);
  owners.push_back(owner);
}

ErrorPoints ErrorPoints::subset(const std::vector<std::size_t>& indices) const {
  ErrorPoints result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) {
    result.directions.push_back(directions[i]);
    result.radii.push_back(radii[i]);
    result.cosines.push_back(cosines[i]);
    if (!owners.empty()) result.owners.push_back(owners[i]);
  }
  return result;
}

ErrorPoints ErrorPoints::first(std::size_t n) const {
  const auto end = static_cast<std::ptrdiff_t>(n);
  return {{directions.begin(), directions.begin() + end},
          {radii.begin(), radii.begin() + end},
          {cosines.begin(), cosines.begin() + end},
          {owners.begin(), owners.begin() + std::min(end, std::ssize(owners))}};
}

void ErrorPoints::append(const ErrorPoints& more) {
  directions.insert(directions.end(), more.directions.begin(), more.directions.end());
  radii.insert(radii.end(), more.radii.begin(), more.radii.end());
  cosines.insert(cosines.end(), more.cosines.begin(), more.cosines.end());
  owners.insert(owners.end(), more.owners.begin(), more.owners.end());
}

std::optional<double> face_cosine(const MeshView& mesh, std::size_t t, const Vec3& center,
                                  const FaceScan& scan, const Vec3& x) {
  const Face face = face_of(corners_of(mesh, mesh.triangle(t), center, scan.sizes.scale));
  return face.normal.degenerate ? std::nullopt : cosine_at(face, x);
}

ErrorPoints extreme_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan,
                           int degree) {
  ErrorPoints points;
  CancelPoll poll;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    const Vec3 x = scan.sizes.scale * (mesh.vertex(i) - center);
    if (scan.is_used(i)) add_point(points, x, 0, -1 - static_cast<std::int64_t>(i));
  }
  for (std::size_t run = 0; run < scan.sizes.angles2.size(); ++run) {
    poll();
    visit_long_faces(mesh, center, scan, degree, run, run + 1,
                     [&](std::span<const Vec3> on_face, std::size_t t) {
                       for (const Vec3& x : on_face) {
                         const std::optional<double> cosine = face_cosine(mesh, t, center, scan, x);
                         if (cosine) add_point(points, x, *cosine, static_cast<std::int64_t>(t));
                       }
                     });
  }
  for (double& r : points.radii) r /= scan.sizes.scale;
  return points;
}

ErrorPoints area_points(const MeshView& mesh, const Vec3& center, const FaceScan& scan,
                        std::size_t n, const Context& context) {
  const FaceSizes& sizes = scan.sizes;
  const std::size_t n_groups = sizes.area_bits.size();
  constexpr std::size_t kGrain = 1024;  // groups of faces; chosen: some 100 us
  // Area of all groups before each chunk of groups.
  std::vector<double> before;
  double whole = 0;
  for (std::size_t group = 0; group < n_groups; ++group) {
    if (group % kGrain == 0) before.push_back(whole);
    whole += sizes.twice_area(group);
  }
  const double part = whole / static_cast<double>(n);
  constexpr std::uint64_t kSeed = 1;
  // Returns the position of point i in the areas, one behind the other.
  const auto place = [&](std::size_t i) {
    return i < n ? (static_cast<double>(i) + random_uniform(kSeed, i)) * part
                 : std::numeric_limits<double>::infinity();
  };
  // The points of one face follow each other and are spread evenly over it, by the additive
  // sequence of the plastic number (Roberts 2018).
  const auto spread = [](std::size_t i, double step) {
    const double at = 0.5 + step * static_cast<double>(i);
    return at - std::floor(at);
  };
  struct Group {
    std::size_t first, last;  // faces
    double from, to;          // areas
  };
  ErrorPoints points;
  points.resize(n);
  std::atomic<std::size_t> n_set = 0;
  parallel_for(n_groups, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    double sum = before[begin / kGrain];
    auto next = std::min(n, static_cast<std::size_t>(part > 0 ? sum / part : 0));
    while (next > 0 && place(next - 1) >= sum) --next;
    while (place(next) < sum) ++next;
    // Collects the groups with points on them, then all of their faces, then the corners. These are
    // far apart in memory, and the processor fetches them together.
    std::vector<Group> groups;
    std::vector<Triangle> triangles;
    double at = place(next);
    for (std::size_t group = begin, i = next; group < end; ++group) {
      const double from = sum;
      sum += sizes.twice_area(group);
      if (at >= sum) continue;
      while (at < sum) at = place(++i);
      const std::size_t first = group * FaceSizes::kGroup;
      groups.push_back({first, std::min(mesh.n_faces, first + FaceSizes::kGroup), from, sum});
    }
    for (const Group& group : groups) {
      for (std::size_t t = group.first; t < group.last; ++t) triangles.push_back(mesh.triangle(t));
    }
    std::vector<std::array<Vec3, 3>> corners(triangles.size());
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      corners[k] = corners_of(mesh, triangles[k], center, scan.sizes.scale);
    }
    const std::array<Vec3, 3>* of_face = corners.data();
    at = place(next);
    std::size_t here = 0;
    for (const Group& group : groups) {
      double up_to = group.from;
      for (std::size_t t = group.first; t < group.last; ++t) {
        const Face face = face_of(*of_face++);
        // The sum of the faces' areas may differ from the group's area by rounding.
        up_to = t + 1 < group.last ? std::min(group.to, up_to + face.twice_area) : group.to;
        for (; at < up_to; at = place(++next)) {
          // The point is uniform on the face.
          const double s = std::sqrt(spread(next, 0.7548776662466927));
          const double b = s * spread(next, 0.5698402909980532);
          const Vec3 x =
              (1 - s) * face.corners[0] + b * face.corners[1] + (s - b) * face.corners[2];
          const double r = norm(x);
          const std::optional<double> cosine = cosine_at(face, x);
          if (!cosine || face.normal.degenerate || !(r > 0)) continue;
          points.directions[next] = x / r;
          points.radii[next] = r / scan.sizes.scale;
          points.cosines[next] = *cosine;
          points.owners[next] = static_cast<std::int64_t>(t);
          ++here;
        }
      }
    }
    n_set += here;
  });
  if (n_set < n) drop_unset(points);
  return points;
}

namespace {

// Radii of the model along some directions, and the square of the tangent of its slope.
struct ModelSurface {
  std::vector<double> radii, tangents2;
};

ModelSurface model_surface(std::span<const Vec3> directions, const RadialModel& of, bool slopes) {
  ValuesAndGradients found = of.sums.at(directions, slopes, {.threads = 1});
  ModelSurface model;
  model.radii = std::move(found.values);
  // |grad r| / r is the same for r and 1/r.
  for (std::size_t i = 0; i < found.gradients.size(); ++i) {
    const double r2 = model.radii[i] * model.radii[i];
    model.tangents2.push_back(dot(found.gradients[i], found.gradients[i]) / std::max(r2, 1e-300));
  }
  if (!of.is_gauge) return model;
  for (double& q : model.radii) {
    if (!(q > 0)) {
      throw Error(ErrorCode::kInvalidInput,
                  "the gauge of degree " + std::to_string(of.degree) +
                      " is not positive everywhere: it has no surface; take another degree");
    }
    q = 1 / q;
  }
  return model;
}

}  // namespace

PointErrors PointErrors::subset(const std::vector<std::size_t>& indices) const {
  PointErrors result;
  const auto take = [&](const std::vector<double>& from, std::vector<double>& to) {
    to.reserve(indices.size());
    for (const std::size_t i : indices) to.push_back(from[i]);
  };
  take(radial, result.radial);
  take(to_model, result.to_model);
  take(to_shape, result.to_shape);
  take(stretch, result.stretch);
  return result;
}

void PointErrors::append(const PointErrors& more) {
  radial.insert(radial.end(), more.radial.begin(), more.radial.end());
  to_model.insert(to_model.end(), more.to_model.begin(), more.to_model.end());
  to_shape.insert(to_shape.end(), more.to_shape.begin(), more.to_shape.end());
  stretch.insert(stretch.end(), more.stretch.begin(), more.stretch.end());
}

PointErrors point_errors(const ErrorPoints& points, const Expansion& expansion, int degree,
                         bool slopes, double precision, const Context& context) {
  const RadialModel model(expansion, degree, points.size(), slopes, precision, context);
  return point_errors(points, model, slopes, context);
}

PointErrors point_errors(const ErrorPoints& points, const RadialModel& model, bool slopes,
                         const Context& context) {
  PointErrors errors;
  errors.radial.resize(points.size());
  if (slopes) {
    errors.to_model.resize(points.size());
    errors.to_shape.resize(points.size());
    errors.stretch.resize(points.size());
  }
  constexpr std::size_t kGrain = 8192;  // chosen: some 200 us
  parallel_for(points.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    const ModelSurface surface =
        model_surface(std::span(points.directions).subspan(begin, end - begin), model, slopes);
    for (std::size_t i = begin; i < end; ++i) {
      const double r = surface.radii[i - begin];
      const double radial = std::abs(points.radii[i] - r);
      errors.radial[i] = radial;
      if (!slopes) continue;
      const double cosine = 1 / std::sqrt(1 + surface.tangents2[i - begin]);
      const double face = points.cosines[i] > 0 ? points.cosines[i] : cosine;
      errors.to_model[i] = radial * cosine;
      errors.to_shape[i] = radial * face;
      const double ratio = r / points.radii[i];
      errors.stretch[i] = ratio * ratio * face / cosine;
    }
  });
  return errors;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, value);
  return most;
}

std::vector<std::size_t> indices_of_largest(const std::vector<double>& values, std::size_t n) {
  const double least = 0.5 * largest(values);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] >= least) indices.push_back(i);
  }
  const auto end = indices.begin() + static_cast<std::ptrdiff_t>(std::min(n, indices.size()));
  std::partial_sort(indices.begin(), end, indices.end(), [&](std::size_t a, std::size_t b) {
    return values[a] != values[b] ? values[a] > values[b] : a < b;
  });
  indices.erase(end, indices.end());
  return indices;
}

double rms_over_solid_angle(const ErrorPoints& points, const PointErrors& errors,
                            std::size_t first) {
  double sum = 0, weights = 0;
  for (std::size_t i = first; i < points.size(); ++i) {
    const double weight = points.cosines[i] / (points.radii[i] * points.radii[i]);
    sum += weight * errors.radial[i] * errors.radial[i];
    weights += weight;
  }
  return weights > 0 ? std::sqrt(sum / weights) : 0;
}

double rms_distance(const PointErrors& errors, std::size_t first) {
  if (first >= errors.radial.size()) return 0;
  double there = 0, back = 0, weights = 0;
  for (std::size_t i = first; i < errors.radial.size(); ++i) {
    there += errors.to_model[i] * errors.to_model[i];
    back += errors.stretch[i] * errors.to_shape[i] * errors.to_shape[i];
    weights += errors.stretch[i];
  }
  there /= static_cast<double>(errors.radial.size() - first);
  return std::sqrt(std::max(there, weights > 0 ? back / weights : 0.0));
}

}  // namespace rholm
