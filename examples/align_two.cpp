// Finds the rotation that aligns one shape with another.
// Usage: align_two MESH ONTO_MESH OUT_MESH
#include <rholm/rholm.h>

#include <cstdio>
#include <numbers>
#include <string>

namespace {

rholm::Expansion expansion_of(const std::string& path) {
  rholm::EncodeOptions options;
  options.analyze.degree = 32;
  return rholm::encode_file(path, options).analysis.expansion;
}

void run(const std::string& path, const std::string& onto, const std::string& out) {
  const rholm::Expansion a = expansion_of(path);
  const rholm::Expansion b = expansion_of(onto);
  // Both surfaces are expanded about the centroids of their solids, which move with the shape.
  const rholm::Placement placement = rholm::align(a, b, rholm::AlignCenters::kVolume);
  const rholm::Alignment& found = placement.alignment;
  const rholm::Expansion moved = rholm::placed(a, placement);
  rholm::write_shape(rholm::synthesize(moved, rholm::icosphere(5)), out);

  const rholm::AxisAngle turn = rholm::axis_angle_of(found.best.rotation);
  const rholm::Vec3 shift = placement.to - placement.from;
  std::printf("axis %.4f %.4f %.4f\n", turn.axis.x, turn.axis.y, turn.axis.z);
  std::printf("angle %.4f degrees\n", turn.angle * 180 / std::numbers::pi);
  std::printf("shift %.4f %.4f %.4f\n", shift.x, shift.y, shift.z);
  std::printf("distance before %.4g\n", found.unaligned_distance);
  std::printf("distance after %.4g\n", found.best.distance);
  std::printf("others nearly as good %zu\n", found.ambiguities.size() + found.free_axes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: align_two MESH ONTO_MESH OUT_MESH\n");
    return 2;
  }
  try {
    run(argv[1], argv[2], argv[3]);
    return 0;
  } catch (const rholm::Error& error) {
    std::fprintf(stderr, "align_two: %s\n", error.what());
    return 1;
  }
}
