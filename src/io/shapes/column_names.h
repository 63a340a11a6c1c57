// The meaning of names in the header of a table of points. Layer: io.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rholm {

// The meaning of a column.
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

// Returns "x", "nx", "r", "lat", ...; "-" for an ignored column.
const char* to_string(ColumnRole role);

// The meaning of all names of a header.
struct NamedRoles {
  std::vector<ColumnRole> roles;  // one for each name; scalar for other names
  bool colatitude = false;        // the latitude is measured from the north pole
  bool west = false;              // the longitude grows westwards
  bool radians = false;           // both angles are in radians
  bool has_position() const;      // x, y, z or latitude, longitude, radius
};
// Reads names in upper or lower case. Units may follow ("X [mm]", "y_m", "Latitude (deg)"), and
// words for points, normals and colours may precede or follow ("pos_x", "Normals:0", "color_r").
NamedRoles named_roles(const std::vector<std::string>& names);
bool has_position(const std::vector<std::string>& names);

std::string lower_case(std::string_view text);  // changes ASCII letters only

}  // namespace rholm
