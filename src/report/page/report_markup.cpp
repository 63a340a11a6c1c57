#include "report/page/report_markup.h"

#include <cmath>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_plot.h"
#include "report/page/report_style.h"
#include "rholm/version.h"

namespace rholm::report {
namespace {

// Nothing may be loaded from elsewhere, and nothing may run but what the page itself brings.
std::string head(const ReportOptions& options, bool has_scripts) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:{}; "
      "style-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"generator\" content=\"rholm {}\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n",
      has_scripts ? " blob:; script-src 'unsafe-inline'" : "", kVersion,
      html::escaped(options.title), kStyle);
}

std::string markup_of(const Row& row, const std::vector<Column>& columns) {
  std::string html = row.own ? "<tr class=\"own\">" : "<tr>";
  for (std::size_t k = 0; k < row.cells.size(); ++k) {
    const char* style = columns[k].is_number ? " class=\"num\"" : "";
    html += k == 0 ? fmt::format("<th scope=\"row\"{}>{}</th>", style, row.cells[k])
                   : fmt::format("<td{}>{}</td>", style, row.cells[k]);
  }
  return html + "</tr>\n";
}

}  // namespace

std::string paragraph(const std::string& markup) { return "<p>" + markup + "</p>\n"; }
std::string note(const std::string& markup) { return "<p class=\"note\">" + markup + "</p>\n"; }
std::string section(const std::string& title, const std::string& content) {
  return "<section>\n<h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string fact(const std::string& name, const std::string& value, const std::string& small) {
  return fmt::format("<div><dt>{}</dt><dd>{}{}</dd></div>\n", name, value,
                     small.empty() ? "" : "<small>" + small + "</small>");
}

std::string page(const ReportOptions& options, const std::string& lead, const std::string& facts,
                 const std::string& sections, const std::string& scripts) {
  std::string html = head(options, !scripts.empty());
  html += fmt::format("<header>\n<h1>{}</h1>\n<p class=\"lead\">{}</p>\n",
                      html::escaped(options.title), lead);
  for (const std::string& text : options.notes) html += note(html::escaped(text));
  html += facts + "</header>\n<main>\n" + sections;
  return html +
         fmt::format("</main>\n<footer>rholm {}</footer>\n{}</body>\n</html>\n", kVersion, scripts);
}

std::string commands_section(const ReportOptions& options) {
  if (options.commands.empty()) return "";
  std::string html;
  for (const ReportCommand& command : options.commands) {
    html += fmt::format("<p>{}</p>\n<pre><code>{}</code></pre>\n", html::escaped(command.what),
                        html::escaped(command.command));
  }
  return section("To get it again", html);
}

std::string figure_of(const Picture& picture, const std::string& alt, const std::string& caption) {
  return fmt::format("<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">{}</figure>\n",
                     picture.uri, picture.width, picture.height, html::escaped(alt),
                     caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>");
}

std::string error_map(const ErrorMap& map, const std::string& surface, const std::string& caption,
                      const std::string& unit) {
  const std::string bar_title =
      fmt::format("Colour bar of the distance, 0 to {:.3g} {}", map.largest, unit);
  std::string html = "<figure class=\"map\">\n<div class=\"pictures n2\">\n";
  constexpr const char* kSides[] = {"from one side", "from the opposite side"};
  for (std::size_t k = 0; k < map.sides.size(); ++k) {
    html += figure_of(map.sides[k],
                      fmt::format("Picture of {}, coloured by its distance to the shape, seen {}",
                                  surface, kSides[k]),
                      kSides[k]);
  }
  return html + "</div>\n" + color_bar(map.scale, bar_title) + "<figcaption>" + caption +
         "</figcaption>\n</figure>\n";
}

std::string size_text(double bytes) {
  constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB"};
  std::size_t k = 0;
  while (k < 3 && bytes >= 1000) bytes /= 1000, ++k;
  return fmt::format("{}&nbsp;{}", k == 0 ? fmt::format("{}", bytes) : html::number(bytes, 3),
                     kUnits[k]);
}

double bytes_of(const Mesh& mesh) {
  return 24.0 * static_cast<double>(mesh.vertices.size()) +
         12.0 * static_cast<double>(mesh.triangles.size());
}

std::string with_unit(const std::string& heading, const std::string& unit) {
  return unit.empty() ? heading : heading + ", " + html::escaped(unit);
}

std::string two_lines(const std::string& value, const std::string& part) {
  return part.empty() ? value : fmt::format("{}<small>{}</small>", value, part);
}

std::string part_of(const std::optional<double>& length, double diagonal) {
  if (!length || !(diagonal > 0) || !std::isfinite(*length / diagonal)) return "";
  return html::number(*length / diagonal, 3) + "&nbsp;<i>d</i>";
}

// In a box of its own, in which it can be scrolled with a finger or the keyboard.
std::string markup_of(const Table& table) {
  std::string html = fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">\n<table{}>\n",
      table.label, table.rows.size() < 20 ? " class=\"short\"" : "");
  html += "<thead><tr>";
  for (const Column& column : table.columns) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", column.is_number ? " class=\"num\"" : "",
                        column.heading);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const Row& row : table.rows) html += markup_of(row, table.columns);
  return html + "</tbody>\n</table>\n</div>\n";
}

}  // namespace rholm::report
