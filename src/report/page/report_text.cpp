#include "report/page/report_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_markup.h"
#include "report/page/report_tables.h"

namespace rholm::report {
namespace {

std::string largest_fact(const Expansion& expansion, const Data& data) {
  if (!data.errors) return "";
  const TruncationErrors& e = *data.errors;
  const bool measured = e.measured_max.has_value();
  const std::optional<double> value = measured ? e.measured_max : e.predicted_max;
  if (!value) return "";
  return fact(measured ? "largest error of <i>r</i>" : "largest error of <i>r</i>, predicted",
              html::length(value, expansion.unit, 3), of_diagonal(value, data));
}

// Explains which rms figures are exact.
std::string rms_note(const Data& data) {
  const auto exact = std::count_if(data.rows.begin(), data.rows.end(), [](const DegreeRow& row) {
    return row.rms && row.rms_is_exact;
  });
  const bool any = std::any_of(data.rows.begin(), data.rows.end(),
                               [](const DegreeRow& row) { return row.rms.has_value(); });
  if (!any) return "";
  std::string text = "The rms error is that of the radius over all directions";
  text += exact == static_cast<std::ptrdiff_t>(data.rows.size())
              ? ", exact by Parseval&#8217;s identity."
          : exact > 0
              ? ", exact by Parseval&#8217;s identity but where a sign &#8776; says that it was "
                "measured."
              : ", measured.";
  return text + " ";
}

std::string normalization_text() {
  return "<p>The surface is <i>x</i> = <i>c</i> + <i>r</i>(&#952;, &#966;)&#8239;<i>u</i>(&#952;, "
         "&#966;) with the unit vector <i>u</i> at colatitude &#952; from +<i>z</i> and longitude "
         "&#966; from +<i>x</i> towards +<i>y</i>, and</p>\n"
         "<p class=\"formula\"><i>f</i>(&#952;, &#966;) = &#931;<sub><i>l</i>=0&#8230;<i>L</i>"
         "</sub> &#931;<sub><i>m</i>=0&#8230;<i>l</i></sub> "
         "[<i>C<sub>lm</sub></i>&#8239;cos&#8239;<i>m</i>&#966; + "
         "<i>S<sub>lm</sub></i>&#8239;sin&#8239;<i>m</i>&#966;] "
         "<i>N<sub>m</sub></i>&#8239;<i>P<sub>lm</sub></i>(cos&#8239;&#952;).</p>\n"
         "<p>The functions are real and orthonormal: the square of each integrates to 1 over the "
         "sphere. There is no Condon&#8211;Shortley phase. Coefficients of 4&#960;-normalised "
         "functions are these divided by &#8730;(4&#960;); files say which ones they "
         "hold.</p>\n";
}

}  // namespace

std::string lead(const Expansion& expansion, const ReportOptions& options) {
  const bool gauge = expansion.function == RadialFunction::kGauge;
  std::string lead = fmt::format("Spherical harmonics of {} to degree {}",
                                 gauge ? "the inverse radius 1/<i>r</i>" : "the radius <i>r</i>",
                                 expansion.coefficients.degree());
  if (!options.shape_name.empty() && options.shape_name != options.title) {
    lead += ", beside the shape " + html::escaped(options.shape_name);
  }
  return lead + ".";
}

std::string facts(const Expansion& expansion, const Data& data) {
  const int degree = expansion.coefficients.degree();
  const double n = (degree + 1.0) * (degree + 1.0);
  const DegreeRow& own = data.rows.back();
  std::string html = "<dl class=\"facts\">\n" + fact("degree", std::to_string(degree), "");
  html += fact("coefficients", html::count(static_cast<std::size_t>(n)), "");
  if (own.rms || own.rms_at_most) {
    html += fact("rms error", rms_text(own, expansion.unit, 3), of_diagonal(own.rms, data));
  }
  html += largest_fact(expansion, data);
  std::string small;
  if (data.shape) small = "the mesh: " + size_text(bytes_of(data.shape->mesh));
  return html + fact("size", size_text(8 * n), small) + "</dl>\n";
}

std::string degrees_section(const Expansion& expansion, const Data& data) {
  std::string text = rms_note(data);
  if (data.diagonal > 0) {
    text +=
        "Smaller figures are parts of the diagonal <i>d</i> of the shape&#8217;s bounding box. ";
  }
  text +=
      "Bytes are those of the coefficients as doubles, 8 (<i>L</i> + 1)<sup>2</sup>; a model "
      "file takes twice that and some kB.";
  if (data.shape) {
    text += fmt::format(" The mesh has {}: 24 bytes for each vertex and 12 for each face.",
                        size_text(bytes_of(data.shape->mesh)));
  }
  return section("Degree by degree", degree_table(expansion, data) + note(text));
}

std::string errors_section(const Expansion& expansion, const Data& data) {
  const std::string table = error_table(expansion, data);
  if (table.empty()) {
    return section(
        "What is known of the error",
        paragraph(data.shape
                      ? "Nothing in figures: the shape is not closed and star-shaped from the "
                        "centre, so that a direction has no one radius. The map of "
                        "distances holds all the same."
                      : "Nothing: the file does not keep the norm of the shape it was made "
                        "of, and the shape is not at hand."));
  }
  std::string text =
      "Exact is the difference of the closed-form norm of the shape and the energy of the "
      "coefficients.";
  if (data.errors && data.errors->points > 0) {
    text +=
        " Points are the vertices of the shape, more of them on faces that are long against "
        "1/<i>L</i>, and others spread over the area. ";
    text += data.errors->distances_are_closest
                ? "Distances are those of closest points."
                : "Distances are to first order by the slope of the surface: too large where the "
                  "error is not small against the shape.";
  }
  if (data.errors && (data.errors->predicted_max || data.errors->predicted_max_distance)) {
    text +=
        " The prediction is a closed form of the angles of the edges that meet in a vertex; it "
        "holds where <i>L</i> times the angle that an edge subtends is above 10.";
  }
  return section("What is known of the error", table + note(text));
}

std::string figures_section(const Expansion& expansion, const Data& data) {
  return section("In figures", figure_table(expansion, data));
}

std::string conventions_section(const Expansion& expansion, const ReportOptions& options) {
  const bool gauge = expansion.function == RadialFunction::kGauge;
  std::string html = normalization_text();
  std::string text = fmt::format("Here <i>f</i> is {}. Lengths are in {}.",
                                 gauge ? "the gauge 1/<i>r</i>" : "the radius <i>r</i>",
                                 expansion.unit.empty() ? "the unit of the shape, which is not said"
                                                        : html::escaped(expansion.unit));
  if (!expansion.method.empty()) {
    text += fmt::format(" The coefficients were found by the method &#8220;{}&#8221;.",
                        html::escaped(expansion.method));
  }
  text +=
      " Energies are sums of squares of orthonormal coefficients; rms over solid angle is the "
      "root of the mean square over all directions.";
  if (options.weld_tolerance > 0) {
    text += fmt::format(" Vertices of the shape at most {} apart were joined.",
                        html::length(options.weld_tolerance, expansion.unit));
  }
  return section("Conventions", html + paragraph(text));
}

}  // namespace rholm::report
