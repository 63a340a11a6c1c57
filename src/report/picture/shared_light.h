// Draws a picture whose pixels share the rays of their light.
#pragma once

#include "base/parallel.h"
#include "base/random.h"
#include "report/picture/canvas.h"
#include "report/picture/shade.h"
#include "report/picture/view.h"

namespace rholm {

// Panel with its position in the picture.
struct PanelPicture {
  const Subject& subject;
  const View& view;
  Lamps lamps;
  const ColorScale& scale;
  PlaneBox box;
  double pixels_per_unit;
  double center_x, center_y;  // position in pixels
  int left, right, height;    // size in pixels

  Ray ray(double x, double y) const {
    return view.ray({0.5 * (box.min.x + box.max.x) + (x - center_x) / pixels_per_unit,
                     0.5 * (box.min.y + box.max.y) - (y - center_y) / pixels_per_unit});
  }
  // Returns a sample ray of a pixel: side x side squares, one random position in each.
  Ray ray_of_sample(int x, int y, int sample, int side) const {
    const std::uint64_t seed = pixel_seed(x, y);
    const auto jitter = [&](int cell, int k) {
      return (cell + random_uniform(seed, 2 + 2 * sample + k)) / side;
    };
    return ray(x + jitter(sample % side, 0), y + jitter(sample / side, 1));
  }
};

// Draws the panel into its part of the canvas, strip by strip. Chosen: the
// cells of a strip, some 130 bytes each, stay in the processor's cache.
// The bits are the same for any number of threads, and for any strips.
inline constexpr int kStripCells = 1 << 15;
void draw_shared(Canvas& canvas, const PanelPicture& panel, const RayScene& scene,
                 const RenderOptions& options, const Context& context, const ParallelStage& stage,
                 int strip_cells = kStripCells);

}  // namespace rholm
