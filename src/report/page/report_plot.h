// Plots of a report as SVG elements inside the page, whose
// style sheet (report_markup.cpp) has their colours.
#pragma once

#include <string>
#include <vector>

#include "report/picture/color.h"

namespace rholm::report {

struct PlotPoint {
  double x = 0;
  double y = 0;
};

// Style of a series: a class of the style sheet. Styles
// differ in dashes and marks as well as in colour.
enum class Ink { kMeasured, kTail, kLargest, kDistance, kTolerance };
const char* class_of(Ink ink);

struct Series {
  std::string label;  // as markup
  Ink ink = Ink::kMeasured;
  // Points that are not positive are left out.
  std::vector<PlotPoint> points;
  bool marks = false;      // a mark at each point
  bool sets_range = true;  // true: the axes contain the whole series; false: it is clipped
};

struct Plot {
  std::string id;           // id in the page, letters only
  std::string title;        // text for screen readers
  std::string description;  // text for screen readers
  std::string y_label;      // as markup; the label of the x axis is "degree l"
  double x_max = 1;         // degrees 1 ... x_max
  std::vector<Series> series;
};

// Draws a plot with two logarithmic axes, where a tail S / (pi l^4) is a straight
// line. Returns an empty string if no series that sets the range has a point.
std::string log_log_plot(const Plot& plot);

// Returns the plot with its legend below, or an empty string in the same case.
std::string plot_figure(const Plot& plot);

// Returns the entries of the legend as a list.
std::string legend(const Plot& plot);

// Returns a bar with the colours of a scale and numbers below.
std::string color_bar(const ColorScale& scale, const std::string& title);

}  // namespace rholm::report
