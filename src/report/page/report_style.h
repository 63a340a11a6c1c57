// The style sheet of a report.
#pragma once

namespace rholm::report {

// Light or dark as the reader's system is; black on white on paper.
extern const char* const kStyle;

}  // namespace rholm::report
