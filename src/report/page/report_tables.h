// Tables of a report.
#pragma once

#include <optional>
#include <string>

#include "report/page/report_data.h"

namespace rholm::report {

// Columns: degree, number of coefficients, bytes, errors.
std::string degree_table(const Expansion& expansion, const Data& data);
// Returns the known errors of the model, with their sources; empty if there are none.
std::string error_table(const Expansion& expansion, const Data& data);
// Returns vertices, volume, centre, ... of the shape and of the model.
std::string figure_table(const Expansion& expansion, const Data& data);

// Returns the rms error of a row: "&lt; ..." where only a
// bound is known, with an "about" sign where it was measured.
std::string rms_text(const DegreeRow& row, const std::string& unit, int digits = 4);
// Returns a length as a part of the diagonal: "2.31 x 10^-4 d"; empty if either is unknown.
std::string of_diagonal(const std::optional<double>& length, const Data& data);
// Returns three lines with the decimals that a body of this size needs.
std::string point_text(const Vec3& p, double size);

}  // namespace rholm::report
