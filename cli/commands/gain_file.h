// Gains of a filter from a text file. Layer: cli.
#pragma once

#include <string>
#include <vector>

namespace rholm::cli {

// Reads lines "DEGREE GAIN"; text after a # is a comment. Returns the gains of degrees 0 ...
// `degree`; unlisted degrees have gain 1. Throws Io, InvalidInput with the line.
std::vector<double> read_gains(const std::string& path, int degree);

}  // namespace rholm::cli
