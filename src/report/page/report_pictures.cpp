#include "report/page/report_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "report/page/html.h"
#include "report/picture/render_views.h"
#include "rholm/compare.h"
#include "rholm/error.h"
#include "rholm/file.h"
#include "rholm/primitives.h"
#include "rholm/render.h"

namespace rholm::report {
namespace {

// Returns the subdivisions of the smallest icosphere with 16 vertices per coefficient. Its edges h
// cut off 1/9 of the height of the shortest wave: (h L)^2 / 8 with h^2 = 8 pi / (sqrt 3 16 L^2).
// Coarser spheres would show facets; more than 8 subdivisions (655 362 vertices) have several
// vertices per pixel.
int subdivisions_for(int degree) {
  int n = 5;
  while (n < 8 && 10.0 * (1 << (2 * n)) + 2 < 16 * (degree + 1.0) * (degree + 1.0)) ++n;
  return n;
}

// Returns a sixteenth, a quarter and all of the degree; each step is visible.
std::vector<int> drawn_degrees(int degree) {
  std::vector<int> degrees;
  for (const int part : {16, 4, 1}) {
    const int l = degree / part;
    if (part == 1 || (l > 0 && (degrees.empty() || l > degrees.back()))) degrees.push_back(l);
  }
  return degrees;
}

// Surface of the model at a degree; degrees without a surface are listed as missing.
struct Level {
  int degree;
  Mesh mesh;
};
std::vector<Level> make_levels(const Expansion& expansion, const Mesh& sphere, Pictures& pictures,
                               const Context& context) {
  const int finest = subdivisions_for(pictures.degree);
  std::vector<Level> levels;
  for (const int degree : drawn_degrees(pictures.degree)) {
    try {
      report_progress(context, "surfaces", 0);
      const int n = subdivisions_for(degree);
      levels.push_back({degree, synthesize(cut_off(expansion, degree),
                                           n < finest ? icosphere(n) : sphere, context)});
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kInvalidInput || degree == pictures.degree) throw;
      pictures.missing.push_back(degree);
    }
  }
  return levels;
}

void count_crossings(const Mesh& surface, const Mesh& sphere, const Vec3& center,
                     Pictures& pictures) {
  pictures.vertices = surface.vertices.size();
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    pictures.crossings += dot(surface.vertices[i] - center, sphere.vertices[i]) <= 0;
  }
}

std::vector<Picture> draw_levels(const std::vector<Level>& levels, const Mesh* shape, int size,
                                 const Context& context) {
  std::vector<Panel> panels;
  panels.reserve(levels.size() + 1);
  for (const Level& level : levels) panels.push_back(panel_of(level.mesh, true));
  if (shape != nullptr) panels.push_back(panel_of(*shape, false));
  std::vector<Picture> pictures = draw_row(panels, size, context);
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    pictures[k].is_shape = k == levels.size();
    if (k < levels.size()) pictures[k].degree = levels[k].degree;
  }
  return pictures;
}

Picture picture_of(const Image& image) {
  Picture picture;
  picture.uri = "data:image/png;base64," + html::base64(encode_png(image));
  picture.width = image.width;
  picture.height = image.height;
  return picture;
}

std::vector<Picture> pictures_of(const std::vector<Image>& images, const Context& context) {
  std::vector<Picture> pictures(images.size());
  parallel_for(images.size(), 1, context, {"render", 1, 1},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k) pictures[k] = picture_of(images[k]);
               });
  return pictures;
}

RenderOptions picture_options() {
  RenderOptions options;
  options.samples = 2;  // chosen: the pictures are shown at half their size
  options.scale_bar = false;
  return options;
}

// Some points at sharp vertices have errors many times larger than all others, which would have
// one colour. The scale ends where one point in 500 is beyond, unless that is nearly the largest.
double scale_end(std::vector<double> distances, double largest) {
  if (!(largest > 0)) return 1;
  const std::size_t beyond = distances.size() / 500;
  const auto end = distances.end() - static_cast<std::ptrdiff_t>(beyond + 1);
  std::nth_element(distances.begin(), end, distances.end());
  return 1.25 * *end<largest&& * end> 0 ? *end : largest;
}

bool is_white(const std::uint8_t* row, std::size_t bytes) {
  return std::all_of(row, row + bytes, [](std::uint8_t byte) { return byte == 255; });
}

}  // namespace

Panel panel_of(const Mesh& mesh, bool smooth) {
  return {.mesh = &mesh, .label = {}, .scalars = {}, .smooth = smooth};
}

std::vector<Picture> draw_row(const std::vector<Panel>& panels, int size, const Context& context) {
  RenderOptions options = picture_options();
  options.width = static_cast<int>(panels.size()) * size;
  options.height = size;
  const Image image = render(panels, options, context);
  return pictures_of(cut_apart(image, panels.size()), context);
}

std::vector<Picture> draw_sides(const Panel& panel, int size, std::optional<ColorScale> scale,
                                const Context& context) {
  RenderOptions options = picture_options();
  options.width = options.height = size;
  if (scale) {
    options.scale_min = scale->min;
    options.scale_max = scale->max;
  }
  const std::array<Vec3, 2> directions = {options.view, -options.view};
  std::vector<Image> sides = render_views({&panel, 1}, options, directions, context);
  for (Image& side : sides) side = cut_apart(side, 1).front();
  return pictures_of(sides, context);
}

ErrorMap draw_errors(const Mesh& surface, const Mesh& shape, int size, const Context& context) {
  ErrorMap map;
  Panel panel = panel_of(surface, true);
  panel.scalars = distances_to_surface(surface.vertices, shape, context);
  map.largest = *std::max_element(panel.scalars.begin(), panel.scalars.end());
  map.scale = {0, scale_end(panel.scalars, map.largest)};
  map.sides = draw_sides(panel, size, map.scale, context);
  return map;
}

std::vector<Image> cut_apart(const Image& image, std::size_t panels) {
  const std::size_t row = 3 * static_cast<std::size_t>(image.width), width = row / panels;
  const auto rows = static_cast<std::size_t>(image.height);
  std::size_t top = 0, bottom = rows;
  while (top < bottom && is_white(&image.rgb[top * row], row)) ++top;
  while (bottom > top && is_white(&image.rgb[(bottom - 1) * row], row)) --bottom;
  const std::size_t margin = rows / 25;  // same margin as render() has at the sides
  top = top > margin ? top - margin : 0;
  bottom = std::min(rows, bottom + margin);
  std::vector<Image> parts(panels);
  for (std::size_t k = 0; k < panels; ++k) {
    parts[k].width = static_cast<int>(width / 3);
    parts[k].height = static_cast<int>(bottom - top);
    for (std::size_t y = top; y < bottom; ++y) {
      const auto from = image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row + k * width);
      parts[k].rgb.insert(parts[k].rgb.end(), from, from + static_cast<std::ptrdiff_t>(width));
    }
  }
  return parts;
}

Pictures draw(const Expansion& expansion, const Data& data, const ReportOptions& options,
              const Context& context) {
  Pictures pictures;
  pictures.degree = std::min(expansion.coefficients.degree(), kHighestDrawn);
  const Mesh sphere = icosphere(subdivisions_for(pictures.degree));
  const std::vector<Level> levels = make_levels(expansion, sphere, pictures, context);
  const Mesh* shape = data.shape ? &data.shape->mesh : nullptr;
  count_crossings(levels.back().mesh, sphere, expansion.center, pictures);
  pictures.levels = draw_levels(levels, shape, options.picture_size, context);
  if (shape != nullptr) {
    pictures.errors = draw_errors(levels.back().mesh, *shape, options.picture_size, context);
    for (Picture& side : pictures.errors.sides) side.degree = pictures.degree;
  }
  return pictures;
}

}  // namespace rholm::report
