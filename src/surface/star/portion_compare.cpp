#include "surface/star/portion_compare.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/cancel.h"
#include "shape/queries/triangle_tree.h"
#include "surface/star/area_samples.h"

namespace rholm {
namespace {

// Of a triangle of a portion: 12 of its corners, 79 of the tree, and 24 of each vertex, of which
// there are three where triangles are not joined.
constexpr std::size_t kBytesPerTriangle = 12 + 79 + 3 * 24;
constexpr std::size_t kFewestTriangles = std::size_t{1} << 14;  // chosen: 3 MB

struct DrawnSamples {
  std::vector<Vec3> points, normals;
};

DrawnSamples draw_samples(const SurveyedMesh& mesh, const CompareOptions& options) {
  const MeshPortions& portions = mesh.portions;
  DrawnSamples samples;
  samples.points.reserve(options.samples);
  samples.normals.reserve(options.samples);
  const AreaSampling sampling{.share = mesh.twice_area / static_cast<double>(options.samples),
                              .seed = options.seed};
  AreaSum sum(portions.frame().scale);
  CancelPoll poll;
  double target = sampling.target(0);
  for (std::size_t p = 0, k = 0; p < portions.size() && k < options.samples; ++p) {
    const MeshPortion portion = portions.load(p);
    for (std::uint32_t t = 0; t < portion.mesh.triangles.size(); ++t) {
      poll();
      const Triangle& corners = portion.mesh.triangles[t];
      const double area = sum.add(portion.mesh, corners);
      const bool is_last = portion.numbers.first + t == mesh.last;
      for (; k < options.samples && (area > target || is_last); target = sampling.target(++k)) {
        samples.points.push_back(sampling.place(k, portion.mesh, corners));
        samples.normals.push_back(unit_normal(portion.mesh, t));
      }
    }
  }
  return samples;
}

// The closest points so far of all samples, and what follows from them.
class PortionSearch {
 public:
  PortionSearch(const DrawnSamples& samples, const UnitFrame& frame, const Context& context)
      : samples_(samples),
        frame_(frame),
        context_(context),
        closest_(samples.points.size()),
        result_(samples.points.size()) {}

  // Whether a portion in that box may be the nearest to some samples: they are asked for next.
  bool concerns(const Bounds& box) {
    concerned_.clear();
    for (std::uint32_t k = 0; k < closest_.size(); ++k) {
      if (may_be_closer(box, frame_, samples_.points[k], closest_[k])) concerned_.push_back(k);
    }
    return !concerned_.empty();
  }
  void ask(const MeshPortion& portion) {
    const TriangleTree tree(portion.mesh, frame_, portion.numbers);
    parallel_for(concerned_.size(), kQueriesOfChunk, context_, {},
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t i = begin; i < end; ++i) {
                     improve(tree, portion, concerned_[i], concerned_[i > begin ? i - 1 : i]);
                   }
                 });
  }
  void ask_of_all(const MeshPortion& portion) {
    concerned_.resize(closest_.size());
    std::iota(concerned_.begin(), concerned_.end(), 0U);
    ask(portion);
  }
  SampleDistances take() { return std::move(result_); }

 private:
  void improve(const TriangleTree& tree, const MeshPortion& portion, std::uint32_t k,
               std::uint32_t before) {
    // No farther than the mesh is from the one before, and that from this one.
    const double at_most =
        closest_[before].distance + norm(samples_.points[k] - samples_.points[before]);
    if (!tree.improve(samples_.points[k], at_most, closest_[k])) return;
    const std::uint64_t triangle =
        (closest_[k].triangle - portion.numbers.first) / portion.numbers.step;
    result_.distances[k] = closest_[k].distance;
    result_.angles[k] = angle_between(
        samples_.normals[k], unit_normal(portion.mesh, static_cast<std::uint32_t>(triangle)));
  }

  const DrawnSamples& samples_;
  const UnitFrame& frame_;
  const Context& context_;
  std::vector<ClosestSoFar> closest_;
  std::vector<std::uint32_t> concerned_;
  SampleDistances result_;
};

}  // namespace

std::size_t triangles_of_portion(std::size_t n_vertices, std::size_t memory) {
  const std::size_t numbers = n_vertices / 16 * 3;  // of a RankedSet
  const std::size_t rest = memory > numbers ? memory - numbers : 0;
  return std::clamp(rest / kBytesPerTriangle, kFewestTriangles, std::size_t{1} << 31);
}

SurveyedMesh::SurveyedMesh(const MeshPortions& mesh) : portions(mesh) {
  AreaSum sum(portions.frame().scale);
  CancelPoll poll;
  for (std::size_t p = 0; p < portions.size(); ++p) {
    const MeshPortion portion = portions.load(p);
    const Bounds box = bounds(portion.mesh.vertices);
    boxes.push_back(
        {.min = portions.frame().to_local(box.min), .max = portions.frame().to_local(box.max)});
    for (std::uint32_t t = 0; t < portion.mesh.triangles.size(); ++t) {
      poll();
      const double area = sum.add(portion.mesh, portion.mesh.triangles[t]);
      if (area > twice_area) last = portion.numbers.first + t;
      twice_area = area;
    }
  }
  check_area(twice_area, portions.n_triangles());
}

SampleDistances measure_in_portions(const SurveyedMesh& here, const SurveyedMesh& there,
                                    const CompareOptions& options, const ParallelStage& stage,
                                    const Context& context) {
  const DrawnSamples samples = draw_samples(here, options);
  const MeshPortions& portions = there.portions;
  PortionSearch search(samples, portions.frame(), context);
  const auto progress = [&](std::size_t done) {
    const double part = static_cast<double>(done) / static_cast<double>(portions.size());
    report_progress(context, stage.name, stage.from + (stage.to - stage.from) * part);
  };
  progress(0);
  // Some triangles from everywhere say how far away the surface is at most: few portions are within
  // that of a sample.
  if (portions.size() > 1) search.ask_of_all(portions.scouts());
  for (std::size_t p = 0; p < portions.size(); ++p) {
    if (search.concerns(there.boxes[p])) search.ask(portions.load(p));
    progress(p + 1);
  }
  return search.take();
}

}  // namespace rholm
