// Sections of docs/reference.md, each made from a table of the library. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rholm::cli {

// A section of Markdown, beginning with its heading of the second level.
using ReferenceSection = std::string (*)();
std::span<const ReferenceSection> reference_sections();

// A table of Markdown with these headings. Cells are as they stand, but for bars, which are
// escaped.
std::string markdown_table(const std::vector<std::string>& headings,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace rholm::cli
