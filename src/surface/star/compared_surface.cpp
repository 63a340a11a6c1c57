#include "surface/star/compared_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "shape/queries/triangle_tree.h"

namespace rholm {
namespace {

// Bytes per triangle of a portion: 12 for its corners, 79 for the tree, and
// 24 per vertex. Triangles that are not joined have three vertices each.
constexpr std::size_t kBytesPerTriangle = 12 + 79 + 3 * 24;
constexpr std::size_t kFewestTriangles = std::size_t{1} << 14;  // chosen: 3 MB

// Returns unit normals, zero for degenerate triangles. Caches the last
// normal, because consecutive samples usually lie on one triangle.
class LastNormal {
 public:
  explicit LastNormal(const Mesh& mesh) : mesh_(mesh) {}
  const Vec3& of(std::uint32_t triangle) {
    if (triangle != triangle_) {
      const FaceNormal face = face_normal(scaled_corners(mesh_, mesh_.faces[triangle], 1));
      normal_ = face.degenerate ? Vec3{} : normalized(face.twice_area);
    }
    triangle_ = triangle;
    return normal_;
  }

 private:
  const Mesh& mesh_;
  std::uint64_t triangle_ = std::numeric_limits<std::uint64_t>::max();  // none
  Vec3 normal_;
};

// Returns the angle in degrees as DistancesOut defines it.
double angle_between(const Vec3& here, const Vec3& there) {
  if (there == Vec3{}) return -1;
  return std::atan2(norm(cross(here, there)), dot(here, there)) * (180 / std::numbers::pi);
}

// Closest points over all parts searched so far.
class PartSearch {
 public:
  PartSearch(const SurfaceSamples& samples, const UnitFrame& frame, const DistancesOut& out,
             const Context& context)
      : samples_(samples),
        frame_(frame),
        out_(out),
        context_(context),
        closest_(samples.points.size()) {}

  // Returns true if a part in `box` may be nearest to some samples; ask() searches for these.
  bool concerns(const Bounds& box) {
    concerned_.clear();
    for (std::uint32_t k = 0; k < closest_.size(); ++k) {
      if (may_be_closer(box, frame_, samples_.points[k], closest_[k])) concerned_.push_back(k);
    }
    return !concerned_.empty();
  }
  void ask(const TriangleTree& tree, const MeshPortion& part) {
    parallel_for(
        concerned_.size(), kQueriesOfChunk, context_, {}, [&](std::size_t begin, std::size_t end) {
          LastNormal normal(part.mesh);
          for (std::size_t i = begin; i < end; ++i) {
            improve(tree, part.numbers, normal, concerned_[i], concerned_[i > begin ? i - 1 : i]);
          }
        });
  }
  void ask_of_all(const MeshPortion& part) {
    concerned_.resize(closest_.size());
    std::iota(concerned_.begin(), concerned_.end(), 0U);
    ask(TriangleTree(part.mesh, frame_, part.numbers), part);
  }

 private:
  void improve(const TriangleTree& tree, const PortionNumbers& numbers, LastNormal& normal,
               std::uint32_t k, std::uint32_t before) {
    ClosestSoFar& closest = closest_[k];
    const Vec3& point = samples_.points[k];
    // The bound is the previous sample's distance plus the distance between both samples.
    const double at_most = closest_[before].distance + norm(point - samples_.points[before]);
    if (!tree.improve(point, at_most, closest)) return;
    const std::uint64_t triangle = (closest.triangle - numbers.first) / numbers.step;
    out_.distances[k] = closest.distance;
    out_.angles[k] =
        angle_between(samples_.normals[k], normal.of(static_cast<std::uint32_t>(triangle)));
  }

  const SurfaceSamples& samples_;
  const UnitFrame& frame_;
  const DistancesOut& out_;
  const Context& context_;
  std::vector<ClosestSoFar> closest_;
  std::vector<std::uint32_t> concerned_;
};

}  // namespace

std::size_t triangles_of_portion(std::size_t n_vertices, std::size_t memory) {
  const std::size_t numbers = n_vertices / 16 * 3;  // bytes of a RankedSet
  const std::size_t rest = memory > numbers ? memory - numbers : 0;
  return std::clamp(rest / kBytesPerTriangle, kFewestTriangles, std::size_t{1} << 31);
}

struct ComparedSurface::Part {
  explicit Part(MeshPortion portion) : faces(std::move(portion)) {}

  MeshPortion faces;
  std::vector<double> areas;         // sums of AreaSum, for drawing
  std::optional<TriangleTree> tree;  // tree of these triangles, for measuring
};

ComparedSurface::ComparedSurface(const Mesh& mesh, double scale) {
  check_area(mesh.faces.empty() ? 0 : 1, 0);
  MeshPortion all{.mesh = {mesh.vertices, mesh.faces, {}}, .numbers = {}};
  for (Vec3& vertex : all.mesh.vertices) vertex *= scale;
  bounds_ = rholm::bounds(all.mesh.vertices);
  frame_ = unit_frame(bounds_);
  boxes_ = {{.min = frame_.to_local(bounds_.min), .max = frame_.to_local(bounds_.max)}};
  kept_ = std::make_shared<Part>(std::move(all));
}

ComparedSurface::ComparedSurface(const MeshInPlace& mesh, const Bounds& bounds, double scale,
                                 std::size_t triangles)
    : bounds_{.min = scale * bounds.min, .max = scale * bounds.max},
      frame_(unit_frame(bounds_)),
      portions_(std::in_place, mesh, scale, triangles) {}

ComparedSurface::~ComparedSurface() = default;

void ComparedSurface::survey_portions() {
  AreaSum sum(frame_.scale);
  for (std::size_t p = 0; p < portions_->size(); ++p) {
    const Mesh mesh = portions_->load(p).mesh;
    const Bounds box = rholm::bounds(mesh.vertices);
    boxes_.push_back({.min = frame_.to_local(box.min), .max = frame_.to_local(box.max)});
    sums_.push_back(sum);
    sum.add(mesh);
  }
  twice_area_ = sum.value();
  check_area(twice_area_, portions_->n_faces());
}

void ComparedSurface::prepare_to_draw() {
  std::call_once(to_draw_, [&] {
    if (!kept_) return survey_portions();
    AreaSum sum(frame_.scale);
    kept_->areas = sum.add(kept_->faces.mesh);
    twice_area_ = sum.value();
    check_area(twice_area_, kept_->areas.size());
  });
}

void ComparedSurface::prepare_to_measure(const Context& context) {
  if (!kept_) return prepare_to_draw();
  std::call_once(to_measure_, [&] { kept_->tree.emplace(kept_->faces.mesh, context); });
}

std::shared_ptr<const ComparedSurface::Part> ComparedSurface::part_to_draw(std::size_t p) const {
  if (kept_) return kept_;
  const auto part = std::make_shared<Part>(portions_->load(p));
  part->areas = AreaSum(sums_[p]).add(part->faces.mesh);
  return part;
}

std::shared_ptr<const ComparedSurface::Part> ComparedSurface::part_to_search(std::size_t p) const {
  if (kept_) return kept_;
  const auto part = std::make_shared<Part>(portions_->load(p));
  part->tree.emplace(part->faces.mesh, frame_, part->faces.numbers);
  return part;
}

SurfaceSamples ComparedSurface::draw(const CompareOptions& options, std::size_t first,
                                     std::size_t n) const {
  const AreaSampling sampling{twice_area_, options.samples, options.seed};
  SurfaceSamples all;
  all.points.reserve(n);
  all.normals.reserve(n);
  for (std::size_t p = 0; p < n_parts() && all.points.size() < n; ++p) {
    const std::shared_ptr<const Part> part = part_to_draw(p);
    const Mesh& mesh = part->faces.mesh;
    const std::size_t done = all.points.size();
    const AreaSamples samples = sampling.draw(mesh, part->areas, first + done, n - done);
    all.points.insert(all.points.end(), samples.points.begin(), samples.points.end());
    LastNormal normal(mesh);
    for (const std::uint32_t t : samples.faces) all.normals.push_back(normal.of(t));
  }
  return all;
}

void ComparedSurface::measure(const SurfaceSamples& samples, const DistancesOut& out,
                              const Context& context, const ParallelStage& stage) const {
  PartSearch search(samples, frame_, out, context);
  const auto progress = [&](std::size_t done) {
    const double part = static_cast<double>(done) / static_cast<double>(n_parts());
    report_progress(context, stage.name, stage.from + (stage.to - stage.from) * part);
  };
  progress(0);
  // Triangles spread over the mesh first bound the distance of each
  // sample; then only a small number of portions lie within these bounds.
  if (n_parts() > 1) search.ask_of_all(portions_->scouts());
  for (std::size_t p = 0; p < n_parts(); ++p) {
    if (search.concerns(boxes_[p])) {
      const std::shared_ptr<const Part> part = part_to_search(p);
      search.ask(*part->tree, part->faces);
    }
    progress(p + 1);
  }
}

}  // namespace rholm
