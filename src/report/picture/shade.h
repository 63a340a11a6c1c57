// The light on one panel of a picture.
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

// What stands in a panel. Coordinates are of the order of 1 about the origin.
struct Subject {
  Mesh mesh;                                     // no attributes; of points the vertices
  std::vector<Vec3> normals;                     // unit, per vertex; empty: faces are flat
  const std::vector<double>* scalars = nullptr;  // per vertex; null: plain
  double radius = 0;                             // of a ball about the origin that holds everything
  std::vector<Color> colors = {};                // per vertex; empty: by scalars, or plain
  double ball_radius = 0;                        // above 0: points, each shown as a ball
};

// A place of the surface that is seen.
struct Place {
  Vec3 point;   // from where secondary rays start
  Vec3 face;    // unit normal of the face, towards the eye
  Vec3 normal;  // unit normal for shading, towards the eye
  bool back = false;
  double scalar = 0;
  Color color;
};
Place place_of(const Subject& subject, const Ray& ray, const RayHit& hit);
// Asks for what place_of() needs of hits that come soon after hit k: each lies elsewhere in memory,
// and the processor would wait.
void look_ahead(const Subject& subject, std::span<const RayHit> hits, std::size_t k);

// Where light comes from, as seen from this side.
struct Lamps {
  explicit Lamps(const View& view);
  Vec3 key_x, key_y, key;  // an orthonormal frame; the third towards the middle of the key's disc
  Vec3 fill, up;
};

// The colour of a place, by the parts of the sky and of the key's disc that are free.
struct Finish {
  Color color;
  float bounce, sky, key;  // light of every nook, of all of the sky, of all of the key
  Color lit(float free_sky, float free_key) const {
    return (bounce + sky * free_sky + key * free_key) * color;
  }
};
Finish finish(const Subject& subject, const Lamps& lamps, const ColorScale& scale,
              const Place& place);

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
  double shift = 0, cosine = 1, sine = 0;
};
PixelShift pixel_shift(std::uint64_t pixel_seed);
// Of its random numbers: 0 and 1 are those of pixel_shift().
std::uint64_t pixel_seed(int x, int y);

// Towards points of the discs of the sky and of the key, seen from a place.
Vec3 sky_direction(const Place& place, const LightSamples::Polar& point, const PixelShift& pixel);
Vec3 key_direction(const Lamps& lamps, const LightSamples::Polar& point, const PixelShift& pixel);

// Colour of a place by rays of its own. `sample` counts the samples of a pixel.
// Deterministic; may be called from several threads.
Color shade(const Subject& subject, const RayScene& scene, const Lamps& lamps,
            const ColorScale& scale, const LightSamples& lights, const PixelShift& pixel,
            const Place& place, int sample);

}  // namespace rholm
