// Pictures of meshes and points, and plots of spectra. Layer: report.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/image.h"
#include "rholm/mesh.h"

namespace rholm {

// Limit for one panel: about 1.5 GB of memory, and ten points for each pixel of a screen.
inline constexpr std::size_t kMaxPointsInPicture = 20000000;

// One mesh or point cloud in the picture. Panels stand side by side.
struct Panel {
  const Mesh* mesh = nullptr;  // not owned; must exist while the picture is made
  std::string label = {};      // below the panel; may be empty
  // One value per vertex or point, shown by the colour map; empty: a plain colour.
  std::vector<double> scalars = {};
  bool smooth = false;  // shade with vertex normals nx, ny, nz if the mesh has them
  // Red, green, blue per vertex, 0 ... 1 as a screen shows them (sRGB); replace scalars.
  std::vector<std::array<float, 3>> colors = {};
  const PointCloud* points = nullptr;  // used if there is no mesh; not owned; drawn as balls
  // Radius of these balls, in the points' unit; 0: the points' typical spacing, so that the balls
  // of a surface leave no gaps.
  double point_radius = 0;
};

// Return the attributes red, green and blue as colours of a panel: whole numbers count as bytes,
// others as fractions of 1. Empty if the shape has no colours.
std::vector<std::array<float, 3>> vertex_colors(const Mesh& mesh);
std::vector<std::array<float, 3>> vertex_colors(const PointCloud& cloud);

// Size, point of view, light and colours of a picture.
struct RenderOptions {
  int width = 1024, height = 768;   // size of the whole picture in pixels, 16 ... 16384
  bool perspective = false;         // true: perspective; false: parallel projection
  bool fit_each = false;            // true: each panel is filled; false: one scale for all
  Vec3 view = {-0.55, 0.75, -0.4};  // direction of sight, from the eye into the scene
  Vec3 up = {0, 0, 1};              // up direction in the picture, as far as the view allows
  int samples = 3;         // along the side of a pixel on an edge: samples^2 rays, 1 ... 16
  int occlusion_rays = 4;  // per sample, 0 ... 256; 0 switches ambient occlusion off
  // True: every pixel gets all samples, and every sample all rays to the lights. False: only pixels
  // on edges do, and pixels of one surface share rays with their neighbours: seven times as fast.
  bool fine = false;
  // Range of the colour map; by default the range of all scalars.
  std::optional<double> scale_min = {}, scale_max = {};
  bool scale_bar = true;         // true: a colour bar with its label is drawn below the panels
  std::string scale_label = {};  // quantity shown by the scalars
};

// Lists the fields of RenderOptions (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<RenderOptions>, const Visitor& field) {
  using O = RenderOptions;
  field(&O::width, {.name = "width",
                    .help = "width of the whole picture, pixels",
                    .value = "W",
                    .least = 16,
                    .most = 16384,
                    .in_program = false,
                    .in_python = false});
  field(&O::height, {.name = "height",
                     .help = "height of the whole picture, pixels",
                     .value = "H",
                     .least = 16,
                     .most = 16384,
                     .in_program = false,
                     .in_python = false});
  field(&O::perspective,
        {.name = "perspective", .help = "as a camera sees it, instead of parallel lines of sight"});
  field(&O::fit_each, {.name = "fit_each",
                       .help = "every panel is filled; otherwise all have the same scale",
                       .in_program = false});
  field(&O::view, {.name = "view",
                   .help = "direction of sight, from the eye into the scene",
                   .value = "X,Y,Z"});
  field(&O::up, {.name = "up",
                 .help = "direction that points up in the picture, as far as the view allows",
                 .value = "X,Y,Z"});
  field(&O::samples, {.name = "samples",
                      .help = "samples along the side of a pixel that is an edge",
                      .value = "N",
                      .least = 1,
                      .most = 16,
                      .in_program = false});
  field(&O::occlusion_rays, {.name = "occlusion_rays",
                             .help = "rays per sample for ambient occlusion; 0 switches it off",
                             .value = "N",
                             .least = 0,
                             .most = 256,
                             .in_program = false});
  field(&O::fine,
        {.name = "fine",
         .help = "all rays of light for every sample of every pixel: seven times as long"});
  field(&O::scale_min, {.name = "scale_min",
                        .help = "lower end of the colour map; by default the least scalar",
                        .value = "D",
                        .in_program = false,
                        .in_python = false});
  field(&O::scale_max, {.name = "scale_max",
                        .help = "upper end of the colour map; by default the largest scalar",
                        .value = "D",
                        .in_python = false});
  field(
      &O::scale_bar,
      {.name = "scale_bar", .help = "a scale bar is drawn below the panels", .in_program = false});
  field(&O::scale_label, {.name = "scale_label",
                          .help = "what the scalars are",
                          .value = "TEXT",
                          .in_program = false});
}

// Draws all panels side by side, with labels below. Throws InvalidInput for no panel, a panel
// without a face or point, or with both, too many points (kMaxPointsInPicture), sizes out of range.
Image render(std::span<const Panel> panels, const RenderOptions& options = {},
             const Context& context = {});

// Returns a plot of the energy per degree on logarithmic scales (SVG), with the predicted tail S /
// (pi l^4) if known. A tolerance (rms over solid angle, in the function's unit, above 0) adds its
// energy 4 pi E^2. If the norm is known it also adds the energy of all degrees beyond l; the curves
// cross where the tolerance is kept.
std::string spectrum_svg(const Expansion& expansion, const std::string& title,
                         std::optional<double> tolerance = {});

}  // namespace rholm
