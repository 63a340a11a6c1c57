// Gains of a filter from a text file. Layer: cli.
#pragma once

#include <string>
#include <vector>

namespace rholm::cli {

// Lines "DEGREE GAIN"; what follows a # is a comment. Degrees that no line names keep gain 1. The
// gains of degrees 0 ... `degree`. Throws Io, InvalidInput with the line.
std::vector<double> read_gains(const std::string& path, int degree);

}  // namespace rholm::cli
