#include "report/page/report_markup.h"

#include <cmath>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_plot.h"
#include "rholm/version.h"

namespace rholm::report {
namespace {

// The style sheet of a report.

// Light or dark like the reader's system; black on white on paper.
extern const char* const kStyle;

const char* const kStyle = R"css(
:root { color-scheme: light dark; --paper: #fff; --ink: #1b1e23; --muted: #59606b; --rule: #d5dae1;
  --fine: #eceff3; --soft: #f4f6f8; --measured: #1f5fa8; --tail: #b8481f; --largest: #2a7a4b;
  --distance: #7a4aa8; }
@media screen and (prefers-color-scheme: dark) { :root { --paper: #14171c; --ink: #e6e8eb;
  --muted: #a3abb6; --rule: #3a414c; --fine: #242932; --soft: #1d2128; --measured: #7fb2ea;
  --tail: #f0956b; --largest: #74cf9b; --distance: #c4a0ec; } }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 1rem/1.55 system-ui,
  -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", "DejaVu Sans",
  sans-serif; overflow-wrap: break-word; }
header, main, footer { max-width: 72rem; margin: 0 auto; padding: 0 1.25rem; }
header { padding-top: 2.25rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .4rem; font-weight: 650;
  overflow-wrap: anywhere; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 2.75rem 0 .6rem; font-weight: 650; }
p { margin: .5rem 0; max-width: 44rem; }
.lead, .note, figcaption, caption, footer { color: var(--muted); }
i, .it { font-style: italic; }
sub, sup { font-size: .72em; line-height: 0; }
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(9.5rem, 1fr)); gap: .75rem;
  margin: 1.5rem 0 0; }
.facts div { background: var(--soft); border-radius: .4rem; padding: .7rem .9rem; }
.facts dt { color: var(--muted); font-size: .875rem; }
.facts dd { margin: 0; font-size: 1.2rem; white-space: nowrap; font-weight: 600; font-variant-numeric: tabular-nums; }
.facts dd small { display: block; font-size: .8rem; font-weight: 400; color: var(--muted); }
figure { margin: 0; }
figcaption { font-size: .9rem; margin-top: .4rem; }
.pictures { display: grid; gap: .75rem; margin: 1rem 0; }
.n1 { grid-template-columns: minmax(0, 30rem); }
.n2 { grid-template-columns: repeat(2, minmax(0, 1fr)); max-width: 54rem; }
.n3 { grid-template-columns: repeat(3, minmax(0, 1fr)); }
.n4 { grid-template-columns: repeat(4, minmax(0, 1fr)); }
.pictures img { display: block; width: 100%; height: auto; background: #fff; border-radius: .4rem;
  border: 1px solid var(--rule); }
.pictures figcaption { text-align: center; color: var(--ink); }
.bar { display: block; width: 100%; max-width: 34rem; }
.map figcaption { margin-top: 0; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr));
  gap: 1.5rem 2rem; margin: 1rem 0; }
.plot { display: block; width: 100%; max-width: 38rem; }
svg text { fill: var(--ink); font-size: 16px; }
svg .sup { font-size: 12px; }
.grid { stroke: var(--rule); } .fine { stroke: var(--fine); } .tick { stroke: var(--ink); }
.frame { fill: none; stroke: var(--muted); }
.line { fill: none; stroke-width: 2; stroke-linejoin: round; }
.line.measured { stroke: var(--measured); } .mark.measured { fill: var(--measured); }
.line.tail { stroke: var(--tail); stroke-dasharray: 9 5; }
.line.largest { stroke: var(--largest); stroke-dasharray: 2 4; }
.mark.largest { fill: var(--largest); }
.line.distance { stroke: var(--distance); stroke-dasharray: 2 4; }
.mark.distance { fill: var(--distance); }
.line.tolerance { stroke: var(--ink); stroke-dasharray: 12 4 2 4; }
.legend { list-style: none; margin: .4rem 0 0; padding: 0; font-size: .9rem; }
.legend li { display: flex; align-items: baseline; gap: .6rem; }
.key { flex: none; width: 36px; height: 14px; position: relative; top: 2px; }
.scroll { overflow-x: auto; margin: .75rem 0; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; line-height: 1.4; }
caption { text-align: left; font-size: .9rem; padding-bottom: .4rem; }
th, td { padding: .38rem 1.1rem .38rem 0; text-align: left; vertical-align: baseline; }
th { font-weight: 600; }
tbody th { font-weight: 400; }
thead th { border-bottom: 1.5px solid var(--muted); vertical-align: bottom; }
tbody tr + tr > * { border-top: 1px solid var(--fine); }
.num { text-align: right; white-space: nowrap; padding-left: .6rem; }
td small, .num small { display: block; color: var(--muted); font-size: .8rem; }
.scroll th.num[scope=row] { position: sticky; left: 0; background: var(--paper); }
tr.own > * { font-weight: 600; }
tr.own small { font-weight: 400; }
pre { background: var(--soft); border-radius: .4rem; padding: .7rem .9rem; margin: .4rem 0 1rem;
  white-space: pre-wrap; overflow-wrap: anywhere; font: .875rem/1.5 ui-monospace, SFMono-Regular,
  Menlo, Consolas, "DejaVu Sans Mono", monospace; }
.formula { margin: .8rem 0; padding-left: 1.25rem; }
.scroll:focus-visible { outline: 2px solid var(--measured); outline-offset: 2px; }
footer { margin-top: 3rem; padding-top: 1rem; padding-bottom: 2rem; font-size: .875rem; }
@media screen and (max-width: 44rem) { html { font-size: 15px; } header, main, footer { padding-left: 1rem;
  padding-right: 1rem; } h1 { font-size: 1.5rem; } h2 { margin-top: 2.2rem; }
  .n3, .n4 { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  .facts { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: .5rem; }
  .facts div:last-child:nth-child(odd) { grid-column: 1 / -1; } .facts dd { font-size: 1.05rem; }
  th, td { padding-right: .9rem; } }
@page { margin: 16mm 15mm; }
@media print { :root { color-scheme: light; --ink: #000; --muted: #333; --rule: #bbb;
  --fine: #ddd; --soft: #fff; --measured: #123f78; --tail: #8a3312; --largest: #1c5a36;
  --distance: #55307c; }
  html { font-size: 9.5pt; } header, main, footer { max-width: none; padding-left: 0;
  padding-right: 0; } header { padding-top: 0; } h1 { font-size: 18pt; }
  h2 { font-size: 12.5pt; margin-top: 14pt; break-after: avoid; }
  p { max-width: none; orphans: 3; widows: 3; }
  .facts { grid-template-columns: repeat(5, 1fr); } .facts div { border: 1px solid var(--rule); }
  .n4 { grid-template-columns: repeat(4, minmax(0, 1fr)); }
  .n3 { grid-template-columns: repeat(3, minmax(0, 1fr)); } .n2 { max-width: 120mm; }
  .plots { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 6mm; } .bar { max-width: 100mm; }
  .scroll { overflow: visible; } table { font-size: .92rem; } thead { display: table-header-group; }
  p:has(+ .formula) { break-after: avoid; } figure, tr, pre, .facts, .formula { break-inside: avoid; } .short { break-inside: avoid; }
  pre { border: 1px solid var(--rule); } footer { margin-top: 8mm; } }
)css";

// Makes the head: nothing may be loaded from elsewhere, and only the page's own scripts run.
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

std::string name_of_shape(const ReportOptions& options) {
  return options.shape_name.empty() ? "the shape" : html::escaped(options.shape_name);
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
         12.0 * static_cast<double>(mesh.faces.size());
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

// Puts the table into a box that scrolls by finger or keyboard.
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
