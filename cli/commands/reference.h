// Sections of docs/reference.md, each made from a table of the library. Layer: cli.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rholm::cli {

// Returns a section of Markdown, which begins with a heading of the second level.
using ReferenceSection = std::string (*)();
std::span<const ReferenceSection> reference_sections();

// Returns a table of Markdown with these headings. Cells are not changed, except that bars are
// escaped.
std::string markdown_table(const std::vector<std::string>& headings,
                           const std::vector<std::vector<std::string>>& rows);

}  // namespace rholm::cli
