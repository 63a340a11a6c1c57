// The axes are logarithmic, because the tail S / (pi l^4)
// of a polyhedron is then a straight line of slope -4.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "report/picture/utf8.h"
#include "rholm/render.h"
#include "rholm/rms_beyond.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Pixels of the whole plot and of its axes' rectangle.
constexpr double kWidth = 820, kHeight = 560;
constexpr double kLeft = 92, kRight = 796, kTop = 64, kBottom = 486;

// Rounding of a coefficient is about 2^-53 of the largest one. Energies below this part
// of the total (degree 0 included) therefore have no information about the surface.
constexpr double kFloor = 0x1p-106;

constexpr const char *kInk = "#222", *kGridInk = "#e3e3e3", *kFineInk = "#f3f3f3";
constexpr const char *kDataInk = "#1f5fa8", *kTailInk = "#c0532a";
constexpr const char *kBeyondInk = "#5b8c3a", *kToleranceInk = "#7a3fa0";

struct Axes {
  double x_min, x_max;  // log10 of the degree
  double y_min, y_max;  // log10 of the energy
  double x(double degree) const {
    return kLeft + (std::log10(degree) - x_min) / (x_max - x_min) * (kRight - kLeft);
  }
  double y(double log_energy) const {
    return kBottom - (log_energy - y_min) / (y_max - y_min) * (kBottom - kTop);
  }
};

// Drawn data of the spectrum: log10 of the energies of degrees 1 ... L.
struct Curve {
  std::vector<double> log_energy;
  std::vector<bool> clipped;  // true: the energy is zero or below the floor, log_energy is invalid
  double log_floor = 0;
  double log_strength = -kInfinity;  // log10(S / pi)
  // With a tolerance: log10 of its energy, and of the energy beyond degree l; empty if unknown.
  double log_tolerance = -kInfinity;
  std::vector<double> log_beyond;
  bool beyond_ends = false;  // true if log_beyond ends before the last degree
  bool empty = true;         // no degree above 0 has energy above the floor
};

Curve make_curve(const Expansion& expansion) {
  const std::vector<double> energy = power_spectrum(expansion.coefficients);
  double total = 0;
  for (const double e : energy) total += std::isfinite(e) ? e : 0;
  Curve curve;
  total = std::min(total, std::numeric_limits<double>::max());  // the sum may have overflowed
  curve.log_floor = total > 0 ? std::log10(total) + std::log10(kFloor) : 0;
  for (std::size_t l = 1; l < energy.size(); ++l) {
    const bool above =
        std::isfinite(energy[l]) && energy[l] > 0 && std::log10(energy[l]) >= curve.log_floor;
    curve.clipped.push_back(!above);
    curve.log_energy.push_back(above ? std::log10(energy[l]) : 0);
    curve.empty = curve.empty && !above;
  }
  const double strength = expansion.tail_strength.value_or(0);
  if (strength > 0 && std::isfinite(strength)) {
    curve.log_strength = std::log10(strength / std::numbers::pi);
  }
  return curve;
}

// The curve ends where the energy beyond is unknown.
void add_tolerance(const Expansion& expansion, double tolerance, Curve& curve) {
  curve.log_tolerance = std::log10(4 * std::numbers::pi) + 2 * std::log10(tolerance);
  const RmsBeyond beyond = rms_beyond(expansion);
  for (std::size_t l = 1; l < beyond.rms.size() && beyond.rms[l]; ++l) {
    curve.log_beyond.push_back(std::log10(4 * std::numbers::pi) + 2 * std::log10(*beyond.rms[l]));
  }
  curve.beyond_ends = !curve.log_beyond.empty() && !beyond.rms.back();
}

Axes make_axes(const Curve& curve) {
  const auto degrees = static_cast<double>(std::max<std::size_t>(curve.log_energy.size(), 2));
  Axes axes{0, std::log10(degrees), kInfinity, -kInfinity};
  for (std::size_t k = 0; k < curve.log_energy.size(); ++k) {
    if (curve.clipped[k]) continue;
    axes.y_min = std::min(axes.y_min, curve.log_energy[k]);
    axes.y_max = std::max(axes.y_max, curve.log_energy[k]);
  }
  if (curve.empty) axes.y_min = axes.y_max = curve.log_floor;
  for (const double y : curve.log_beyond) {
    axes.y_min = std::min(axes.y_min, y);
    axes.y_max = std::max(axes.y_max, y);
  }
  if (std::isfinite(curve.log_tolerance)) {
    axes.y_min = std::min(axes.y_min, curve.log_tolerance);
    axes.y_max = std::max(axes.y_max, curve.log_tolerance);
  }
  axes.y_min = std::floor(axes.y_min - 0.1);
  axes.y_max = std::ceil(axes.y_max + 0.1);
  return axes;
}

// Returns XML text: escapes markup, replaces control characters and bytes that are not UTF-8.
std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const char c = text[i];
    if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '&') {
      result += "&amp;";
    } else if (length == 0 || (length == 1 && (c < 0x20 || c == 0x7F))) {
      result += '?';
    } else {
      result += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string line(double x0, double y0, double x1, double y1, const char* color, double width) {
  return fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      x0, y0, x1, y1, color, width);
}

std::string text(double x, double y, const char* anchor, double size, std::string_view content) {
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\">{}</text>\n",
      x, y, anchor, size, kInk, content);
}

// Labels 1, 2, 5 times powers of ten, or 1 and 2 where crowded; fine lines at each digit.
std::string degree_axis(const Axes& axes) {
  std::string svg;
  const double top = std::pow(10.0, axes.x_max) * (1 + 1e-12);
  const bool crowded = axes.x_max > 3;
  for (double decade = 1; decade <= top; decade *= 10) {
    for (int digit = 1; digit <= 9 && digit * decade <= top; ++digit) {
      const bool named = digit == 1 || digit == 2 || (digit == 5 && !crowded);
      const double x = axes.x(digit * decade);
      svg += line(x, kTop, x, kBottom, named ? kGridInk : kFineInk, 1);
      if (named) svg += text(x, kBottom + 20, "middle", 14, fmt::format("{}", digit * decade));
    }
  }
  return svg + text((kLeft + kRight) / 2, kBottom + 46, "middle", 15, "degree l");
}

// Draws a line per power of ten, with at most about ten labels.
std::string energy_axis(const Axes& axes, const Expansion& expansion) {
  std::string svg;
  const int low = static_cast<int>(axes.y_min), high = static_cast<int>(axes.y_max);
  const int step = std::max(1, (high - low + 9) / 10);
  for (int power = low; power <= high; ++power) {
    const bool named = (power - low) % step == 0;
    const double y = axes.y(power);
    svg += line(kLeft, y, kRight, y, named ? kGridInk : kFineInk, 1);
    if (!named) continue;
    svg += text(kLeft - 10, y + 5, "end", 14,
                fmt::format("10<tspan dy=\"-6\" font-size=\"10\">{}</tspan>", power));
  }
  const double middle = (kTop + kBottom) / 2;
  std::string unit;  // squared, or its inverse squared
  if (!expansion.unit.empty()) {
    const bool gauge = expansion.function == RadialFunction::kGauge;
    unit = ", " + escaped(expansion.unit) + (gauge ? "&#8315;&#178;" : "&#178;");
  }
  svg += fmt::format(
      "<text x=\"26\" y=\"{0:.2f}\" text-anchor=\"middle\" font-size=\"15\" fill=\"{1}\" "
      "transform=\"rotate(-90 26 {0:.2f})\">energy per degree{2}</text>\n",
      middle, kInk, unit);
  return svg;
}

// Draws a line through the degrees above the floor, with dots if there are not
// too many. Degrees below the floor have open triangles at the lower edge.
std::string data(const Axes& axes, const Curve& curve) {
  constexpr std::size_t kDotted = 80;  // chosen: more dots would overlap
  std::string path, marks;
  for (std::size_t k = 0; k < curve.log_energy.size(); ++k) {
    const double x = axes.x(static_cast<double>(k + 1));
    if (curve.clipped[k]) {
      if (curve.log_energy.size() > kDotted) continue;
      marks += fmt::format("<path d=\"M{:.2f} {:.2f}h8l-4 7z\" fill=\"white\" stroke=\"{}\"/>\n",
                           x - 4, kBottom - 8, kDataInk);
      continue;
    }
    const double y = axes.y(curve.log_energy[k]);
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", x, y);
    if (curve.log_energy.size() > kDotted) continue;
    marks +=
        fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3\" fill=\"{}\"/>\n", x, y, kDataInk);
  }
  if (path.empty()) return marks;
  return fmt::format(
             "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" "
             "stroke-linejoin=\"round\"/>\n",
             path, kDataInk) +
         marks;
}

// Draws S / (pi l^4) between the ends of the axes.
std::string tail(const Axes& axes, const Curve& curve) {
  const auto at = [&](double log_degree) { return curve.log_strength - 4 * log_degree; };
  const double from = std::max(axes.x_min, (curve.log_strength - axes.y_max) / 4);
  const double to = std::min(axes.x_max, (curve.log_strength - axes.y_min) / 4);
  if (!(from < to)) return "";
  return fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
      "stroke-width=\"2\" stroke-dasharray=\"8 5\"/>\n",
      axes.x(std::pow(10.0, from)), axes.y(at(from)), axes.x(std::pow(10.0, to)), axes.y(at(to)),
      kTailInk);
}

std::string tolerance_lines(const Axes& axes, const Curve& curve) {
  if (!std::isfinite(curve.log_tolerance)) return "";
  std::string path;
  for (std::size_t k = 0; k < curve.log_beyond.size(); ++k) {
    path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L",
                        axes.x(static_cast<double>(k + 1)), axes.y(curve.log_beyond[k]));
  }
  std::string svg;
  if (!path.empty()) {
    svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", path,
                       kBeyondInk);
  }
  const double y = axes.y(curve.log_tolerance);
  return svg + line(kLeft, y, kRight, y, kToleranceInk, 2);
}

std::string legend_line(double y, const char* ink, const char* dashes) {
  return fmt::format(
      "<line x1=\"{0}\" y1=\"{1:.2f}\" x2=\"{2}\" y2=\"{1:.2f}\" stroke=\"{3}\" "
      "stroke-width=\"2\" stroke-dasharray=\"{4}\"/>\n",
      kLeft + 16, y, kLeft + 48, ink, dashes);
}

// Draws the legend in the lower left corner, which a falling spectrum leaves free.
std::string legend(const Curve& curve, RadialFunction function) {
  const auto clipped = std::count(curve.clipped.begin(), curve.clipped.end(), true);
  double y = kBottom - 30;
  std::string svg;
  const auto add = [&](const std::string& mark, const std::string& words) {
    svg += mark + text(kLeft + 58, y + 5, "start", 14, words);
    y -= 22;
  };
  if (clipped > 0) {
    add(fmt::format("<path d=\"M{} {:.2f}h8l-4 7z\" fill=\"white\" stroke=\"{}\"/>\n", kLeft + 28,
                    y - 3, kDataInk),
        fmt::format("{} of {} degrees: rounding only, below 10<tspan dy=\"-5\" "
                    "font-size=\"10\">{}</tspan>",
                    clipped, curve.clipped.size(), std::lround(std::ceil(curve.log_floor))));
  }
  if (std::isfinite(curve.log_strength)) {
    add(legend_line(y, kTailInk, "8 5"),
        "predicted tail S / (&#960; l<tspan dy=\"-5\" "
        "font-size=\"10\">4</tspan><tspan dy=\"5\">)</tspan>");
  }
  if (std::isfinite(curve.log_tolerance)) {
    add(legend_line(y, kToleranceInk, "none"), "wanted tolerance, 4&#960; E&#178;");
    if (!curve.log_beyond.empty()) {
      add(legend_line(y, kBeyondInk, "none"),
          curve.beyond_ends ? fmt::format("energy of all degrees beyond l, known to degree {}",
                                          curve.log_beyond.size())
                            : "energy of all degrees beyond l");
    }
  }
  add(legend_line(y, kDataInk, "none"),
      function == RadialFunction::kRadius  ? "energy of the radius r"
      : function == RadialFunction::kGauge ? "energy of the gauge 1/r"
                                           : "energy of the function");
  return svg;
}

}  // namespace

std::string spectrum_svg(const Expansion& expansion, const std::string& title,
                         std::optional<double> tolerance) {
  Curve curve = make_curve(expansion);
  if (tolerance && *tolerance > 0) add_tolerance(expansion, *tolerance, curve);
  const Axes axes = make_axes(curve);
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\">\n"
      "<title>{2}</title>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      kWidth, kHeight, escaped(title));
  svg += text((kLeft + kRight) / 2, 38, "middle", 18, escaped(title));
  svg += degree_axis(axes) + energy_axis(axes, expansion);
  svg += tail(axes, curve) + tolerance_lines(axes, curve) + data(axes, curve);
  svg += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n", kLeft,
      kTop, kRight - kLeft, kBottom - kTop);
  svg += curve.empty ? text((kLeft + kRight) / 2, (kTop + kBottom) / 2, "middle", 15,
                            "no degree above 0 has energy above rounding")
                     : legend(curve, expansion.function);
  return svg + "</svg>\n";
}

}  // namespace rholm
