// The tables of a report.
#pragma once

#include <optional>
#include <string>

#include "report/page/report_data.h"

namespace rholm::report {

// Degree, number of coefficients, bytes, errors.
std::string degree_table(const Expansion& expansion, const Data& data);
// What is known of the model's own error, and how; empty if nothing is.
std::string error_table(const Expansion& expansion, const Data& data);
// Vertices, volume, centre, ... of the shape and of the model beside it.
std::string figure_table(const Expansion& expansion, const Data& data);

// The rms error of a row: "&lt; ..." where only a bound is known, with a sign for "about" where it
// was measured.
std::string rms_text(const DegreeRow& row, const std::string& unit, int digits = 4);
// A length as a part of the diagonal: "2.31 x 10^-4 d"; empty if either is unknown.
std::string of_diagonal(const std::optional<double>& length, const Data& data);
// Three lines with as many decimals as a body of that size needs.
std::string point_text(const Vec3& p, double size);

}  // namespace rholm::report
