// A box made, analysed, synthesised again: the public headers and the library suffice.
#include <rholm/rholm.h>

#include <cmath>
#include <cstdio>
#include <numbers>

int main() {
  const rholm::Mesh box = rholm::box({1, 1, 1});
  rholm::EncodeOptions options;
  options.analyze.degree = 8;
  const rholm::Encoded encoded = rholm::encode(box, options);
  const rholm::Expansion& expansion = encoded.analysis.expansion;
  const double mean_radius = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  // Between the inscribed and the circumscribed sphere.
  const bool plausible = mean_radius > 0.5 && mean_radius < std::sqrt(0.75);
  const rholm::Mesh surface = rholm::synthesize(expansion, rholm::icosphere(2));
  std::printf("rholm %s: mean radius of a unit box %.6f, %zu vertices\n", rholm::kVersion,
              mean_radius, surface.vertices.size());
  return plausible && surface.vertices.size() == 162 ? 0 : 1;
}
