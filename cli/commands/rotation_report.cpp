#include "cli/commands/rotation_report.h"

#include <numbers>

#include <fmt/format.h>

namespace rholm::cli {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

}  // namespace

Json json_of(const Rotation& rotation) {
  const RotationMatrix matrix = matrix_of(rotation);
  const AxisAngle turn = axis_angle_of(rotation);
  return {{"matrix", {json_of(matrix[0]), json_of(matrix[1]), json_of(matrix[2])}},
          {"axis", json_of(turn.axis)},
          {"angle", degrees(turn.angle)}};
}

std::string text_of(const Rotation& rotation) {
  std::string text = line("rotation", turn_text(rotation));
  bool first = true;
  for (const Vec3& row : matrix_of(rotation)) {
    text +=
        line(first ? "matrix" : "", fmt::format("{:12.9f} {:12.9f} {:12.9f}", row.x, row.y, row.z));
    first = false;
  }
  return text;
}

std::string turn_text(const Rotation& rotation) {
  const AxisAngle turn = axis_angle_of(rotation);
  return fmt::format("{:.6f} degrees about {}", degrees(turn.angle), text_of(turn.axis));
}

}  // namespace rholm::cli
