#include "report/page/report_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "report/page/html.h"
#include "report/picture/scale_bar.h"

namespace rholm::report {
namespace {

// Units of the drawing. Chosen: letters of 16 units are 16 pixels on a screen of
// 1280, where the plot is about as wide as here, and 11 pixels on a telephone of 400.
constexpr double kWidth = 540, kHeight = 400;
constexpr double kLeft = 62, kRight = 528, kTop = 34, kBottom = 346;
constexpr double kClosest = 0.7;  // points of a line nearer to each other are left out

struct Axes {
  double x_max = 1;             // log10; the axis begins at degree 1
  double y_min = 0, y_max = 1;  // log10, whole numbers

  double x(double value) const { return kLeft + std::log10(value) / x_max * (kRight - kLeft); }
  double y(double value) const { return y_of_power(std::log10(value)); }
  // Returns the position of 10^power, which may exceed the range of doubles.
  double y_of_power(double power) const {
    return kBottom - (power - y_min) / (y_max - y_min) * (kBottom - kTop);
  }
};

bool is_drawn(const PlotPoint& p) {
  return p.x >= 1 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

Axes make_axes(const Plot& plot) {
  double min = std::numeric_limits<double>::infinity(), max = 0;
  for (const Series& series : plot.series) {
    if (!series.sets_range) continue;
    for (const PlotPoint& point : series.points) {
      if (!is_drawn(point)) continue;
      min = std::min(min, point.y);
      max = std::max(max, point.y);
    }
  }
  Axes axes{std::log10(std::max(plot.x_max, 2.0)), 0, 0};
  if (max > 0) {
    axes.y_min = std::floor(std::log10(min) - 0.05);
    axes.y_max = std::ceil(std::log10(max) + 0.05);
  }
  return axes;
}

std::string line(double x0, double y0, double x1, double y1, const char* style) {
  return fmt::format(
      "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style, x0,
      y0, x1, y1);
}

std::string text(double x, double y, const char* anchor, const std::string& markup) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     markup);
}

// Labels 1, 2, 5 times powers of ten if there is room, otherwise only powers.
std::string degree_axis(const Axes& axes) {
  std::string svg;
  const double last = std::pow(10.0, axes.x_max) * (1 + 1e-12);
  for (double decade = 1; decade <= last; decade *= 10) {
    for (int digit = 1; digit <= 9 && digit * decade <= last; ++digit) {
      const bool named = digit == 1 || ((digit == 2 || digit == 5) && axes.x_max < 3.2);
      const double x = axes.x(digit * decade);
      svg += line(x, kTop, x, kBottom, named ? "grid" : "fine");
      if (named) svg += text(x, kBottom + 22, "middle", fmt::format("{}", digit * decade));
    }
  }
  return svg + text((kLeft + kRight) / 2, kBottom + 46, "middle",
                    "degree <tspan "
                    "class=\"it\">l</tspan>");
}

// Draws a line per power of ten, with at most about eight labels.
std::string value_axis(const Axes& axes, const std::string& label) {
  std::string svg;
  const int low = static_cast<int>(axes.y_min), high = static_cast<int>(axes.y_max);
  const int step = std::max(1, (high - low + 7) / 8);
  for (int power = low; power <= high; ++power) {
    const double y = axes.y_of_power(power);
    const bool named = (power - low) % step == 0;
    svg += line(kLeft, y, kRight, y, named ? "grid" : "fine");
    if (!named) continue;
    svg += text(kLeft - 9, y + 5, "end",
                fmt::format("10<tspan class=\"sup\" dy=\"-6\">{}{}</tspan>",
                            power < 0 ? "&#8722;" : "", std::abs(power)));
  }
  return svg + text(2, 16, "start", label);
}

// Returns a round, square or triangular mark, so that marks differ without colour.
std::string mark(Ink ink, double x, double y) {
  switch (ink) {
    case Ink::kLargest:
      return fmt::format(
          "<rect class=\"mark {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" "
          "height=\"8\"/>\n",
          class_of(ink), x - 4, y - 4);
    case Ink::kDistance:
      return fmt::format("<path class=\"mark {}\" d=\"M{:.1f} {:.1f}l5 9h-10z\"/>\n", class_of(ink),
                         x, y - 6);
    default:
      return fmt::format("<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>\n",
                         class_of(ink), x, y);
  }
}

std::string curve(const Axes& axes, const Series& series) {
  std::string path, marks;
  double last_x = -kWidth;
  for (std::size_t k = 0; k < series.points.size(); ++k) {
    const PlotPoint& point = series.points[k];
    if (!is_drawn(point)) continue;
    const double x = axes.x(point.x), y = axes.y(point.y);
    if (x - last_x < kClosest && k + 1 < series.points.size()) continue;
    last_x = x;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    if (series.marks) marks += mark(series.ink, x, y);
  }
  return fmt::format("<path class=\"line {}\" d=\"{}\"/>\n", class_of(series.ink), path) + marks;
}

bool has_points(const Series& series) {
  return std::any_of(series.points.begin(), series.points.end(), is_drawn);
}

std::string color_text(const Color& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", to_srgb_byte(color.r), to_srgb_byte(color.g),
                     to_srgb_byte(color.b));
}

}  // namespace

const char* class_of(Ink ink) {
  constexpr const char* kNames[] = {"measured", "tail", "largest", "distance", "tolerance"};
  return kNames[static_cast<int>(ink)];
}

std::string log_log_plot(const Plot& plot) {
  const bool empty = std::none_of(plot.series.begin(), plot.series.end(),
                                  [](const Series& s) { return s.sets_range && has_points(s); });
  if (empty) return "";
  const Axes axes = make_axes(plot);
  std::string svg = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {0} {1}\" role=\"img\" aria-labelledby=\"{2}-t {2}-d\">\n"
      "<title id=\"{2}-t\">{3}</title>\n<desc id=\"{2}-d\">{4}</desc>\n"
      "<clipPath id=\"{2}-c\"><rect x=\"{5}\" y=\"{6}\" width=\"{7}\" "
      "height=\"{8}\"/></clipPath>\n",
      kWidth, kHeight, plot.id, html::escaped(plot.title), html::escaped(plot.description), kLeft,
      kTop, kRight - kLeft, kBottom - kTop);
  svg += degree_axis(axes) + value_axis(axes, plot.y_label);
  for (const Series& series : plot.series) {
    if (!has_points(series)) continue;
    // Marks at the edge of the axes may protrude; lines that leave the axes are clipped.
    svg += series.sets_range ? curve(axes, series)
                             : fmt::format("<g clip-path=\"url(#{}-c)\">\n{}</g>\n", plot.id,
                                           curve(axes, series));
  }
  svg +=
      fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n</svg>\n",
                  kLeft, kTop, kRight - kLeft, kBottom - kTop);
  return svg;
}

std::string legend(const Plot& plot) {
  std::string list;
  for (const Series& series : plot.series) {
    if (!has_points(series)) continue;
    list += fmt::format(
        "<li><svg class=\"key\" viewBox=\"0 0 36 14\" aria-hidden=\"true\"><path class=\"line {}\" "
        "d=\"M1 7H35\"/>{}</svg><span>{}</span></li>\n",
        class_of(series.ink), series.marks ? mark(series.ink, 18, 7) : "", series.label);
  }
  return list.empty() ? "" : "<ul class=\"legend\">\n" + list + "</ul>\n";
}

std::string plot_figure(const Plot& plot) {
  const std::string svg = log_log_plot(plot);
  if (svg.empty()) return "";
  return "<figure>\n" + svg + "<figcaption>" + legend(plot) + "</figcaption>\n</figure>\n";
}

std::string color_bar(const ColorScale& scale, const std::string& title) {
  constexpr int kStops = 24;  // chosen: the straight lines between them are not visible
  constexpr double kFrom = 20, kTo = 520, kBar = 16;
  std::string stops, ticks;
  for (int k = 0; k <= kStops; ++k) {
    const double t = static_cast<double>(k) / kStops;
    stops += fmt::format("<stop offset=\"{:.4f}\" stop-color=\"{}\"/>", t,
                         color_text(scale.color((1 - t) * scale.min + t * scale.max)));
  }
  const Ticks marks = make_ticks(scale.min, scale.max, 5);
  for (std::size_t k = 0; k < marks.values.size(); ++k) {
    const double part = (marks.values[k] - scale.min) / (scale.max - scale.min);
    const double x = kFrom + part * (kTo - kFrom);
    ticks += line(x, kBar, x, kBar + 6, "tick");
    ticks += text(x, kBar + 24, "middle", html::escaped(marks.labels[k]));
  }
  return fmt::format(
      "<svg class=\"bar\" viewBox=\"0 0 {0} 48\" role=\"img\" aria-label=\"{1}\">\n"
      "<linearGradient id=\"colors\">{2}</linearGradient>\n"
      "<rect x=\"{3}\" y=\"0\" width=\"{4}\" height=\"{5}\" fill=\"url(#colors)\"/>\n{6}</svg>\n",
      kWidth, html::escaped(title), stops, kFrom, kTo - kFrom, kBar, ticks);
}

}  // namespace rholm::report
