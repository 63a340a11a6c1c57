#include "transform/error/proportional_sample.h"

#include "base/random.h"

namespace rholm {

ProportionalSample proportional_sample(const std::vector<double>& weights, std::size_t n,
                                       std::uint64_t seed) {
  ProportionalSample sample;
  double whole = 0;
  for (const double weight : weights) whole += weight;
  if (!(whole > 0) || !std::isfinite(whole)) return sample;
  sample.indices.reserve(n);
  sample.stand_for.reserve(n);
  const double part = whole / static_cast<double>(n);
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i];
    while (sample.indices.size() < n) {
      const std::size_t k = sample.indices.size();
      if ((static_cast<double>(k) + random_uniform(seed, k)) * part >= sum) break;
      sample.indices.push_back(i);
      sample.stand_for.push_back(part / weights[i]);
    }
  }
  return sample;
}

}  // namespace rholm
