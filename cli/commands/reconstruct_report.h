// Report of a reconstruction. Layer: cli.
#pragma once

#include <string>

#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct.h"

namespace rholm::cli {

Json json_of(const ReconstructReport& report, bool confidence);
std::string report_text(const ReconstructReport& report, const ReconstructOptions& options);

// Warns about an unreliable surface; throws NotConverged if it should not be trusted. The output is
// already written. `filled`: holes are closed.
void judge(const ReconstructReport& report, bool filled, Session& session);

}  // namespace rholm::cli
