// Removes detail finer than a wavelength from a region of a mesh; other vertices do not change.
// Usage: smooth_region MESH REGION WAVELENGTH OUT_MESH    (REGION as ball:X,Y,Z,RADIUS)
#include <rholm/rholm.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace {

void run(const std::string& path, const std::string& region, double wavelength,
         const std::string& out) {
  rholm::ShapeFile file = rholm::read_shape(path);
  auto* mesh = std::get_if<rholm::Mesh>(&file.shape);
  if (mesh == nullptr) {
    throw rholm::Error(rholm::ErrorCode::kInvalidInput, path + " has points, not faces");
  }
  // The analysis is slow, updates are fast: a slider for wavelength and strength can use them.
  const std::vector<rholm::Region> regions = {rholm::parse_region(region)};
  const rholm::Patch patch = rholm::analyze_patch(*mesh, regions, {.wavelength = wavelength});
  const std::vector<rholm::Vec3> positions = rholm::update(patch, {.strength = 1});
  rholm::apply(patch, positions, *mesh);
  rholm::write_shape(*mesh, out);

  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    largest = std::max(largest, rholm::norm(positions[i] - patch.positions[i]));
  }
  std::printf("vertices %zu of %zu\n", patch.vertices.size(), mesh->vertices.size());
  std::printf("largest move %.4g\n", largest);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 5) throw std::invalid_argument("wrong number of arguments");
    run(argv[1], argv[2], std::stod(argv[3]), argv[4]);
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "smooth_region: %s\n", error.what());
    return 1;
  } catch (const std::logic_error&) {  // thrown by main, or by stod for a text that is no number
    std::fprintf(stderr, "usage: smooth_region MESH REGION WAVELENGTH OUT_MESH\n");
    return 2;
  }
}
