// Sums over the vertices of a mesh.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "harmonic/nonuniform/cost_model.h"
#include "rholm/synthesize.h"
#include "rholm_bench/bench.h"
#include "rholm_bench/bench_timing.h"

namespace rholm {
namespace {

// Direct sums use a sample of about 0.1 s (nanoseconds by the cost model), in whole vectors.
constexpr double kSampledCost = 1e8;
constexpr std::size_t kLeastSample = 64;

struct RandomSources {
  std::vector<Vec3> directions;
  std::vector<double> weights;
  std::vector<Vec3> gradients;

  ScatteredSources values() const { return {.directions = directions, .weights = weights}; }
  ScatteredSources slopes() const {
    return {.directions = directions, .weights = weights, .gradients = gradients};
  }
};

double random_sign(std::uint64_t stream, std::size_t i) {
  return 2 * random_uniform(stream, i) - 1;
}

RandomSources sources_of(const Mesh& mesh, const Vec3& center) {
  RandomSources sources;
  sources.directions = directions_of(mesh, center).vertices;
  for (std::size_t i = 0; i < sources.directions.size(); ++i) {
    sources.weights.push_back(random_sign(1, i));
    sources.gradients.push_back(0.01 *
                                Vec3{random_sign(2, i), random_sign(3, i), random_sign(4, i)});
  }
  return sources;
}

// Takes every n-th source.
RandomSources sample_of(const RandomSources& all, int degree) {
  const double most = kSampledCost / direct_cost(1, degree, 0);
  const std::size_t n = all.directions.size();
  const std::size_t size =
      std::min(n, std::max(kLeastSample, static_cast<std::size_t>(most) / 32 * 32));
  RandomSources sample;
  for (std::size_t i = 0; i < size; ++i) {
    sample.directions.push_back(all.directions[i * n / size]);
    sample.weights.push_back(all.weights[i * n / size]);
  }
  return sample;
}

Timing scaled(Timing timing, double factor) {
  for (StageTime* time : {&timing.median, &timing.minimum}) {
    time->wall *= factor;
    time->cpu *= factor;
  }
  return timing;
}

}  // namespace

SumsBench bench_sums(const Mesh& mesh, const Expansion& expansion, const BenchOptions& options,
                     const Context& context) {
  check(options);
  const RandomSources sources = sources_of(mesh, expansion.center);
  const RandomSources sample = sample_of(sources, options.degree);
  const Coefficients& f = expansion.coefficients;
  const SumOptions fast{.precision = options.precision};
  const SumOptions slow{.engine = Engine::kDirect};
  std::vector<StageTime> adjoint, with_gradient, forward, direct;
  for (int i = -1; i < options.repeat; ++i) {  // the first run is not counted
    const Context inner =
        measured(context, 1, std::max(0.0, static_cast<double>(i)) / options.repeat);
    Coefficients sum(f.degree());
    const auto note = [&](std::vector<StageTime>& times, const auto& work) {
      const StageTime time = time_once(work);
      if (i >= 0) times.push_back(time);
    };
    note(adjoint, [&] { add_adjoint(sources.values(), sum, fast, inner); });
    note(with_gradient, [&] { add_adjoint(sources.slopes(), sum, fast, inner); });
    note(forward, [&] { evaluate_with_gradient(f, sources.directions, fast, inner); });
    note(direct, [&] { add_adjoint(sample.values(), sum, slow, inner); });
  }
  const double share = static_cast<double>(sources.directions.size()) /
                       static_cast<double>(std::max<std::size_t>(sample.directions.size(), 1));
  return {.directions = sources.directions.size(),
          .adjoint = timing_of(adjoint),
          .adjoint_with_gradient = timing_of(with_gradient),
          .forward_with_gradient = timing_of(forward),
          .sampled = sample.directions.size(),
          .direct = scaled(timing_of(direct), share)};
}

}  // namespace rholm
