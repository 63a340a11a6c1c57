// Text of a report.
#pragma once

#include <string>

#include "report/page/report_data.h"

namespace rholm::report {

// Return the sentence below the title, and the main facts.
std::string lead(const Expansion& expansion, const ReportOptions& options);
std::string facts(const Expansion& expansion, const Data& data);
std::string degrees_section(const Expansion& expansion, const Data& data);
std::string errors_section(const Expansion& expansion, const Data& data);
std::string figures_section(const Expansion& expansion, const Data& data);
std::string conventions_section(const Expansion& expansion, const ReportOptions& options);

}  // namespace rholm::report
