// Parts that all reports share: page, sections, facts, tables, figures.
#pragma once

#include <string>
#include <vector>

#include "report/page/report_pictures.h"
#include "rholm/mesh.h"
#include "rholm/report.h"

namespace rholm::report {

// Arguments are markup, unless a comment says that they are text.
std::string paragraph(const std::string& markup);
std::string note(const std::string& markup);
std::string section(const std::string& title, const std::string& content);
std::string fact(const std::string& name, const std::string& value, const std::string& small);

// Returns the page around its content, with a header: title, lead (a
// sentence), notes, facts. Scripts run after the content; they may be empty.
std::string page(const ReportOptions& options, const std::string& lead, const std::string& facts,
                 const std::string& sections, const std::string& scripts = {});
// Returns the commands that make the report again; empty without commands.
std::string commands_section(const ReportOptions& options);

// `alt` is text.
std::string figure_of(const Picture& picture, const std::string& alt, const std::string& caption);
// Returns a map of distances from both sides with a colour bar; `surface` is its name, as text.
std::string error_map(const ErrorMap& map, const std::string& surface, const std::string& caption,
                      const std::string& unit);

// Returns the name of the shape for a sentence; "the shape" if it has none.
std::string name_of_shape(const ReportOptions& options);

// Returns a size in powers of 1000, for example "2.5 MB".
std::string size_text(double bytes);
// Returns the bytes of the mesh's arrays.
double bytes_of(const Mesh& mesh);
// Returns "rms error, km", or only the heading if the unit (text) is empty.
std::string with_unit(const std::string& heading, const std::string& unit);
// Returns a value with a smaller second line.
std::string two_lines(const std::string& value, const std::string& part);
// Returns a length as a part of the diagonal: "2.31 x 10^-4 d"; empty if either is unknown.
std::string part_of(const std::optional<double>& length, double diagonal);

struct Column {
  std::string heading;
  bool is_number = false;
};

struct Row {
  std::vector<std::string> cells;  // the first one names the row
  bool own = false;                // true for the model's own degree, which is highlighted
};

struct Table {
  std::string label;  // name for screen readers
  std::vector<Column> columns;
  std::vector<Row> rows;
};

std::string markup_of(const Table& table);

}  // namespace rholm::report
