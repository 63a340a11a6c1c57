// Computes spherical harmonics of a mesh, stores them in a file, and makes a mesh of them.
// Usage: mesh_to_coefficients MESH DEGREE MODEL.h5 OUT_MESH
#include <rholm/rholm.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <string>

namespace {

void run(const std::string& mesh, int degree, const std::string& model, const std::string& out) {
  // From faces to coefficients. The mesh must be closed, and star-shaped from some centre.
  rholm::EncodeOptions options;
  options.analyze.degree = degree;
  const rholm::Encoded encoded = rholm::encode_file(mesh, options);
  rholm::write_model(encoded.analysis.expansion, model);

  // The model file has everything that the surface needs.
  const rholm::Expansion expansion = rholm::read_model(model);
  const rholm::Mesh surface = rholm::synthesize(expansion, rholm::icosphere(5));
  rholm::write_shape(surface, out);

  // The library's harmonics are orthonormal: c_00 is the mean radius times sqrt(4 pi).
  const double mean_radius = expansion.coefficients.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  const rholm::SurfaceMeasures measures = rholm::measure(expansion);
  std::printf("faces %zu\n", encoded.faces);
  std::printf("centre %.6g %.6g %.6g\n", expansion.center.x, expansion.center.y,
              expansion.center.z);
  std::printf("mean radius %.6g\n", mean_radius);
  if (measures.volume) std::printf("volume %.6g\n", *measures.volume);
  if (measures.area) std::printf("area %.6g\n", *measures.area);
  if (expansion.errors && expansion.errors->rms) {
    std::printf("left out (rms) %.3g\n", *expansion.errors->rms);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 5) throw std::invalid_argument("wrong number of arguments");
    run(argv[1], std::stoi(argv[2]), argv[3], argv[4]);
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "mesh_to_coefficients: %s\n", error.what());
    return 1;
  } catch (const std::logic_error&) {  // thrown by main, or by stoi for a text that is no number
    std::fprintf(stderr, "usage: mesh_to_coefficients MESH DEGREE MODEL.h5 OUT_MESH\n");
    return 2;
  }
}
