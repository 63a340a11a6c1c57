// Pictures of a report, as PNG files in data: URIs.
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
  // The picture shows the shape itself, or the model at a degree.
  bool is_shape = false;
  int degree = 0;
};

struct ErrorMap {
  std::vector<Picture> sides;  // pictures from both sides; empty without a shape
  ColorScale scale;            // scale of distances to the shape, in its unit
  double largest = 0;          // largest distance at the vertices of the drawn surface
};

struct Pictures {
  std::vector<Picture> levels;  // degrees ascending, then the shape if it is there; at one scale
  std::vector<int> missing;     // degrees without a surface (a gauge that is negative)
  ErrorMap errors;
  int degree = 0;  // highest drawn degree
  // Number of vertices with r <= 0 at that degree, and the number of all vertices.
  std::size_t crossings = 0;
  std::size_t vertices = 0;
};

Pictures draw(const Expansion& expansion, const Data& data, const ReportOptions& options,
              const Context& context);

Panel panel_of(const Mesh& mesh, bool smooth);
// Draws panels side by side at one scale; returns one picture per panel.
std::vector<Picture> draw_row(const std::vector<Panel>& panels, int size, const Context& context);
// Draws a panel from one side, and from the opposite one.
std::vector<Picture> draw_sides(const Panel& panel, int size, std::optional<ColorScale> scale,
                                const Context& context);
// Draws a surface with normals nx, ny, nz, coloured by its distance to the shape.
ErrorMap draw_errors(const Mesh& surface, const Mesh& shape, int size, const Context& context);

// Cuts a picture of equally wide panels side by side into one picture per panel. Rows that
// are white in all panels are removed except for a margin, so scale and base line stay equal.
std::vector<Image> cut_apart(const Image& image, std::size_t panels);

}  // namespace rholm::report
