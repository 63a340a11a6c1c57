#include "rholm/render.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/check_fields.h"
#include "base/parallel.h"
#include "base/refuse.h"
#include "report/picture/canvas.h"
#include "report/picture/render_views.h"
#include "report/picture/scale_bar.h"
#include "report/picture/shade.h"
#include "report/picture/shared_light.h"
#include "report/picture/view.h"
#include "rholm/context.h"
#include "rholm/topology.h"
#include "rholm/vec3.h"
#include "shape/face.h"
#include "shape/points/point_tree.h"

namespace rholm {
namespace {

// Size of drawn points.

constexpr std::size_t kProbes = 1000;  // sampled points; the median is accurate to some 2 %
constexpr std::size_t kNeighbors = 8;  // neighbours per point, as on a square grid

// Share of the diagonal, so that a small number of points stay points. Chosen by eye.
constexpr double kLargest = 0.03;

// Returns the typical distance of neighbours, as on a square grid, with the same bits for any
// number of threads. At least one point is needed; points are of the order of 1 about the origin.
double ball_radius(const std::vector<Vec3>& points, const Context& context) {
  const double diagonal = bounds(points).diagonal();
  const double largest = diagonal > 0 ? kLargest * diagonal : kLargest;
  if (points.size() < 2) return largest;
  const PointTree tree(points, context);
  const std::size_t n = tree.size(), probes = std::min(n, kProbes);
  const std::size_t k = std::min(kNeighbors, n - 1);
  std::vector<double> distances;
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < probes; ++i) {
    tree.nearest_to(i * n / probes, k + 1, near);  // includes the point itself
    distances.push_back(std::sqrt(static_cast<double>(near.back().distance2)));
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(probes / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  // k points within a disc of this radius have pi r^2 / k each, the square of their distance.
  // Balls of this radius leave exp(-pi), 4 %, of a surface uncovered by random points.
  const double spacing = *middle * std::sqrt(std::numbers::pi / static_cast<double>(k));
  return spacing > 0 ? std::min(spacing, largest) : largest;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMost = std::numeric_limits<double>::max();
// Least ball radius as a share of a shape's size: some ten roundings
// of the ray tracer's floats, a hundredth of the finest pixel.
constexpr double kSmallestBall = 1e-6;
const Color kPaper = {1, 1, 1};
const Color kInk = {0.03f, 0.03f, 0.035f};

// Returns the vertices or the points.
const std::vector<Vec3>& places(const Panel& panel) {
  return panel.points != nullptr ? panel.points->points : panel.mesh->vertices;
}

void check_shape(const Panel& panel) {
  if (panel.points == nullptr) {
    if (panel.mesh == nullptr || panel.mesh->faces.empty()) {
      refuse("a panel needs a mesh with at least 1 face, or points");
    }
    return validate(*panel.mesh);
  }
  if (panel.mesh != nullptr) refuse("a panel has a mesh and points; give one of them");
  const std::size_t n = panel.points->points.size();
  if (n < 1 || n > kMaxPointsInPicture) {
    refuse("a panel has " + std::to_string(n) + " points; it needs 1 ... " +
           std::to_string(kMaxPointsInPicture) + ": leave some out");
  }
  validate(*panel.points);
  if (!(panel.point_radius >= 0) || !std::isfinite(panel.point_radius)) {
    refuse("the radius of a panel's points is " + std::to_string(panel.point_radius) +
           "; it must be a finite number, at least 0");
  }
}

void check_values(const Panel& panel) {
  const std::size_t n = places(panel).size();
  const auto count = [&](std::size_t given, const char* what) {
    if (given == 0 || given == n) return;
    refuse("a panel has " + std::to_string(given) + what + std::to_string(n) +
           (panel.points != nullptr ? " points" : " vertices"));
  };
  count(panel.colors.size(), " colours for ");
  count(panel.scalars.size(), " scalars for ");
  const auto finite = [](double s) { return std::isfinite(s); };
  if (!std::all_of(panel.scalars.begin(), panel.scalars.end(), finite)) {
    refuse("a panel has a scalar that is not a finite number");
  }
}

void check(std::span<const Panel> panels, const RenderOptions& options) {
  check_fields(options);
  if (panels.empty()) refuse("a picture needs at least 1 panel");
  if (panels.size() > static_cast<std::size_t>(options.width) / 16) {
    refuse(std::to_string(panels.size()) + " panels do not fit into a width of " +
           std::to_string(options.width) + " pixels; each needs at least 16");
  }
  for (const Panel& panel : panels) {
    check_shape(panel);
    check_values(panel);
  }
}

// Returns the requested range, or the range of all scalars. An empty range is
// widened at an end that was not requested. Returns nullopt without scalars.
std::optional<ColorScale> color_scale(std::span<const Panel> panels, const RenderOptions& options) {
  double min = kInfinity, max = -kInfinity;
  for (const Panel& panel : panels) {
    for (const double s : panel.scalars) {
      min = std::min(min, s);
      max = std::max(max, s);
    }
  }
  if (min > max) return std::nullopt;
  ColorScale scale = {options.scale_min.value_or(min), options.scale_max.value_or(max)};
  if (scale.min == scale.max) {
    const double margin = scale.min == 0 ? 1 : std::abs(scale.min) / 2;
    if (!options.scale_min) scale.min = std::min(scale.max - (options.scale_max ? margin : 0), 0.0);
    if (!options.scale_max) scale.max += margin;
  }
  if (!(scale.min < scale.max) || !std::isfinite(scale.max - scale.min)) {
    refuse("the colour scale runs from " + std::to_string(scale.min) + " to " +
           std::to_string(scale.max) + "; its lower end must be below the upper one");
  }
  return scale;
}

// Returns one scale for all panels, a power of two, so that rounding
// does not depend on the unit. Each panel is moved to its own middle.
double common_scale(std::span<const Panel> panels) {
  Vec3 largest;
  for (const Panel& panel : panels) {
    const Bounds box = bounds(places(panel));
    const double margin = panel.points != nullptr ? panel.point_radius : 0;
    const Vec3 half = 0.5 * box.max - 0.5 * box.min;
    const auto larger = [&](double a, double b) {
      return std::min(std::max(a, b + margin), kMost);
    };
    largest = {larger(largest.x, half.x), larger(largest.y, half.y), larger(largest.z, half.z)};
  }
  return unit_frame({-largest, largest}).scale;
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  const Attribute* x = find_attribute(mesh.attributes, "nx");
  const Attribute* y = find_attribute(mesh.attributes, "ny");
  const Attribute* z = find_attribute(mesh.attributes, "nz");
  std::vector<Vec3> normals;
  if (x == nullptr || y == nullptr || z == nullptr) return normals;
  normals.reserve(mesh.vertices.size());
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    const Vec3 normal = normalized({x->values[k], y->values[k], z->values[k]});
    normals.push_back(is_finite(normal) ? normal : Vec3{});
  }
  return normals;
}

Subject make_subject(const Panel& panel, double scale, const Context& context) {
  Subject subject;
  subject.mesh.vertices = places(panel);
  if (panel.mesh != nullptr) subject.mesh.faces = panel.mesh->faces;
  const Bounds box = bounds(subject.mesh.vertices);
  const UnitFrame frame = {scale * (0.5 * box.min) + scale * (0.5 * box.max), scale};
  for (Vec3& vertex : subject.mesh.vertices) {
    vertex = frame.to_local(vertex);
    subject.radius = std::max(subject.radius, norm(vertex));
  }
  if (panel.points != nullptr) {
    const double radius = panel.point_radius > 0 ? scale * panel.point_radius
                                                 : ball_radius(subject.mesh.vertices, context);
    subject.ball_radius = std::max(radius, kSmallestBall);
    subject.radius += subject.ball_radius;
  }
  if (panel.mesh != nullptr && panel.smooth) subject.normals = vertex_normals(*panel.mesh);
  if (!panel.scalars.empty()) subject.scalars = &panel.scalars;
  for (const std::array<float, 3>& c : panel.colors) {
    subject.colors.push_back({from_srgb(c[0]), from_srgb(c[1]), from_srgb(c[2])});
  }
  return subject;
}

// Positions in the picture, in pixels.
struct Layout {
  double panel_width = 0;
  double panel_height = 0;
  double text_size = 0;
  double label_baseline = 0;
  double bar_top = 0;
};

Layout make_layout(std::span<const Panel> panels, const RenderOptions& options, bool bar) {
  Layout layout;
  const double width = options.width, height = options.height;
  layout.panel_width = width / static_cast<double>(panels.size());
  double size = 0.024 * std::min(height, width);  // chosen: readable in the column of a README
  bool labels = false;
  for (const Panel& panel : panels) {
    labels = labels || !panel.label.empty();
    size = std::min(size, 0.9 * layout.panel_width / std::max(1.0, text_width(panel.label, 1)));
  }
  layout.text_size = size;
  const double bar_height = bar ? scale_bar_height(size, options.scale_label) + 1.2 * size : 0;
  const double label_height = labels ? 3 * size : 0;
  layout.panel_height = height - bar_height - label_height;
  layout.label_baseline = layout.panel_height + 1.6 * size;
  layout.bar_top = layout.panel_height + label_height;
  return layout;
}

// Returns the most pixels per unit at which every panel's box fits, with a margin.
double pixels_per_unit(const std::vector<PlaneBox>& boxes, const Layout& layout) {
  constexpr double kFilled = 0.90;
  double scale = kInfinity;
  for (const PlaneBox& box : boxes) {
    if (box.width() > 0) scale = std::min(scale, kFilled * layout.panel_width / box.width());
    if (box.height() > 0) scale = std::min(scale, kFilled * layout.panel_height / box.height());
  }
  return std::isfinite(scale) ? scale : 1;
}

std::vector<Subject> make_subjects(std::span<const Panel> panels, bool fit_each,
                                   const Context& context) {
  std::vector<Subject> subjects;
  const double common = common_scale(panels);
  for (const Panel& panel : panels) {
    const double scale = fit_each ? common_scale({&panel, 1}) : common;
    subjects.push_back(make_subject(panel, scale, context));
  }
  return subjects;
}

// View of a subject and its scale.
struct Sight {
  View view;
  PlaneBox box;
  double pixels_per_unit = 1;
};

std::vector<Sight> sights_at_one_scale(std::span<const Subject> subjects,
                                       const RenderOptions& options, const Layout& layout) {
  double radius = 0;
  for (const Subject& subject : subjects) radius = std::max(radius, subject.radius);
  const View view = make_view(options, radius > 0 ? radius : 1);
  std::vector<PlaneBox> boxes;
  for (const Subject& subject : subjects) {
    boxes.push_back(subject.ball_radius > 0
                        ? projected_box(view, subject.mesh.vertices, subject.ball_radius)
                        : projected_box(view, subject.mesh));
  }
  const double scale = pixels_per_unit(boxes, layout);
  std::vector<Sight> sights;
  sights.reserve(boxes.size());
  for (const PlaneBox& box : boxes) sights.push_back({view, box, scale});
  return sights;
}

std::vector<Sight> make_sights(std::span<const Subject> subjects, const RenderOptions& options,
                               const Layout& layout) {
  if (!options.fit_each) return sights_at_one_scale(subjects, options, layout);
  std::vector<Sight> sights;
  for (const Subject& subject : subjects) {
    sights.push_back(sights_at_one_scale({&subject, 1}, options, layout).front());
  }
  return sights;
}

Color pixel_color(const PanelPicture& p, const RayScene& scene, const LightSamples& lights,
                  int side, int x, int y) {
  const PixelShift shift = pixel_shift(pixel_seed(x, y));
  Color sum;
  for (int sample = 0; sample < side * side; ++sample) {
    const Ray ray = p.ray_of_sample(x, y, sample, side);
    const RayHit hit = scene.first_hit(ray.origin, ray.direction, 0, kInfinity);
    sum = sum + (hit.hit ? shade(p.subject, scene, p.lamps, p.scale, lights, shift,
                                 place_of(p.subject, ray, hit), sample)
                         : kPaper);
  }
  return (1.0f / static_cast<float>(side * side)) * sum;
}

// `scene` is made if it does not exist yet.
void draw_panel(Canvas& canvas, const PanelPicture& p, std::optional<RayScene>& scene,
                const RenderOptions& options, const Context& context, const ParallelStage& stage) {
  // A subject far below a pixel, next to a large one, is invisible. Rays that start
  // at the large subject's distance would overflow in units of the small one.
  constexpr double kVisible = 1e-3;
  if (p.subject.radius * p.pixels_per_unit < kVisible) return;
  if (!scene) scene.emplace(p.subject.mesh, context, p.subject.ball_radius, RayTree::kQuick);
  if (!options.fine) return draw_shared(canvas, p, *scene, options, context, stage);
  const LightSamples lights =
      make_light_samples(options.samples * options.samples, options.occlusion_rays);
  constexpr std::size_t kRows = 2;  // rows per chunk: some 10 ms
  parallel_for(static_cast<std::size_t>(p.height), kRows, context, stage,
               [&](std::size_t begin, std::size_t end) {
                 for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
                   for (int x = p.left; x < p.right; ++x) {
                     canvas.at(x, y) = pixel_color(p, *scene, lights, options.samples, x, y);
                   }
                 }
               });
}

std::vector<std::array<float, 3>> colors_of(const std::vector<Attribute>& attributes) {
  const char* names[] = {"red", "green", "blue"};
  std::vector<std::array<float, 3>> colors;
  for (std::size_t k = 0; k < 3; ++k) {
    const Attribute* channel = find_attribute(attributes, names[k]);
    if (channel == nullptr) return {};
    const bool real =
        channel->type == ScalarType::kFloat32 || channel->type == ScalarType::kFloat64;
    colors.resize(channel->values.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const double value = channel->values[i] / (real ? 1 : 255);
      colors[i][k] = std::isfinite(value) ? static_cast<float>(std::clamp(value, 0.0, 1.0)) : 0;
    }
  }
  return colors;
}

}  // namespace

std::vector<std::array<float, 3>> vertex_colors(const Mesh& mesh) {
  return colors_of(mesh.attributes);
}
std::vector<std::array<float, 3>> vertex_colors(const PointCloud& cloud) {
  return colors_of(cloud.attributes);
}

std::vector<Image> render_views(std::span<const Panel> panels, const RenderOptions& options,
                                std::span<const Vec3> directions, const Context& context) {
  check(panels, options);
  const std::optional<ColorScale> scale = color_scale(panels, options);
  const Layout layout = make_layout(panels, options, scale && options.scale_bar);
  const std::vector<Subject> subjects = make_subjects(panels, options.fit_each, context);
  std::vector<std::vector<Sight>> sights;  // sights for each direction
  for (const Vec3& direction : directions) {
    RenderOptions turned = options;
    turned.view = direction;
    sights.push_back(make_sights(subjects, turned, layout));
  }

  std::vector<Canvas> canvases(directions.size(),
                               make_canvas(options.width, options.height, kPaper));
  const auto n = static_cast<double>(panels.size() * directions.size());
  double done = 0;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto first = static_cast<double>(k);
    const double left = first * layout.panel_width, right = left + layout.panel_width;
    std::optional<RayScene> scene;
    for (std::size_t v = 0; v < directions.size(); ++v) {
      const Sight& sight = sights[v][k];
      const PanelPicture picture = {subjects[k],
                                    sight.view,
                                    Lamps(sight.view),
                                    scale.value_or(ColorScale{}),
                                    sight.box,
                                    sight.pixels_per_unit,
                                    0.5 * (left + right),
                                    0.5 * layout.panel_height,
                                    static_cast<int>(left),
                                    static_cast<int>(right),
                                    static_cast<int>(layout.panel_height)};
      draw_panel(canvases[v], picture, scene, options, context,
                 {"render", done / n, (done + 1) / n});
      draw_text(canvases[v], panels[k].label, picture.center_x, layout.label_baseline,
                layout.text_size, kInk);
      ++done;
    }
  }
  std::vector<Image> images;
  for (Canvas& canvas : canvases) {
    if (scale && options.scale_bar) {
      draw_scale_bar(canvas, *scale, options.scale_label, 0.5 * options.width, layout.bar_top,
                     0.5 * options.width, layout.text_size);
    }
    images.push_back(to_image(canvas));
  }
  return images;
}

Image render(std::span<const Panel> panels, const RenderOptions& options, const Context& context) {
  return render_views(panels, options, {&options.view, 1}, context).front();
}

}  // namespace rholm
