// The pictures of a report, as PNG files in data: URIs.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/page/report_data.h"
#include "report/picture/color.h"
#include "rholm/image.h"
#include "rholm/render.h"

namespace rholm::report {

struct Picture {
  std::string uri;
  int width = 0;
  int height = 0;
  // What it shows: the shape itself, or the model at a degree.
  bool is_shape = false;
  int degree = 0;
};

struct ErrorMap {
  std::vector<Picture> sides;  // from one side, and from the opposite one; empty without a shape
  ColorScale scale;            // of distances to the shape, in its unit
  double largest = 0;          // at the vertices of the drawn surface
};

struct Pictures {
  std::vector<Picture> levels;  // degrees ascending, then the shape if it is there; at one scale
  std::vector<int> missing;     // degrees at which there is no surface (a gauge that is negative)
  ErrorMap errors;
  int degree = 0;  // the highest that was drawn
  // Vertices of the surface of that degree with r <= 0, and all of them.
  std::size_t crossings = 0;
  std::size_t vertices = 0;
};

Pictures draw(const Expansion& expansion, const Data& data, const ReportOptions& options,
              const Context& context);

Panel panel_of(const Mesh& mesh, bool smooth);
// Panels side by side at one scale, a picture for each.
std::vector<Picture> draw_row(const std::vector<Panel>& panels, int size, const Context& context);
// A panel from one side, and from the opposite one.
std::vector<Picture> draw_sides(const Panel& panel, int size, std::optional<ColorScale> scale,
                                const Context& context);
// A surface coloured by its distance to the shape, with normals nx, ny, nz.
ErrorMap draw_errors(const Mesh& surface, const Mesh& shape, int size, const Context& context);

// A picture of panels of the same width side by side, cut into one for each. Rows that are white in
// all of them are cut away but for a margin, so that they keep one scale and one base line.
std::vector<Image> cut_apart(const Image& image, std::size_t panels);

}  // namespace rholm::report
