// The light on one panel of a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "report/picture/color.h"
#include "report/picture/view.h"
#include "rholm/mesh.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

// What stands in a panel. Coordinates are of the order of 1 about the origin.
struct Subject {
  Mesh mesh;                                     // no attributes; of points the vertices
  std::vector<Vec3> normals;                     // unit, per vertex; empty: faces are flat
  const std::vector<double>* scalars = nullptr;  // per vertex; null: plain
  double radius = 0;                             // of a ball about the origin that holds everything
  std::vector<Color> colors = {};                // per vertex; empty: by scalars, or plain
  double ball_radius = 0;                        // above 0: points, each shown as a ball
};

// The directions of the secondary rays of a pixel: a Hammersley set for the sky and one for the
// disc of the key light, spread over all of the pixel's samples.
struct LightSamples {
  struct Polar {
    double radius2, cosine, sine;  // of a point of the unit disc
  };
  std::vector<Polar> sky;  // the same number for every sample of a pixel; empty: no occlusion
  std::vector<Polar> key;  // one per sample of a pixel
};
LightSamples make_light_samples(int samples_per_pixel, int occlusion_rays);

// A pixel's own rotation and shift of these sets, so that no pattern shows between pixels.
struct PixelShift {
  double shift, cosine, sine;
};
PixelShift pixel_shift(std::uint64_t pixel_seed);

// Colour seen along a ray; none where it meets nothing. `sample` counts the samples of a pixel.
// Deterministic; may be called from several threads.
std::optional<Color> shade(const Subject& subject, const RayScene& scene, const View& view,
                           const ColorScale& scale, const LightSamples& lights,
                           const PixelShift& pixel, const ViewRay& ray, int sample);

}  // namespace rholm
