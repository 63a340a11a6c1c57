// Prints the energy per degree of two shapes, and their similarity regardless of rotation.
// Usage: spectrum_and_descriptors MESH OTHER_MESH DEGREE
#include <rholm/rholm.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// Expands about the centroid of the solid, a centre that rotates with the shape.
rholm::Coefficients coefficients_of(const std::string& path, int degree) {
  rholm::EncodeOptions options;
  options.analyze.degree = degree;
  options.chart.center.kind = rholm::CenterKind::kVolume;
  return rholm::encode_file(path, options).analysis.expansion.coefficients;
}

void run(const std::string& path, const std::string& other, int degree) {
  const rholm::Coefficients a = coefficients_of(path, degree);
  const rholm::Coefficients b = coefficients_of(other, degree);

  const std::vector<double> energy_a = rholm::power_spectrum(a);
  const std::vector<double> energy_b = rholm::power_spectrum(b);
  std::printf("degree  energy        of the other\n");
  for (int l = 0; l <= degree; ++l) {
    std::printf("%6d  %.6e  %.6e\n", l, energy_a[l], energy_b[l]);
  }
  // The square roots of the energies are descriptors that do not depend on rotation.
  std::printf("distance %.6g\n", rholm::distance(a, b));
  std::printf("distance of descriptors %.6g\n", rholm::descriptor_distance(a, b));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw std::invalid_argument("wrong number of arguments");
    run(argv[1], argv[2], std::stoi(argv[3]));
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "spectrum_and_descriptors: %s\n", error.what());
    return 1;
  } catch (const std::logic_error&) {  // thrown by main, or by stoi for a text that is no number
    std::fprintf(stderr, "usage: spectrum_and_descriptors MESH OTHER_MESH DEGREE\n");
    return 2;
  }
}
