#include "report/page/report_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_markup.h"
#include "rholm/descriptors.h"

namespace rholm::report {
namespace {

constexpr const char* kDash = "&#8211;";
const std::string kAtMost = "&lt;&nbsp;";
constexpr const char* kNotKnown = "not known";

std::string length_cell(const std::optional<double>& value, const Data& data) {
  return two_lines(html::length(value, ""), of_diagonal(value, data));
}

Row degree_row(const DegreeRow& row, const Data& data, bool own) {
  const std::size_t n = (row.degree + std::size_t{1}) * (row.degree + std::size_t{1});
  return {{std::to_string(row.degree), html::count(n), html::count(8 * n),
           two_lines(rms_text(row, ""), of_diagonal(row.rms, data)), length_cell(row.max, data),
           length_cell(row.max_distance, data)},
          own};
}

// Name of a value, the value, and how it is known.
struct Known {
  const char* what;
  std::optional<double> value;
  std::string how;
};

std::vector<Known> known_errors(const TruncationErrors& e) {
  const std::string measured = fmt::format("measured at {} points", html::count(e.points));
  const char* parseval = "exact, by Parseval&#8217;s identity";
  const char* predicted = "predicted from the edges at the vertices";
  return {{"rms of the radius, over solid angle", e.rms, e.rms_is_exact ? parseval : measured},
          {"rms distance of the surfaces, over area", e.distance_rms, measured},
          {"largest error of the radius", e.measured_max, measured},
          {"largest error of the radius", e.max_bound, "an upper bound, by branch and bound"},
          {"largest error of the radius", e.predicted_max, predicted},
          {"largest distance of the surfaces", e.measured_max_distance, measured},
          {"largest distance of the surfaces", e.predicted_max_distance, predicted}};
}

std::string yes_or_no(bool yes) { return yes ? "yes" : "no"; }

// Returns a value of the model with its relative difference from the shape's value.
std::string beside(const std::optional<double>& model, const std::optional<double>& shape) {
  if (!model) return kNotKnown;
  std::string text = html::number(*model, 6);
  if (!shape || !(*shape != 0) || !std::isfinite(*model / *shape)) return text;
  const double difference = 100 * (*model / *shape - 1);
  const char* sign = difference < 0 ? "&#8722;" : "+";
  return two_lines(text, fmt::format("{}{}&nbsp;%", sign, html::number(std::abs(difference), 2)));
}

// Returns the exponent written after a unit.
std::string exponent(int power) {
  return power == 1   ? ""
         : power == 2 ? "&#178;"
         : power == 3 ? "&#179;"
                      : fmt::format("<sup>{}</sup>", power);
}

void add_measures(const Data& data, const std::string& unit, std::vector<Row>& rows) {
  SurfaceMeasures shape;
  if (data.shape) {
    const Inspection& found = data.shape->inspection;
    shape.area = found.area;
    if (found.closed && found.oriented) {
      shape.volume = found.volume;
      shape.centroid = found.volume_centroid;
    }
  }
  const auto row = [&](const std::string& name, const std::string& of_shape,
                       const std::string& of_model) {
    rows.push_back({{name, of_shape, of_model}});
  };
  const auto of_unit = [&](const std::string& name, int power) {
    return unit.empty() ? name
                        : fmt::format("{}, {}{}", name, html::escaped(unit), exponent(power));
  };
  for (const Descriptor& one : descriptors()) {
    if (one.length_power == 0) continue;  // the table has only figures with a unit
    const std::optional<double> known = one.value(shape);
    row(of_unit(one.name, one.length_power), known ? html::number(*known, 6) : kDash,
        data.model ? beside(one.value(*data.model), known) : kDash);
  }
  row(of_unit("centre of the solid (<i>x</i>, <i>y</i>, <i>z</i>)", 1),
      shape.centroid ? point_text(*shape.centroid, data.diagonal) : kDash,
      !data.model ? kDash
      : data.model->centroid
          ? point_text(*data.model->centroid, std::max(data.diagonal, data.mean_radius))
          : kNotKnown);
}

}  // namespace

std::string of_diagonal(const std::optional<double>& length, const Data& data) {
  return part_of(length, data.diagonal);
}

std::string point_text(const Vec3& p, double size) {
  // (The size of a huge shape may be infinite.)
  const int power =
      size > 0 && std::isfinite(size) ? static_cast<int>(std::floor(std::log10(size))) : 0;
  const auto coordinate = [&](double x) {
    // Six digits of the size determine the number of decimals.
    if (power >= -4 && power < 7) return html::decimal(x, std::max(0, 5 - power));
    return html::number(std::abs(x) < 1e-12 * size ? 0 : x, 6);
  };
  return fmt::format("{}<br>{}<br>{}", coordinate(p.x), coordinate(p.y), coordinate(p.z));
}

std::string rms_text(const DegreeRow& row, const std::string& unit, int digits) {
  if (!row.rms && row.rms_at_most) return kAtMost + html::length(row.rms_at_most, unit, 1);
  if (!row.rms) return kDash;
  return (row.rms_is_exact ? "" : "&#8776;&nbsp;") + html::length(row.rms, unit, digits);
}

std::string degree_table(const Expansion& expansion, const Data& data) {
  const std::string& unit = expansion.unit;
  Table table{.label = "Errors by degree",
              .columns = {{"degree <i>L</i>", true},
                          {"coefficients", true},
                          {"bytes", true},
                          {with_unit("rms error", unit), true},
                          {with_unit("largest error<br>of the radius", unit), true},
                          {with_unit("largest distance<br>of the surfaces", unit), true}},
              .rows = {}};
  for (const DegreeRow& row : data.rows) {
    table.rows.push_back(degree_row(row, data, row.degree == data.rows.back().degree));
  }
  return markup_of(table);
}

std::string error_table(const Expansion& expansion, const Data& data) {
  Table table{.label = "What is known of the error",
              .columns = {{"error", false},
                          {with_unit("value", expansion.unit), true},
                          {"how it is known", false}},
              .rows = {}};
  if (data.errors) {
    for (const Known& known : known_errors(*data.errors)) {
      if (!known.value) continue;
      table.rows.push_back({{known.what, length_cell(known.value, data), known.how}});
    }
  } else if (data.beyond.includes_tail()) {
    const bool gauge = expansion.function == RadialFunction::kGauge;
    const std::optional<double>& known = data.beyond.rms.back();
    table.columns[1].heading = gauge ? "value" : table.columns[1].heading;
    table.rows.push_back(
        {{gauge ? "rms of 1/<i>r</i>, over solid angle" : "rms of the radius, over solid angle",
          known ? html::number(*known) : kAtMost + html::number(*data.beyond.bound(), 1),
          data.beyond.is_exact(expansion.coefficients.degree())
              ? std::string("exact, by Parseval&#8217;s identity")
              : "by Parseval&#8217;s identity, as far as the precision of the coefficients " +
                    std::string(data.beyond.precision_is_assumed
                                    ? "allows; it is not known, and taken to be "
                                    : "allows, ") +
                    html::number(data.beyond.precision, 1)}});
  }
  return table.rows.empty() ? "" : markup_of(table);
}

std::string figure_table(const Expansion& expansion, const Data& data) {
  const std::string& unit = expansion.unit;
  Table table{.label = "Figures of shape and model",
              .columns = {{"figure", false}, {"shape", true}, {"model", true}},
              .rows = {}};
  std::vector<Row>& rows = table.rows;
  if (data.shape) {
    const Inspection& shape = data.shape->inspection;
    rows.push_back({{"vertices", html::count(shape.vertices), kDash}});
    rows.push_back({{"faces", html::count(shape.faces), kDash}});
  }
  if (data.diagonal > 0) {
    rows.push_back({{with_unit("diagonal <i>d</i> of the bounding box", unit),
                     html::number(data.diagonal, 6), kDash}});
  }
  add_measures(data, unit, rows);
  if (data.mean_radius != 0) {
    rows.push_back({{with_unit("mean radius, over solid angle", unit), kDash,
                     html::number(data.mean_radius, 6)}});
  }
  const std::string centre =
      point_text(expansion.center, std::max(data.diagonal, data.mean_radius));
  rows.push_back(
      {{with_unit("centre of the expansion (<i>x</i>, <i>y</i>, <i>z</i>)", unit), kDash, centre}});
  if (data.shape) {
    const StarReport& star = data.shape->star;
    rows.push_back({{"closed", yes_or_no(data.shape->inspection.closed), kDash}});
    rows.push_back({{"star-shaped from the centre", yes_or_no(data.shape->is_star()), kDash}});
    rows.push_back({{with_unit("min <i>d<sub>T</sub></i>: the nearest plane of a face", unit),
                     html::number(star.min_d, 6), kDash}});
    rows.push_back({{"min cos &#947;: the face seen most aslant",
                     html::number(star.min_cos_gamma, 4), kDash}});
  }
  return markup_of(table);
}

}  // namespace rholm::report
