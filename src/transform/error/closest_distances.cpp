#include "transform/error/closest_distances.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/cancel.h"
#include "rholm/primitives.h"
#include "transform/error/error_peaks.h"
#include "transform/error/proportional_sample.h"

namespace rholm {
namespace {

// Number of steps from the closest point of the model's triangles, which is off by their flatness.
// Each step reduces the error by the factor distance times curvature. Three steps leave 0.001 of
// the distance (random polyhedra to degree 64, against pattern search; scripts/constants).
constexpr int kSteps = 3;
// Edges of the model's triangles are 1.1 / 2^level, at most kEdge / L: a wave of degree L has five
// of them.
constexpr double kEdge = 1.3;
constexpr int kCoarsest = 4, kFinest = 7;
// Number of points to first order for each closest point; they cost a hundredth.
constexpr std::size_t kDense = 12;
constexpr std::uint64_t kSeed = 4;
// Number of climbs: coarse meshes have a peak at each vertex and others along their edges.
constexpr std::size_t kPeaks = 16;
// Extreme points are measured in batches of this size, up to this number in all.
constexpr std::size_t kBatch = 500, kMostExtreme = 10'000;

double squared_norm(const Vec3& v) { return dot(v, v); }

}  // namespace

std::vector<Vec3> RadialSurface::points(const std::vector<Vec3>& directions) const {
  const std::vector<double> values = model_.sums.at(directions, false, context_).values;
  std::vector<Vec3> points(directions.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double r = scale_ * (model_.is_gauge ? 1 / values[i] : values[i]);
    points[i] = r * directions[i];
  }
  return points;
}

RadialPoints RadialSurface::at(const std::vector<Vec3>& directions) const {
  const ValuesAndGradients found = model_.sums.at(directions, true, context_);
  RadialPoints result;
  result.points.resize(directions.size());
  result.normals.resize(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double value = found.values[i], r = model_.is_gauge ? 1 / value : value;
    const Vec3 slope = model_.is_gauge ? -r * r * found.gradients[i] : found.gradients[i];
    result.points[i] = scale_ * r * directions[i];
    const Vec3 normal = r * directions[i] - slope;
    result.normals[i] = squared_norm(normal) > 0 ? normalized(normal) : directions[i];
  }
  return result;
}

std::vector<double> RadialSurface::distances(const std::vector<Vec3>& x, std::vector<Vec3> from,
                                             int steps) const {
  RadialPoints here = at(from);
  std::vector<double> distances(x.size()), lengths(x.size(), 1.0);
  for (std::size_t i = 0; i < x.size(); ++i) distances[i] = norm(x[i] - here.points[i]);
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vec3 away = x[i] - here.points[i];
      const Vec3 along = away - dot(away, here.normals[i]) * here.normals[i];
      const Vec3 to = here.points[i] + lengths[i] * along;
      from[i] = squared_norm(to) > 0 ? normalized(to) : from[i];
    }
    const RadialPoints there = at(from);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double distance = norm(x[i] - there.points[i]);
      if (distance < distances[i]) {
        distances[i] = distance;
        here.points[i] = there.points[i];
        here.normals[i] = there.normals[i];
      } else {
        lengths[i] /= 2;
      }
    }
  }
  return distances;
}

namespace {

// For each piece of the mesh: its area on the model, and the distances to the model and back, to
// first order.
struct PieceModel {
  const SurfacePieces& pieces;
  std::vector<double> model_areas, to_model, to_shape;
  double area = 0, model_area = 0;
  CorrectedSum there, back;

  PieceModel(const SurfacePieces& p, const RadialPoints& opposite)
      : pieces(p), model_areas(p.size()), to_model(p.size()), to_shape(p.size()) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3& u = p.directions[i];
      const double angle = p.areas[i] * p.cosines[i] / (p.radii[i] * p.radii[i]);
      const double cosine = std::max(std::abs(dot(opposite.normals[i], u)), 1e-6);
      const double radial = norm(p.radii[i] * u - opposite.points[i]);
      model_areas[i] = angle * squared_norm(opposite.points[i]) / cosine;
      to_model[i] = radial * cosine;
      to_shape[i] = radial * p.cosines[i];
      area += p.areas[i];
      model_area += model_areas[i];
      there.first += p.areas[i] * to_model[i] * to_model[i];
      back.first += model_areas[i] * to_shape[i] * to_shape[i];
    }
  }
  // One half of the sample is for the areas, so that no place is missed. The other half is for the
  // squares to first order, because a few places may have most of the sum.
  ProportionalSample sample(std::size_t n) const {
    const double mean_there = area > 0 ? there.first / area : 0;
    const double mean_back = model_area > 0 ? back.first / model_area : 0;
    std::vector<double> weights(pieces.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double of_shape = mean_there > 0 ? to_model[i] * to_model[i] / mean_there : 0;
      const double of_model = mean_back > 0 ? to_shape[i] * to_shape[i] / mean_back : 0;
      weights[i] =
          pieces.areas[i] / area * (1 + of_shape) + model_areas[i] / model_area * (1 + of_model);
    }
    return proportional_sample(weights, n, kSeed);
  }
  void correct(const ProportionalSample& sample, const std::vector<double>& closest_there,
               const std::vector<double>& closest_back) {
    for (std::size_t k = 0; k < sample.indices.size(); ++k) {
      const std::size_t i = sample.indices[k];
      const auto change = [](double closest, double first) {
        return closest * closest - first * first;
      };
      there.add(sample.stand_for[k] * pieces.areas[i] * change(closest_there[k], to_model[i]));
      back.add(sample.stand_for[k] * model_areas[i] * change(closest_back[k], to_shape[i]));
    }
  }
  // Returns the rms over the area, the larger one of mesh to model and model to mesh.
  double rms() const {
    return std::sqrt(std::max(area > 0 ? there.value() / area : 0,
                              model_area > 0 ? back.value() / model_area : 0));
  }
};

}  // namespace

// The model as triangles, which give the start points on its surface.
struct ClosestDistances::Model {
  const RadialSurface& surface;
  const Context& context;
  Mesh mesh;
  std::unique_ptr<TriangleTree> tree;

  Model(const RadialSurface& s, const Mesh& sphere, const Context& c) : surface(s), context(c) {
    mesh.vertices = surface.points(sphere.vertices);
    mesh.faces = sphere.faces;
    tree = std::make_unique<TriangleTree>(mesh);
  }

  // Returns the distances of points x on rays; `opposite` is the model's point on the same ray.
  std::vector<double> distances(const std::vector<Vec3>& x,
                                const std::vector<Vec3>& opposite) const {
    std::vector<Vec3> from(x.size());
    visit_closest(*tree, x, {}, context, [&](std::size_t i, const ClosestPoint& found) {
      from[i] = normalized(squared_norm(found.point) > 0 ? found.point : x[i]);
    });
    std::vector<double> found = surface.distances(x, std::move(from), kSteps);
    for (std::size_t i = 0; i < x.size(); ++i) {
      found[i] = std::min(found[i], norm(x[i] - opposite[i]));
    }
    return found;
  }
};

ClosestDistances::ClosestDistances(const MeshView& mesh, const Vec3& center, std::size_t n_points)
    : n_points_(n_points), pieces_(surface_pieces(mesh, center, kDense * n_points)) {
  shape_.vertices.resize(mesh.n_vertices);
  shape_.faces.resize(mesh.n_faces);
  CancelPoll poll;
  for (std::size_t i = 0; i < mesh.n_vertices; ++i) {
    poll();
    shape_.vertices[i] = pieces_.scale * (mesh.vertex(i) - center);
  }
  for (std::size_t t = 0; t < mesh.n_faces; ++t) {
    poll();
    shape_.faces[t] = mesh.triangle(t);
  }
  tree_ = std::make_unique<TriangleTree>(shape_);
}

const Mesh& ClosestDistances::sphere(int degree) {
  int level = kCoarsest;
  while (level < kFinest && 1.1 / (1 << level) * degree > kEdge) ++level;
  if (level != level_) sphere_ = icosphere(level);
  level_ = level;
  return sphere_;
}

// Points at which distances were measured. Distances to the model are from points of the mesh;
// distances to the shape are from the opposite points of the model.
struct ClosestDistances::Seen {
  ErrorPoints points;  // lengths scaled
  std::vector<double> to_model, to_shape;
  double most() const { return std::max(largest(to_model), largest(to_shape)); }
};

namespace {

// Returns the indices of the largest values, in descending order.
std::vector<std::size_t> largest_first(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t last = std::min(order.size(), most);
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(last), order.end(),
                    [&](std::size_t a, std::size_t b) {
                      return values[a] != values[b] ? values[a] > values[b] : a < b;
                    });
  order.resize(last);
  return order;
}

}  // namespace

ClosestDistances::Seen ClosestDistances::see_pieces(const Model& model,
                                                    const RadialPoints& opposite,
                                                    const std::vector<std::size_t>& indices,
                                                    const Context& context) const {
  Seen seen;
  std::vector<Vec3> x, across;
  for (const std::size_t i : indices) {
    x.push_back(pieces_.radii[i] * pieces_.directions[i]);
    across.push_back(opposite.points[i]);
    seen.points.directions.push_back(pieces_.directions[i]);
    seen.points.radii.push_back(pieces_.radii[i]);
    seen.points.owners.push_back(pieces_.faces[i]);
  }
  seen.to_model = model.distances(x, across);
  seen.to_shape = distances_to(*tree_, across, {}, context);
  return seen;
}

// No distance is above the radial error, so points with the largest radial errors come first.
void ClosestDistances::see_extreme(const Model& model, const ErrorPoints& extreme,
                                   const Context& context, Seen& seen) const {
  const std::vector<Vec3> models = model.surface.points(extreme.directions);
  std::vector<double> radial(extreme.size());
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    radial[i] = std::abs(pieces_.scale * extreme.radii[i] - dot(models[i], extreme.directions[i]));
  }
  const std::vector<std::size_t> order = largest_first(radial, kMostExtreme);
  double most = seen.most();
  for (std::size_t first = 0; first < order.size() && radial[order[first]] > most;
       first += kBatch) {
    std::vector<Vec3> points, across;
    for (std::size_t k = first; k < std::min(order.size(), first + kBatch); ++k) {
      const std::size_t i = order[k];
      points.push_back(pieces_.scale * extreme.radii[i] * extreme.directions[i]);
      across.push_back(models[i]);
      seen.points.directions.push_back(extreme.directions[i]);
      seen.points.radii.push_back(pieces_.scale * extreme.radii[i]);
      seen.points.owners.push_back(extreme.owners[i]);
    }
    const std::vector<double> there = model.distances(points, across);
    const std::vector<double> back = distances_to(*tree_, across, {}, context);
    seen.to_model.insert(seen.to_model.end(), there.begin(), there.end());
    seen.to_shape.insert(seen.to_shape.end(), back.begin(), back.end());
    most = std::max({most, largest(there), largest(back)});
  }
}

double ClosestDistances::highest(const Model& model, const RadialSurface& surface, int degree,
                                 const Seen& seen) const {
  const Context alone{.threads = 1};  // one thread, for a hundred points at a time
  const auto there_at = [&](const ErrorPoints& at) {
    std::vector<Vec3> points(at.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = at.radii[i] * at.directions[i];
    return model.distances(points, surface.points(at.directions));
  };
  const auto back_at = [&](const ErrorPoints& at) {
    return distances_to(*tree_, surface.points(at.directions), {}, alone);
  };
  const MeshView view = view_of(shape_);
  return std::max(seen.most(),
                  largest(highest_peaks(view, {}, seen.points,
                                        {{seen.to_model, there_at}, {seen.to_shape, back_at}},
                                        degree, kPeaks, alone)));
}

SurfaceDistances ClosestDistances::measure(const Expansion& expansion, int degree,
                                           const ErrorPoints& extreme, double precision,
                                           const Context& context) {
  const Context silent{.threads = context.threads}, alone{.threads = 1};
  const RadialModel radial(expansion, degree, pieces_.size(), true, precision, silent);
  const RadialSurface surface(radial, pieces_.scale, silent);
  const Model model(surface, sphere(degree), silent);
  const RadialPoints opposite = surface.at(pieces_.directions);
  PieceModel of_pieces(pieces_, opposite);
  const ProportionalSample sample = of_pieces.sample(n_points_);
  Seen seen = see_pieces(model, opposite, sample.indices, silent);
  of_pieces.correct(sample, seen.to_model, seen.to_shape);
  SurfaceDistances result;
  result.rms = of_pieces.rms() / pieces_.scale;
  see_extreme(model, extreme, silent, seen);
  const RadialSurface near(radial, pieces_.scale, alone);
  result.max = highest(model, near, degree, seen) / pieces_.scale;
  return result;
}

}  // namespace rholm
