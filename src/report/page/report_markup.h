// Pieces of a report that all kinds of it have: the page, sections, facts, tables, figures.
#pragma once

#include <string>
#include <vector>

#include "report/page/report_pictures.h"
#include "rholm/mesh.h"
#include "rholm/report.h"

namespace rholm::report {

// Arguments are markup unless they say text.
std::string paragraph(const std::string& markup);
std::string note(const std::string& markup);
std::string section(const std::string& title, const std::string& content);
std::string fact(const std::string& name, const std::string& value, const std::string& small);

// The page around its content, with the header: title, lead (a sentence), notes, facts; scripts run
// after it, and only if there are any.
std::string page(const ReportOptions& options, const std::string& lead, const std::string& facts,
                 const std::string& sections, const std::string& scripts = {});
// How to get it again; empty without commands.
std::string commands_section(const ReportOptions& options);

// `alt` is text.
std::string figure_of(const Picture& picture, const std::string& alt, const std::string& caption);
// A map of distances seen from both sides, with its colours; `surface` is text: what is drawn.
std::string error_map(const ErrorMap& map, const std::string& surface, const std::string& caption,
                      const std::string& unit);

// As people say sizes: powers of 1000.
std::string size_text(double bytes);
// Of its arrays.
double bytes_of(const Mesh& mesh);
// "rms error, km", as far as the unit is known; the unit is text.
std::string with_unit(const std::string& heading, const std::string& unit);
// A value and, smaller, what may be said with it.
std::string two_lines(const std::string& value, const std::string& part);
// A length as a part of the diagonal: "2.31 x 10^-4 d"; empty if either is unknown.
std::string part_of(const std::optional<double>& length, double diagonal);

struct Column {
  std::string heading;
  bool is_number = false;
};

struct Row {
  std::vector<std::string> cells;  // the first one names the row
  bool own = false;                // the model's own degree: set off
};

struct Table {
  std::string label;  // for those who do not see it: what scrolls
  std::vector<Column> columns;
  std::vector<Row> rows;
};

std::string markup_of(const Table& table);

}  // namespace rholm::report
