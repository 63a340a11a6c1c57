#include "rholm/patch_atlas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "atlas/cap/cap_support.h"
#include "base/check_fields.h"
#include "base/parallel.h"
#include "model/atlas/atlas_errors.h"
#include "paper/patches/cap_integral.h"
#include "paper/patches/kd_partition.h"
#include "paper/patches/sphere_delaunay.h"
#include "reconstruct/file/atlas_pack.h"
#include "reconstruct/points/oriented_points.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/points/point_tree.h"

namespace rholm {
namespace {

// Precision of the integrals: far below the jump at the border of a patch.
constexpr double kPrecision = 1e-8;
// Least cosine at which a centre sees points of its widened cell; other points are left out.
constexpr double kLeastCosine = 0.1;
// Ratio of the edge of the grid's cubes to the distance between points.
constexpr double kStepSpacings = 1;

// Points with moduli of about 1 in local units, and normals of length 1.
struct Points {
  std::vector<Vec3> points, normals;
  UnitFrame frame;
};

Points local_points(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  OrientedPoints oriented = oriented_points(points, normals);
  Points local{std::move(oriented.points), std::move(oriented.normals), unit_frame(bounds(points))};
  for (Vec3& p : local.points) p = local.frame.to_local(p);
  if (local.points.size() < 16) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("{} points with normals make no patches: at least 16", local.points.size()));
  }
  return local;
}

// The points of a patch, followed by neighbouring points.
struct Cell {
  std::vector<Vec3> points;
  std::size_t own = 0;
};

Cell cell_of(const Points& all, const KdPartition& partition, const KdPatch& patch,
             const PointTree& tree, double overlap) {
  Cell cell;
  std::vector<char> is_own(all.points.size(), 0);
  Vec3 middle;
  for (std::uint32_t k = patch.begin; k < patch.end; ++k) {
    const std::uint32_t i = partition.order[k];
    cell.points.push_back(all.points[i]);
    middle += all.points[i];
    is_own[i] = 1;
  }
  cell.own = cell.points.size();
  middle = middle / static_cast<double>(cell.own);
  double radius = 0;
  for (const Vec3& p : cell.points) radius = std::max(radius, norm(p - middle));
  std::vector<Neighbor> found;
  tree.within(middle, overlap * radius, found);
  for (const Neighbor& neighbor : found) {
    const std::uint32_t i = tree.order()[neighbor.index];
    const Vec3 ray = all.points[i] - patch.seen.sphere.center;
    if (is_own[i] || dot(all.normals[i], ray) < kLeastCosine * norm(ray)) continue;
    cell.points.push_back(all.points[i]);
  }
  return cell;
}

// One cap, and its contributions to the whole atlas.
struct MadeCap {
  Cap cap;
  std::vector<double> coefficients;
  double own_area = 0;
  double squares = 0;  // sum of squared errors along rays
  std::size_t points = 0;
};

// Returns triangles between points, seen as directions from the centre of the patch's sphere.
std::vector<Triangle> triangles_between(const KdPatch& patch, const std::vector<Vec3>& points) {
  std::vector<Vec3> directions;
  directions.reserve(points.size());
  for (const Vec3& p : points) directions.push_back(p - patch.seen.sphere.center);
  return sphere_delaunay(directions);
}

// Returns the coefficients of r / R_0 - 1 in the order of atlas.h.
std::vector<double> flattened(const Coefficients& series, double radius) {
  std::vector<double> values;
  for (int l = 0; l <= series.degree(); ++l) {
    values.push_back(series.c(l, 0) / radius);
    for (int m = 1; m <= l; ++m) {
      values.push_back(series.c(l, m) / radius);
      values.push_back(series.s(l, m) / radius);
    }
  }
  values[0] -= std::sqrt(4 * std::numbers::pi);
  return values;
}

double area_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  double twice = 0;
  for (const Triangle& t : triangles) {
    twice += norm(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  }
  return twice / 2;
}

MadeCap make_cap(const Cell& cell, const KdPatch& patch, const PatchAtlasOptions& options,
                 const Context& context) {
  MadeCap made;
  const std::vector<Triangle> triangles = triangles_between(patch, cell.points);
  if (triangles.empty()) return made;
  made.cap.frame = patch_frame(patch.seen, cell.points);
  const CapIntegral integral = cap_integral(
      made.cap.frame, {cell.points, triangles},
      {.degree = options.degree, .extension = options.extension, .precision = kPrecision}, context);
  const CapErrors errors = cap_errors(made.cap.frame, integral.coefficients, cell.points, context);
  made.squares = errors.sum * errors.sum;
  made.points = cell.points.size();
  set_support(made.cap, made.cap.frame.support);
  made.cap.degree = static_cast<std::uint16_t>(options.degree);
  made.cap.error = errors.rms;
  made.cap.area = area_of(cell.points, triangles);
  made.own_area = made.cap.area * static_cast<double>(cell.own) / static_cast<double>(made.points);
  made.coefficients = flattened(integral.coefficients, made.cap.frame.radius);
  made.cap.deviation = deviation_of(made.cap, made.coefficients);
  return made;
}

// Moves a cap back to the shape's position and size.
void move_back(const UnitFrame& frame, Cap& cap) {
  cap.frame.center = frame.to_shape(cap.frame.center);
  cap.where.xx *= frame.scale * frame.scale;
  cap.where.yy *= frame.scale * frame.scale;
  cap.area /= frame.scale * frame.scale;
  for (double* length : {&cap.frame.radius, &cap.frame.support, &cap.error, &cap.deviation}) {
    *length /= frame.scale;
  }
}

PatchAtlas make_atlas(const Points& points, const PatchAtlasOptions& options,
                      const Context& context) {
  const KdPartition partition =
      kd_partition(points.points, points.normals, {.min_cosine = options.min_cosine}, context);
  const PointTree tree(points.points, context);
  std::vector<MadeCap> made(partition.patches.size());
  const Context alone{.threads = 1, .progress = {}};
  parallel_for(made.size(), 1, context, {"patches"}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const KdPatch& patch = partition.patches[k];
      made[k] =
          make_cap(cell_of(points, partition, patch, tree, options.overlap), patch, options, alone);
    }
  });
  PatchAtlas result;
  Atlas& atlas = result.model.atlas;
  double squares = 0, area = 0;
  std::size_t n = 0;
  for (MadeCap& cap : made) {
    if (cap.points == 0) continue;
    cap.cap.first = atlas.coefficients.size();
    move_back(points.frame, cap.cap);
    atlas.caps.push_back(cap.cap);
    atlas.coefficients.insert(atlas.coefficients.end(), cap.coefficients.begin(),
                              cap.coefficients.end());
    squares += cap.squares, area += cap.own_area, n += cap.points;
  }
  if (atlas.caps.empty()) {
    throw Error(ErrorCode::kInvalidInput, "no patch of these points has a triangle");
  }
  result.rms_along_rays = std::sqrt(squares / static_cast<double>(n)) / points.frame.scale;
  atlas.blend = CapBlend::kSpline;
  atlas.spacing = std::sqrt(area / static_cast<double>(points.points.size())) / points.frame.scale;
  return result;
}

PatchAtlas make_all(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                    const PatchAtlasOptions& options, const Context& context) {
  PatchAtlas made = make_atlas(local_points(points, normals), options, context);
  AtlasModel& model = made.model;
  model.atlas.diagonal = bounds(points).diagonal();
  model.step = kStepSpacings * model.atlas.spacing;
  model.input_numbers = 3 * points.size();
  model.method = fmt::format("integral, {} beyond", to_string(options.extension));
  model.atlas = unpack(pack(model.atlas), "");  // the atlas as it is read back from the file
  try {
    made.surface = synthesize(model, {}, context);
  } catch (const Error& error) {
    // The user has not chosen that step.
    if (error.code() != ErrorCode::kOutOfMemory) throw;
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the shape is too thin for an atlas of patches: its points are {:.2g} "
                            "of the diagonal apart, as the square root of the area goes, and "
                            "a grid with such steps needs more memory than allowed",
                            model.atlas.spacing / model.atlas.diagonal));
  }
  if (made.surface.faces.empty()) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("caps of degree {} leave no surface: take another degree", options.degree));
  }
  return made;
}

// Scale of each triangle in a view of separate triangles.
constexpr double kApart = 0.85;

// Collects the parts of a picture, and the patch of each vertex.
class PictureMaker {
 public:
  explicit PictureMaker(PatchView view) : view_(view) {}

  void add(const KdPatch& patch, const std::vector<Vec3>& points, const UnitFrame& frame) {
    const std::vector<Triangle> triangles = triangles_between(patch, points);
    if (triangles.empty()) return;
    Cap cap;
    cap.frame = patch_frame(patch.seen, points);
    const auto place = [&](const Vec3& p) {
      const Sphere& sphere = patch.seen.sphere;
      const Vec3 ray = p - sphere.center;
      return frame.to_shape(
          view_ == PatchView::kSpheres ? sphere.center + (sphere.radius / norm(ray)) * ray : p);
    };
    const std::size_t before = mesh_.vertices.size();
    if (view_ == PatchView::kTriangles) {
      for (const Triangle& t : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        const Vec3 middle = (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
        for (const std::uint32_t i : t) {
          mesh_.vertices.push_back(place(middle + kApart * (points[i] - middle)));
        }
        mesh_.faces.push_back({first, first + 1, first + 2});
      }
    } else {
      const auto first = static_cast<std::uint32_t>(before);
      for (const Vec3& p : points) mesh_.vertices.push_back(place(p));
      for (const Triangle& t : triangles) {
        mesh_.faces.push_back({first + t[0], first + t[1], first + t[2]});
      }
    }
    patch_of_.insert(patch_of_.end(), mesh_.vertices.size() - before,
                     static_cast<std::uint32_t>(atlas_.caps.size()));
    atlas_.caps.push_back(cap);
  }

  PatchPicture finish() {
    if (atlas_.caps.empty()) {
      throw Error(ErrorCode::kInvalidInput, "no patch of these points has a triangle");
    }
    set_cap_colors(mesh_.attributes, atlas_, patch_of_);
    return {std::move(mesh_), atlas_.caps.size()};
  }

 private:
  PatchView view_;
  Mesh mesh_;
  std::vector<std::uint32_t> patch_of_;
  Atlas atlas_;  // frames only, in local units, from which neighbours get different colours
};

PatchPicture picture_of(const std::vector<Vec3>& points, const std::vector<Vec3>& normals,
                        PatchView view, const PatchAtlasOptions& options, const Context& context) {
  const Points local = local_points(points, normals);
  const KdPartition partition =
      kd_partition(local.points, local.normals, {.min_cosine = options.min_cosine}, context);
  PictureMaker maker(view);
  std::vector<Vec3> own;
  for (const KdPatch& patch : partition.patches) {
    own.clear();
    for (std::uint32_t k = patch.begin; k < patch.end; ++k) {
      own.push_back(local.points[partition.order[k]]);
    }
    maker.add(patch, own, local.frame);
  }
  return maker.finish();
}

}  // namespace

EnumNames names_of(PatchView) {
  static constexpr std::array kNames = {"patches", "triangles", "spheres"};
  return {"view of patches", kNames};
}

PatchPicture patch_picture(const Mesh& mesh, PatchView view, const PatchAtlasOptions& options,
                           const Context& context) {
  check_fields(options);
  validate(mesh);
  check_span(bounds(mesh.vertices).diagonal());
  const Mesh welded = outward(mesh).welded.mesh;
  return picture_of(welded.vertices, area_normals(welded.vertices, welded.faces), view, options,
                    context);
}

PatchPicture patch_picture(const PointCloud& cloud, PatchView view,
                           const PatchAtlasOptions& options, const Context& context) {
  check_fields(options);
  check_oriented(cloud);
  check_span(bounds(cloud.points).diagonal());
  return picture_of(cloud.points, cloud.normals, view, options, context);
}

PatchAtlas patch_atlas(const Mesh& mesh, const PatchAtlasOptions& options, const Context& context) {
  check_fields(options);
  validate(mesh);
  check_span(bounds(mesh.vertices).diagonal());
  const Mesh welded = outward(mesh).welded.mesh;
  PatchAtlas made =
      make_all(welded.vertices, area_normals(welded.vertices, welded.faces), options, context);
  made.model.errors = measure(welded, made.surface, 100000, context);
  return made;
}

PatchAtlas patch_atlas(const PointCloud& cloud, const PatchAtlasOptions& options,
                       const Context& context) {
  check_fields(options);
  check_oriented(cloud);
  check_span(bounds(cloud.points).diagonal());
  PatchAtlas made = make_all(cloud.points, cloud.normals, options, context);
  made.model.errors = measure(cloud.points, made.surface, context);
  return made;
}

}  // namespace rholm
