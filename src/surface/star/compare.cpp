#include "rholm/compare.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/compensated_sum.h"
#include "base/progress.h"
#include "shape/queries/triangle_tree.h"
#include "surface/star/compare_samples.h"

namespace rholm {
namespace {

Distances summarize(const std::vector<double>& distances, double unit) {
  CompensatedSum sum, squares;
  double max = 0;
  for (const double d : distances) {
    sum.add(d);
    squares.add(d * d);
    max = std::max(max, d);
  }
  const auto n = static_cast<double>(distances.size());
  return {std::sqrt(squares.value() / n) * unit, sum.value() / n * unit, max * unit};
}

double share_within(const std::vector<double>& distances, double threshold) {
  const auto n =
      std::count_if(distances.begin(), distances.end(), [&](double d) { return d <= threshold; });
  return static_cast<double>(n) / static_cast<double>(distances.size());
}

// Returns the middle value, or the mean of the two middle ones; 0 if there are none.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

void summarize_angles(std::vector<double> angles, const std::vector<double>& more,
                      Comparison& result) {
  angles.insert(angles.end(), more.begin(), more.end());
  std::erase_if(angles, [](double angle) { return angle < 0; });
  CompensatedSum sum;
  for (const double angle : angles) sum.add(angle);
  if (!angles.empty())
    result.normal_mean_degrees = sum.value() / static_cast<double>(angles.size());
  result.normal_median_degrees = median(angles);
}

Comparison summary_of(const CompareSamples& samples, const SampleDistances& forth,
                      const SampleDistances& back) {
  const CompareOptions& options = samples.options();
  const double scale = samples.scale(), diagonal = samples.diagonal();
  Comparison result;
  result.samples = options.samples;
  result.seed = options.seed;
  result.diagonal = diagonal / scale;
  result.a_to_b = summarize(forth.distances, 1 / scale);
  result.b_to_a = summarize(back.distances, 1 / scale);
  result.hausdorff = std::max(result.a_to_b.max, result.b_to_a.max);
  result.threshold = options.threshold * diagonal / scale;
  result.recall = share_within(forth.distances, options.threshold * diagonal);
  result.precision = share_within(back.distances, options.threshold * diagonal);
  const double sum = result.precision + result.recall;
  if (sum > 0) result.f_score = 2 * result.precision * result.recall / sum;
  summarize_angles(forth.angles, back.angles, result);
  return result;
}

}  // namespace

Comparison compare(CompareSamples& samples, const Context& context, Executor* executor) {
  if (executor == nullptr) {
    const SampleDistances forth = samples.measure(Way::kForth, context, {"compare", 0, 0.5});
    const SampleDistances back = samples.measure(Way::kBack, context, {"compare", 0.5, 1});
    return summary_of(samples, forth, back);
  }
  SampleDistances forth(samples.options().samples), back(samples.options().samples);
  const std::size_t n = samples.n_parts();
  SharedProgress progress(context, "compare", 0, 1, static_cast<double>(n));
  // Parts are dealt, so a process with samples of one way needs only one of the two trees.
  executor->run(
      {.count = n, .dealt = true}, [&](std::size_t part, int) { return samples.work(part); },
      [&](std::size_t part, const std::string& bytes) {
        samples.take(part, bytes, forth, back);
        progress.add(1);
      });
  return summary_of(samples, forth, back);
}

Comparison compare(const Mesh& a, const Mesh& b, const CompareOptions& options,
                   const Context& context) {
  CompareSamples samples(a, b, options);
  return compare(samples, context);
}

Comparison compare(const MeshInPlace& a, const MeshInPlace& b, std::size_t memory,
                   const CompareOptions& options, const Context& context) {
  const std::size_t n_vertices = std::max(a.mesh.n_vertices, b.mesh.n_vertices);
  CompareSamples samples(a, b, triangles_of_portion(n_vertices, memory), options, context);
  return compare(samples, context);
}

std::vector<double> distances_to_surface(const std::vector<Vec3>& points, const Mesh& surface,
                                         const Context& context) {
  validate(surface);
  return distances_to(TriangleTree(surface, context), points, {"distances"}, context);
}

}  // namespace rholm
