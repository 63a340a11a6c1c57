// Reconstructs a closed mesh from a scan, or from any points on a surface.
// Usage: points_to_surface POINTS OUT_MESH
#include <rholm/rholm.h>

#include <cstdio>
#include <string>
#include <variant>

namespace {

void run(const std::string& points, const std::string& out) {
  rholm::ShapeFile file = rholm::read_shape(points);
  auto* cloud = std::get_if<rholm::PointCloud>(&file.shape);
  if (cloud == nullptr) {
    throw rholm::Error(rholm::ErrorCode::kInvalidInput, points + " has faces, not points");
  }
  // Missing normals are computed first. Noise and size of detail are estimated from the data.
  const rholm::Reconstruction surface = rholm::reconstruct(*cloud);
  rholm::write_shape(surface.mesh, out);

  const rholm::ReconstructReport& report = surface.report;
  std::printf("points %zu, of which outliers %zu\n", report.points, report.outliers);
  std::printf("noise %.3g\n", report.noise);
  const rholm::Inspection mesh = rholm::inspect(surface.mesh);
  std::printf("closed %s\n", mesh.closed && mesh.manifold ? "yes" : "no");
  std::printf("genus %zu\n", mesh.genus);
  std::printf("volume %.6g\n", mesh.volume);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: points_to_surface POINTS OUT_MESH\n");
    return 2;
  }
  try {
    run(argv[1], argv[2]);
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "points_to_surface: %s\n", error.what());
    return 1;
  }
}
