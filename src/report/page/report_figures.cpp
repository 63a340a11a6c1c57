#include "report/page/report_figures.h"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/page/report_markup.h"
#include "report/page/report_plot.h"
#include "report/page/report_tables.h"

namespace rholm::report {
namespace {

// Returns the rms of a drawn degree, if the table has it or Parseval gives it.
std::string rms_caption(int degree, const Expansion& expansion, const Data& data) {
  const auto rms = [&]() -> std::optional<double> {
    for (const DegreeRow& row : data.rows) {
      if (row.degree == degree && row.rms) return row.rms;
    }
    if (expansion.function == RadialFunction::kGauge) return std::nullopt;
    return data.beyond.rms[static_cast<std::size_t>(degree)];
  }();
  if (!rms) return "";
  const std::string part = of_diagonal(rms, data);
  return fmt::format("<br><small>rms {}</small>",
                     part.empty() ? html::length(rms, expansion.unit, 3) : part);
}

std::string missing_note(const Pictures& pictures) {
  std::string list;
  for (const int degree : pictures.missing) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", degree);
  }
  if (list.empty()) return "";
  return fmt::format(
      "<p class=\"note\">There is no surface at degree {}: the series of 1/<i>r</i> is not "
      "positive "
      "in every direction.</p>\n",
      list);
}

std::string degrees_note(const Data& data, const Pictures& pictures) {
  std::string text = missing_note(pictures);
  const int own = data.rows.back().degree;
  if (own > pictures.degree) {
    text += fmt::format(
        "<p class=\"note\">The model has degree {}; waves above {} are finer than what a picture "
        "shows, and are not drawn.</p>\n",
        own, pictures.degree);
  }
  if (pictures.crossings > 0) {
    text += fmt::format(
        "<p class=\"note\">At {} of {} points of degree {} the radius is not positive: the surface "
        "crosses its centre there.</p>\n",
        html::count(pictures.crossings), html::count(pictures.vertices), pictures.degree);
  }
  return text;
}

Series energy_series(const Data& data, const Expansion& expansion) {
  Series series{.label = expansion.function == RadialFunction::kRadius
                             ? "energy of the radius <i>r</i>"
                             : "energy of 1/<i>r</i>",
                .ink = Ink::kMeasured,
                .points = {}};
  // Square of the default precision of coefficients. Energies below it are rounding,
  // usually of degrees that vanish by symmetry, and their lines would hide the others.
  constexpr double kLeastPart = 1e-8 * 1e-8;
  double whole = 0;
  std::size_t left_out = 0;
  for (std::size_t l = 1; l < data.energy.size(); ++l) whole += data.energy[l];
  for (std::size_t l = 1; l < data.energy.size(); ++l) {
    if (data.energy[l] > kLeastPart * whole) {
      series.points.push_back({static_cast<double>(l), data.energy[l]});
    } else {
      ++left_out;
    }
  }
  if (left_out > 0) {
    series.label += fmt::format(" ({} of {} degrees left out: below 10<sup>&#8722;16</sup> of all)",
                                left_out, data.energy.size() - 1);
  }
  series.marks = data.energy.size() <= 40;  // chosen: more marks would overlap
  return series;
}

// Samples a function of the degree at enough points for a smooth curve.
template <typename Function>
Series law(const std::string& label, Ink ink, double x_max, const Function& function) {
  constexpr int kPoints = 100;
  Series series{.label = label, .ink = ink, .points = {}, .sets_range = false};
  for (int k = 0; k <= kPoints; ++k) {
    const double l = std::pow(std::max(x_max, 2.0), static_cast<double>(k) / kPoints);
    series.points.push_back({l, function(l)});
  }
  return series;
}

std::string with_unit(const char* what, const Expansion& expansion, bool squared) {
  if (expansion.unit.empty()) return what;
  const bool gauge = expansion.function == RadialFunction::kGauge;
  return fmt::format("{}, {}{}{}", what, html::escaped(expansion.unit), gauge ? "&#8315;" : "",
                     squared ? "&#178;"
                     : gauge ? "&#185;"
                             : "");
}

Plot energy_plot(const Expansion& expansion, const Data& data, const ReportOptions& options) {
  const double x_max = expansion.coefficients.degree();
  Plot plot{.id = "energy",
            .title = "Energy per degree",
            .description =
                "On logarithmic axes: the measured energy of each degree, and what is "
                "predicted of it, over the degree",
            .y_label = with_unit("energy per degree", expansion, true),
            .x_max = x_max,
            .series = {energy_series(data, expansion)}};
  if (expansion.tail_strength.value_or(0) > 0) {
    const double strength = *expansion.tail_strength;
    plot.series.push_back(
        law("predicted tail <i>S</i> / (&#960; <i>l</i><sup>4</sup>)", Ink::kTail, x_max,
            [&](double l) { return strength / (std::numbers::pi * std::pow(l, 4)); }));
  }
  if (options.tolerance) {
    // With E_l ~ l^-4 the degrees above L hold L E_L / 3, which is 4 pi e^2 at the tolerance e.
    const double e = *options.tolerance;
    plot.series.push_back(law("where a tail begins that the tolerance allows", Ink::kTolerance,
                              x_max, [&](double l) { return 12 * std::numbers::pi * e * e / l; }));
  }
  return plot;
}

Series rms_series(const Data& data, const Expansion& expansion) {
  const bool gauge = expansion.function == RadialFunction::kGauge;
  const int own_degree = expansion.coefficients.degree();
  Series series{
      .label = fmt::format("rms of {}{}, over solid angle", gauge ? "1/<i>r</i>" : "<i>r</i>",
                           !data.beyond.includes_tail()       ? " within the model"
                           : data.beyond.is_exact(own_degree) ? ", exact"
                                                              : ""),
      .ink = Ink::kMeasured,
      .points = {}};
  for (std::size_t l = 1; l < data.rms.size(); ++l) {
    const std::optional<double>& rms = data.rms[l];
    if (rms && *rms > 0) series.points.push_back({static_cast<double>(l), *rms});
  }
  return series;
}

Series largest_series(const Data& data, const char* label, Ink ink,
                      std::optional<double> DegreeRow::*value) {
  Series series{.label = label, .ink = ink, .points = {}, .marks = true};
  for (const DegreeRow& row : data.rows) {
    if (row.*value) series.points.push_back({static_cast<double>(row.degree), *(row.*value)});
  }
  return series;
}

Plot error_plot(const Expansion& expansion, const Data& data, const ReportOptions& options) {
  const double x_max = expansion.coefficients.degree();
  Plot plot{.id = "errors",
            .title = "Error by degree",
            .description =
                "On logarithmic axes: the error that is left when the series is cut off "
                "at a degree, over that degree",
            .y_label = with_unit("error above the degree", expansion, false),
            .x_max = x_max,
            .series = {rms_series(data, expansion)}};
  if (expansion.function == RadialFunction::kRadius) {
    plot.series.push_back(
        largest_series(data, "largest error of <i>r</i>", Ink::kLargest, &DegreeRow::max));
    plot.series.push_back(largest_series(data, "largest distance of the surfaces", Ink::kDistance,
                                         &DegreeRow::max_distance));
  }
  if (expansion.tail_strength.value_or(0) > 0 && data.beyond.includes_tail()) {
    // The energy beyond l is about S / (3 pi (l + 1/2)^3), method 5.
    const double strength = *expansion.tail_strength;
    plot.series.push_back(law("predicted rms", Ink::kTail, x_max, [&](double l) {
      return std::sqrt(strength / (3 * std::numbers::pi * std::pow(l + 0.5, 3)) /
                       (4 * std::numbers::pi));
    }));
  }
  if (options.tolerance) {
    plot.series.push_back(
        law("tolerance (rms)", Ink::kTolerance, x_max, [&](double) { return *options.tolerance; }));
  }
  return plot;
}

std::string map_caption(const Expansion& expansion, const Data& data, const ReportOptions& options,
                        const Pictures& pictures) {
  const double largest = pictures.errors.largest;
  const std::string part = of_diagonal(largest, data);
  std::string text =
      fmt::format("Distance from the model at degree {} to the closest point of {}{}.",
                  pictures.errors.sides.front().degree, name_of_shape(options),
                  expansion.unit.empty() ? "" : ", in " + html::escaped(expansion.unit));
  if (largest > pictures.errors.scale.max) {
    text += " One point in 500 is farther and has the last colour.";
  }
  text += fmt::format(" The largest at the {} vertices of this picture is {}{}.",
                      html::count(pictures.vertices), html::length(largest, expansion.unit, 3),
                      part.empty() ? "" : " (" + part + ")");
  // Without this sentence, three figures called "the largest" seem to contradict each other.
  return text +
         " Errors of <i>r</i> go along rays instead; those of the tables are from more points.";
}

}  // namespace

std::string levels_section(const Expansion& expansion, const Data& data,
                           const ReportOptions& options, const Pictures& pictures) {
  std::string html =
      fmt::format("<section>\n<h2>Shape and model</h2>\n<div class=\"pictures n{}\">\n",
                  pictures.levels.size());
  for (const Picture& picture : pictures.levels) {
    if (picture.is_shape) {
      html += figure_of(picture, "Picture of the shape " + options.shape_name,
                        "the shape<br><small>" + html::escaped(options.shape_name) + "</small>");
      continue;
    }
    html += figure_of(
        picture, fmt::format("Picture of the model at degree {}", picture.degree),
        fmt::format("degree {}", picture.degree) + rms_caption(picture.degree, expansion, data));
  }
  html += "</div>\n" + degrees_note(data, pictures);
  return html + "</section>\n";
}

std::string error_map_section(const Expansion& expansion, const Data& data,
                              const ReportOptions& options, const Pictures& pictures) {
  if (pictures.errors.sides.empty()) return "";
  const int degree = pictures.errors.sides.front().degree;
  return section("Where the model differs",
                 error_map(pictures.errors, fmt::format("the model at degree {}", degree),
                           map_caption(expansion, data, options, pictures), expansion.unit));
}

std::string spectrum_section(const Expansion& expansion, const Data& data,
                             const ReportOptions& options) {
  const std::string plots = plot_figure(energy_plot(expansion, data, options)) +
                            plot_figure(error_plot(expansion, data, options));
  std::string html = "<section>\n<h2>Spectrum</h2>\n";
  html += plots.empty() ? "<p>No degree above 0 has energy above rounding.</p>\n"
                        : "<div class=\"plots\">\n" + plots + "</div>\n";
  html +=
      "<p class=\"note\">The energy of a degree is the sum of its squared orthonormal "
      "coefficients. "
      "The error above a degree is what is missing when the series ends there.";
  if (expansion.tail_strength) {
    html +=
        " The predicted tail <i>S</i> / (&#960;&#8239;<i>l</i><sup>4</sup>) is that of the edges "
        "of "
        "the mesh: the spectrum meets it at degrees that are finer than the mesh.";
  }
  html += "</p>\n";
  return html + "</section>\n";
}

}  // namespace rholm::report
