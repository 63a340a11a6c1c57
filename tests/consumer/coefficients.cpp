// A program that uses coefficients only.
#include <rholm/model.h>
#include <rholm/primitives.h>

#include <cmath>
#include <numbers>

int main() {
  rholm::ExpandOptions options;
  options.degree = 4;
  const rholm::Expanded sphere = rholm::expand(rholm::icosphere(4), options);
  // The mean radius of a sphere's facets is just below 1.
  const double mean =
      sphere.transform.expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  return mean > 0.99 && mean < 1 ? 0 : 1;
}
