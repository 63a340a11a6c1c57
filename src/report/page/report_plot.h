// Plots of a report as SVG elements inside of the page, which has their colours
// (report_markup.cpp).
#pragma once

#include <string>
#include <vector>

#include "report/picture/color.h"

namespace rholm::report {

struct PlotPoint {
  double x = 0;
  double y = 0;
};

// How a series is drawn: a class of the style sheet. They differ in dashes and marks as well as in
// colour.
enum class Ink { kMeasured, kTail, kLargest, kDistance, kTolerance };
const char* class_of(Ink ink);

struct Series {
  std::string label;  // markup
  Ink ink = Ink::kMeasured;
  // Points that are not positive are left out.
  std::vector<PlotPoint> points;
  bool marks = false;      // a mark at each point
  bool sets_range = true;  // the axes hold all of it; else it ends where they end
};

struct Plot {
  std::string id;           // of the page, letters only
  std::string title;        // for those who do not see it; text
  std::string description;  // likewise
  std::string y_label;      // markup; that of the x axis is "degree l"
  double x_max = 1;         // degrees 1 ... x_max
  std::vector<Series> series;
};

// On two logarithmic axes, on which a tail S / (pi l^4) is a straight line. Empty if no series that
// sets the range has a point.
std::string log_log_plot(const Plot& plot);

// The same with its legend below; empty as well.
std::string plot_figure(const Plot& plot);

// The entries of the legend, as a list.
std::string legend(const Plot& plot);

// The colours of a scale with numbers below.
std::string color_bar(const ColorScale& scale, const std::string& title);

}  // namespace rholm::report
