// A program that uses coefficients only.
#include <rholm/model.h>
#include <rholm/primitives.h>

#include <cmath>
#include <numbers>

int main() {
  rholm::EncodeOptions options;
  options.analyze.degree = 4;
  const rholm::Encoded sphere = rholm::encode(rholm::icosphere(4), options);
  // The mean radius of a sphere's facets is just below 1.
  const double mean =
      sphere.analysis.expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  return mean > 0.99 && mean < 1 ? 0 : 1;
}
