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
    "Regions in space are ball:X,Y,Z,RADIUS and box:X0,Y0,Z0,X1,Y1,Z1. A disc along the surface "
    "around a vertex, counted from 0, is vertex:INDEX,RADIUS. Vertices of one colour are "
    "color:RRGGBB. An attribute with weights from 0 to 1 is property:NAME. Several regions are "
    "joined.";

}  // namespace rholm::cli
