// What names in the header of a table of points mean. Layer: io.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rholm {

// What a column is.
enum class ColumnRole : std::uint8_t {
  kX,
  kY,
  kZ,
  kNx,
  kNy,
  kNz,
  kRed,
  kGreen,
  kBlue,
  kAlpha,
  kLatitude,
  kLongitude,
  kRadius,
  kScalar,
  kSkipped
};

// "x", "nx", "r", "lat", ...; "-" for a column that is passed over.
const char* to_string(ColumnRole role);

// What the names of a header say.
struct NamedRoles {
  std::vector<ColumnRole> roles;  // one for each name; scalar where it says nothing else
  bool colatitude = false;        // the latitude is measured from the north pole
  bool west = false;              // the longitude grows westwards
  bool radians = false;           // both angles
  bool has_position() const;      // x, y, z or latitude, longitude, radius
};
// In either case, with units behind them ("X [mm]", "y_m", "Latitude (deg)") and words for points,
// normals and colours before or behind them ("pos_x", "Normals:0", "color_r").
NamedRoles named_roles(const std::vector<std::string>& names);
bool has_position(const std::vector<std::string>& names);

std::string lower_case(std::string_view text);  // of ASCII

}  // namespace rholm
