#include "surface/star/compare_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/bytes.h"
#include "base/cancel.h"
#include "base/check_fields.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"

namespace rholm {
namespace {

constexpr std::size_t kSamplesOfPart = std::size_t{1} << 13;  // chosen: some 20 ms and 130 kB
constexpr std::size_t kSamplesOfStep = 256;  // some 50 ms where the shapes are far apart

Mesh scaled(const Mesh& mesh, double scale) {
  Mesh result{mesh.vertices, mesh.triangles, {}};
  for (Vec3& vertex : result.vertices) vertex *= scale;
  return result;
}

// Samples that follow each other are on one triangle as a rule.
class LastNormal {
 public:
  explicit LastNormal(const Mesh& mesh) : mesh_(mesh) {}
  const Vec3& of(std::uint32_t triangle) {
    if (triangle != triangle_) normal_ = unit_normal(mesh_, triangle);
    triangle_ = triangle;
    return normal_;
  }

 private:
  const Mesh& mesh_;
  std::optional<std::uint32_t> triangle_;
  Vec3 normal_;
};

}  // namespace

double common_scale(const Bounds& a, const Bounds& b) {
  return unit_frame(bounds({a.min, a.max, b.min, b.max})).scale;
}

Vec3 unit_normal(const Mesh& mesh, std::uint32_t triangle) {
  const FaceNormal face = face_normal(scaled_corners(mesh, mesh.triangles[triangle], 1));
  return face.degenerate ? Vec3{} : normalized(face.twice_area);
}

double angle_between(const Vec3& here, const Vec3& there) {
  if (there == Vec3{}) return -1;
  return std::atan2(norm(cross(here, there)), dot(here, there)) * (180 / std::numbers::pi);
}

CompareSamples::CompareSamples(const Mesh& a, const Mesh& b, const CompareOptions& options)
    : options_(options) {
  check_fields(options);
  validate(a);
  validate(b);
  scale_ = common_scale(bounds(a.vertices), bounds(b.vertices));
  a_.mesh = scaled(a, scale_);
  b_.mesh = scaled(b, scale_);
}

double CompareSamples::diagonal() const { return bounds(a_.mesh.vertices).diagonal(); }

void CompareSamples::prepare(Way way, const Context& context) {
  Side& here = way == Way::kForth ? a_ : b_;
  Side& there = way == Way::kForth ? b_ : a_;
  std::call_once(there.has_tree, [&] { there.tree.emplace(there.mesh, context); });
  std::call_once(here.has_sampler,
                 [&] { here.sampler.emplace(here.mesh, options_.samples, options_.seed); });
}

void CompareSamples::measure(Way way, std::size_t first, std::span<double> distances,
                             std::span<double> angles) const {
  const Side &here = from(way), &there = to(way);
  const AreaSamples samples = here.sampler->range(first, distances.size());
  const std::vector<ClosestPoint> closest = there.tree->closest(samples.points);
  LastNormal normal_here(here.mesh), normal_there(there.mesh);
  for (std::size_t k = 0; k < distances.size(); ++k) {
    distances[k] = closest[k].distance;
    angles[k] =
        angle_between(normal_here.of(samples.triangles[k]), normal_there.of(closest[k].triangle));
  }
}

std::size_t CompareSamples::parts_of_way() const {
  return (options_.samples + kSamplesOfPart - 1) / kSamplesOfPart;
}

CompareSamples::Part CompareSamples::part(std::size_t p) const {
  const std::size_t first = p % parts_of_way() * kSamplesOfPart;
  return {p < parts_of_way() ? Way::kForth : Way::kBack, first,
          std::min(kSamplesOfPart, options_.samples - first)};
}

std::string CompareSamples::work(std::size_t p) {
  const Part part = this->part(p);
  prepare(part.way);
  SampleDistances all(part.n);
  for (std::size_t at = 0; at < part.n; at += kSamplesOfStep) {
    ask_cancel();
    const std::size_t n = std::min(kSamplesOfStep, part.n - at);
    measure(part.way, part.first + at, std::span(all.distances).subspan(at, n),
            std::span(all.angles).subspan(at, n));
  }
  ByteWriter writer;
  writer.row(std::span<const double>(all.distances));
  writer.row(std::span<const double>(all.angles));
  return writer.take();
}

void CompareSamples::take(std::size_t p, std::string_view bytes, SampleDistances& forth,
                          SampleDistances& back) const {
  const Part part = this->part(p);
  SampleDistances& all = part.way == Way::kForth ? forth : back;
  ByteReader reader(bytes);
  reader.row(std::span(all.distances).subspan(part.first, part.n));
  reader.row(std::span(all.angles).subspan(part.first, part.n));
  reader.finish();
}

}  // namespace rholm
