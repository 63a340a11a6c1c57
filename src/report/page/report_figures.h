// Sections of a report with pictures and plots.
#pragma once

#include <string>

#include "report/page/report_data.h"
#include "report/page/report_pictures.h"

namespace rholm::report {

std::string levels_section(const Expansion& expansion, const Data& data,
                           const ReportOptions& options, const Pictures& pictures);
// Returns an empty string without a shape.
std::string error_map_section(const Expansion& expansion, const Data& data,
                              const ReportOptions& options, const Pictures& pictures);
std::string spectrum_section(const Expansion& expansion, const Data& data,
                             const ReportOptions& options);

}  // namespace rholm::report
