// Finds the smallest degree whose surface is within a tolerance of a mesh.
// Usage: tolerance MESH PERCENT    (root mean square error, in percent of the mean radius)
#include <rholm/rholm.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

void run(const std::string& mesh, double percent) {
  rholm::EncodeOptions options;
  options.tolerance = rholm::Tolerance{.error = percent / 100,
                                       .unit = rholm::ToleranceUnit::kRadius,
                                       .norm = rholm::ErrorNorm::kRms,
                                       .measure = rholm::ErrorMeasure::kRadius,
                                       .max_degree = 512};
  const rholm::Encoded encoded = rholm::encode_file(mesh, options);
  const rholm::Expansion& expansion = encoded.analysis.expansion;
  const rholm::ToleranceReport& report = *encoded.tolerance;

  std::printf("degree %d\n", expansion.coefficients.degree());
  std::printf("allowed %.4g\n", report.allowed);
  std::printf("reached %.4g\n", report.reached);
  std::printf("kept %s\n", report.met ? "yes" : "no: the degree was limited to 512");
  // The expansion has the largest error as well, measured on the mesh.
  if (expansion.errors && expansion.errors->measured_max) {
    std::printf("largest %.4g\n", *expansion.errors->measured_max);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::invalid_argument("wrong number of arguments");
    run(argv[1], std::stod(argv[2]));
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "tolerance: %s\n", error.what());
    return 1;
  } catch (const std::logic_error&) {  // thrown by main, or by stod for a text that is no number
    std::fprintf(stderr, "usage: tolerance MESH PERCENT\n");
    return 2;
  }
}
