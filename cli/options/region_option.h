// "--region": parts of a shape, for edits. Layer: cli.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "rholm/region.h"

namespace rholm::cli {

// Option "--NAME R", required, which may be repeated.
Option region_option(const std::string& name, const std::string& help,
                     std::vector<std::string>& texts);

// Parses texts that the option has checked.
std::vector<Region> parse_regions(const std::vector<std::string>& texts);

// Forms of a region, for the descriptions of commands.
inline constexpr const char* kRegionHelp =
    "A region is ball:X,Y,Z,RADIUS; vertex:INDEX,RADIUS, a disc along the surface around a vertex "
    "(counted from 0); box:X0,Y0,Z0,X1,Y1,Z1; color:RRGGBB, the vertices of this colour; or "
    "property:NAME, an attribute with weights from 0 to 1. Several regions are joined.";

}  // namespace rholm::cli
