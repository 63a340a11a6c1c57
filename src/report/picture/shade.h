// Light on one panel of a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "report/picture/color.h"
#include "report/picture/view.h"
#include "rholm/mesh.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

// Content of a panel. Coordinates are of the order of 1 about the origin.
struct Subject {
  Mesh mesh;                                     // no attributes; for points only vertices
  std::vector<Vec3> normals;                     // unit, per vertex; empty: faces are flat
  const std::vector<double>* scalars = nullptr;  // scalar per vertex; null: plain
  double radius = 0;                             // radius of a ball at the origin around it all
  std::vector<Color> colors = {};                // colour per vertex; empty: by scalars, or plain
  double ball_radius = 0;                        // above 0: points, each drawn as a ball
};

// Visible place of the surface.
struct Place {
  Vec3 point;   // start of secondary rays
  Vec3 face;    // unit normal of the face, towards the eye
  Vec3 normal;  // unit normal for shading, towards the eye
  bool back = false;
  double scalar = 0;
  Color color;
};
Place place_of(const Subject& subject, const Ray& ray, const RayHit& hit);
// Prefetches the data that place_of() needs for hits shortly
// after hit k, because these lie at scattered addresses.
void look_ahead(const Subject& subject, std::span<const RayHit> hits, std::size_t k);

// Directions of the lights for this view.
struct Lamps {
  explicit Lamps(const View& view);
  Vec3 key_x, key_y, key;  // orthonormal frame; `key` points to the middle of the key's disc
  Vec3 fill, up;
};

// Colour of a place, as a function of the free parts of the sky and of the key's disc.
struct Finish {
  Color color;
  float bounce, sky, key;  // light that reaches every point, of the whole sky, of the whole key
  Color lit(float free_sky, float free_key) const {
    return (bounce + sky * free_sky + key * free_key) * color;
  }
};
Finish finish(const Subject& subject, const Lamps& lamps, const ColorScale& scale,
              const Place& place);

// Directions of the secondary rays of a pixel. The sky and the disc of the key
// light have one Hammersley set each, distributed over all samples of the pixel.
struct LightSamples {
  struct Polar {
    double radius2, cosine, sine;  // polar coordinates of a point of the unit disc
  };
  std::vector<Polar> sky;  // equally many per sample of a pixel; empty: no occlusion
  std::vector<Polar> key;  // one per sample of a pixel
};
LightSamples make_light_samples(int samples_per_pixel, int occlusion_rays);

// A pixel's own rotation and shift of these sets, so that no pattern appears between pixels.
struct PixelShift {
  double shift = 0, cosine = 1, sine = 0;
};
PixelShift pixel_shift(std::uint64_t pixel_seed);
// Returns the seed of a pixel's random numbers; pixel_shift() uses numbers 0 and 1.
std::uint64_t pixel_seed(int x, int y);

// Return directions from a place to points on the discs of the sky and of the key.
Vec3 sky_direction(const Place& place, const LightSamples::Polar& point, const PixelShift& pixel);
Vec3 key_direction(const Lamps& lamps, const LightSamples::Polar& point, const PixelShift& pixel);

// Returns the colour of a place by its own rays. `sample` counts the
// samples of a pixel. Deterministic; may be called from several threads.
Color shade(const Subject& subject, const RayScene& scene, const Lamps& lamps,
            const ColorScale& scale, const LightSamples& lights, const PixelShift& pixel,
            const Place& place, int sample);

}  // namespace rholm
