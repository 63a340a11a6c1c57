// The lights are a key light from the upper left with soft shadows and a fill light from
// the right. A bright sky reaches a point from all free directions (ambient occlusion).
#include "report/picture/shade.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <hwy/cache_control.h>

#include "base/random.h"

namespace rholm {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// All chosen by eye; sky, key and fill together give 1.1 to 1.2 on a face turned to the key.
constexpr double kSky = 0.48, kSkySlope = 0.26;  // relative increase of the sky's light from above
constexpr double kKey = 0.70, kFill = 0.06;
constexpr double kBounce = 0.05;  // reaches every point: the inside of an open shape is not black
// Share of the light that is independent of the surface where colours show numbers.
constexpr double kFlatLight = 0.45;
constexpr double kKeyRadius = 0.18;  // radius of the key's disc at distance 1: 10 degrees

// Rays start this far (in radii) off the surface: 1000 times the rounding of Embree's floats.
constexpr double kRayOffset = 1e-4;
// On small balls the offset is at most this part of the ball's radius.
constexpr double kBallOffset = 0.05;

// The colours are made once, because every sample uses them.
Color plain_color() {
  static const Color color = from_oklch(0.83, 0.045, 75);  // sandstone
  return color;
}
Color back_color() {
  static const Color color = from_oklch(0.55, 0.14, 28);  // brick: seen from inside
  return color;
}

struct Frame {
  Vec3 x, y, z;
};
// Returns an orthonormal frame about n, continuous except at n.z = 0 (Duff et al. 2017).
Frame frame_about(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

// Returns a point of the interpolated surface: the mean of the
// projections onto the planes of the corners (Hanika 2021, "Hacking
// the shadow terminator"). Facets then do not show in shadow borders.
Vec3 rounded_point(const Subject& subject, const Triangle& t, const double (&weights)[3],
                   const Vec3& point, double side) {
  Vec3 result;
  for (int k = 0; k < 3; ++k) {
    const Vec3 normal = side * subject.normals[t[k]];
    const double depth = std::min(0.0, dot(point - subject.mesh.vertices[t[k]], normal));
    result += weights[k] * (point - depth * normal);
  }
  return result;
}

// Returns the place where the ray enters a ball.
Place place_on_ball(const Subject& subject, const Ray& ray, const RayHit& hit) {
  const Vec3& center = subject.mesh.vertices[hit.triangle];
  const Vec3 from_center = ray.origin - center;
  const Vec3 nearest = from_center - dot(from_center, ray.direction) * ray.direction;
  const double radius = subject.ball_radius;
  // The hit is in floats: a ray that just touches the ball may miss it by rounding.
  const double half_chord = std::sqrt(std::max(0.0, radius * radius - dot(nearest, nearest)));
  Place place;
  place.face = place.normal = normalized(nearest - half_chord * ray.direction);
  const double off = std::min(kRayOffset * subject.radius, kBallOffset * radius);
  place.point = center + (radius + off) * place.face;
  if (subject.scalars != nullptr) place.scalar = (*subject.scalars)[hit.triangle];
  if (!subject.colors.empty()) place.color = subject.colors[hit.triangle];
  return place;
}

// Returns the place where the ray meets a face.
Place place_on_face(const Subject& subject, const Ray& ray, const RayHit& hit) {
  const Triangle& t = subject.mesh.faces[hit.triangle];
  const double weights[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
  const auto mix = [&](const std::vector<Vec3>& of) {
    return weights[0] * of[t[0]] + weights[1] * of[t[1]] + weights[2] * of[t[2]];
  };
  const std::vector<Vec3>& v = subject.mesh.vertices;
  Place place;
  place.face = normalized(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]));
  place.back = dot(place.face, ray.direction) > 0;
  const double side = place.back ? -1 : 1;
  place.face = side * place.face;
  place.point = mix(v);
  place.normal = place.face;
  if (!subject.normals.empty()) {
    const Vec3 mixed = normalized(side * mix(subject.normals));
    // Normals that contradict the face are ignored.
    if (dot(mixed, place.face) > 0) {
      place.normal = mixed;
      place.point = rounded_point(subject, t, weights, place.point, side);
    }
  }
  place.point += (kRayOffset * subject.radius) * place.face;
  if (subject.scalars != nullptr) {
    const std::vector<double>& s = *subject.scalars;
    place.scalar = weights[0] * s[t[0]] + weights[1] * s[t[1]] + weights[2] * s[t[2]];
  }
  if (!subject.colors.empty()) {
    for (std::size_t k = 0; k < 3; ++k) {
      place.color = place.color + static_cast<float>(weights[k]) * subject.colors[t[k]];
    }
  }
  return place;
}

}  // namespace

Place place_of(const Subject& subject, const Ray& ray, const RayHit& hit) {
  return subject.ball_radius > 0 ? place_on_ball(subject, ray, hit)
                                 : place_on_face(subject, ray, hit);
}

void look_ahead(const Subject& subject, std::span<const RayHit> hits, std::size_t k) {
  // Chosen: some 400 ns of work, more than memory takes. A miss has the first triangle.
  constexpr std::size_t kCorners = 8, kIndices = 2 * kCorners;
  if (k + kIndices >= hits.size() || subject.ball_radius > 0) return;
  hwy::Prefetch(&subject.mesh.faces[hits[k + kIndices].triangle]);
  for (const std::uint32_t corner : subject.mesh.faces[hits[k + kCorners].triangle]) {
    hwy::Prefetch(&subject.mesh.vertices[corner]);
    if (!subject.normals.empty()) hwy::Prefetch(&subject.normals[corner]);
  }
}

namespace {

double wrapped(double x) { return x - std::floor(x); }

// Returns the point of a set for this pixel: turned by the pixel's angle, and shifted in
// squared radius (Cranley, Patterson 1976). Both keep the set evenly spread over the disc.
LightSamples::Polar shifted(const LightSamples::Polar& p, const PixelShift& pixel) {
  return {wrapped(p.radius2 + pixel.shift), p.cosine * pixel.cosine - p.sine * pixel.sine,
          p.sine * pixel.cosine + p.cosine * pixel.sine};
}

// Returns the free share of the sky, weighted by the cosine.
double free_sky(const RayScene& scene, const Place& place, const LightSamples& lights,
                const PixelShift& pixel, int sample) {
  if (lights.sky.empty()) return 1;
  const std::size_t rays = lights.sky.size() / lights.key.size();
  int free = 0;
  for (std::size_t r = 0; r < rays; ++r) {
    const auto& point = lights.sky[static_cast<std::size_t>(sample) * rays + r];
    free += !scene.occluded(place.point, sky_direction(place, point, pixel), 0, kInfinity);
  }
  return static_cast<double>(free) / static_cast<double>(rays);
}

// Returns Lambert's cosine of the key light, 0 in its shadow.
double key_light(const RayScene& scene, const Lamps& lamps, const Place& place,
                 const LightSamples& lights, const PixelShift& pixel, int sample) {
  if (dot(lamps.key, place.normal) < -kKeyRadius) return 0;
  const Vec3 direction = key_direction(lamps, lights.key[static_cast<std::size_t>(sample)], pixel);
  const double cosine = dot(direction, place.normal);
  if (cosine <= 0) return 0;
  // A flat face turned away from the key would shadow itself where the rounded surface is lit.
  const bool own_shadow = dot(direction, place.face) <= 0;
  return !own_shadow && scene.occluded(place.point, direction, 0, kInfinity) ? 0 : cosine;
}

// Returns the mean over the key's disc of the cosine above the horizon: the mean of
// max(0, t + x) over the unit disc. Here t is the horizon's distance from the disc's
// centre in its radius. The factor 1 / |direction|, 0.984 ... 1, is replaced by its mean.
double key_cosine(double cosine) {
  constexpr double kRadius2 = kKeyRadius * kKeyRadius;
  const double shrink = 2 / kRadius2 * (std::sqrt(1 + kRadius2) - 1);
  const double tilt = kKeyRadius * std::sqrt(std::max(0.0, 1 - cosine * cosine));
  if (cosine >= tilt) return shrink * cosine;
  if (cosine <= -tilt) return 0;
  const double t = cosine / tilt, s = std::sqrt(1 - t * t), pi = std::numbers::pi;
  return shrink * tilt * (t / 2 + (t * (t * s + std::asin(t)) + 2 * s * s * s / 3) / pi);
}

// Returns the Hammersley set of n points on the disc; the angle has the reversed bits of k.
std::vector<LightSamples::Polar> hammersley_disc(std::uint32_t n) {
  std::vector<LightSamples::Polar> points;
  for (std::uint32_t k = 0; k < n; ++k) {
    std::uint32_t reversed = 0;
    for (std::uint32_t bits = k, place = 0x80000000u; bits != 0; bits >>= 1, place >>= 1) {
      if (bits & 1u) reversed |= place;
    }
    const double phi = 2 * std::numbers::pi * (reversed * 0x1p-32);
    points.push_back({(k + 0.5) / n, std::cos(phi), std::sin(phi)});
  }
  return points;
}

}  // namespace

// A point of the disc, lifted to the hemisphere above it, has the density of the cosine.
Vec3 sky_direction(const Place& place, const LightSamples::Polar& point, const PixelShift& pixel) {
  const Frame frame = frame_about(place.normal);
  const auto p = shifted(point, pixel);
  const double radius = std::sqrt(p.radius2);
  const Vec3 direction = (radius * p.cosine) * frame.x + (radius * p.sine) * frame.y +
                         std::sqrt(1 - p.radius2) * frame.z;
  // A direction below the flat face but above the rounded surface is mirrored up.
  const double below = std::min(0.0, dot(direction, place.face));
  return direction - (2 * below) * place.face;
}

Vec3 key_direction(const Lamps& lamps, const LightSamples::Polar& point, const PixelShift& pixel) {
  const auto p = shifted(point, pixel);
  const double radius = kKeyRadius * std::sqrt(p.radius2);
  return normalized(lamps.key + (radius * p.cosine) * lamps.key_x +
                    (radius * p.sine) * lamps.key_y);
}

LightSamples make_light_samples(int samples_per_pixel, int occlusion_rays) {
  const auto samples = static_cast<std::uint32_t>(samples_per_pixel);
  const auto rays = static_cast<std::uint32_t>(occlusion_rays);
  std::vector<LightSamples::Polar> spread = hammersley_disc(samples * rays);
  // Sample s takes every samples-th point from s on, so that each sample covers the whole sky.
  LightSamples lights = {{}, hammersley_disc(samples)};
  for (std::uint32_t s = 0; s < samples; ++s) {
    for (std::uint32_t r = 0; r < rays; ++r) lights.sky.push_back(spread[r * samples + s]);
  }
  return lights;
}

std::uint64_t pixel_seed(int x, int y) {
  return random_bits(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
}

PixelShift pixel_shift(std::uint64_t pixel_seed) {
  const double angle = 2 * std::numbers::pi * random_uniform(pixel_seed, 0);
  return {random_uniform(pixel_seed, 1), std::cos(angle), std::sin(angle)};
}

Lamps::Lamps(const View& view) {
  const Vec3 middle = normalized(-0.5 * view.right + 0.62 * view.up - 0.6 * view.forward);
  const Frame frame = frame_about(middle);
  key_x = frame.x;
  key_y = frame.y;
  key = frame.z;
  fill = normalized(0.75 * view.right + 0.1 * view.up - 0.65 * view.forward);
  up = view.up;
}

Finish finish(const Subject& subject, const Lamps& lamps, const ColorScale& scale,
              const Place& place) {
  const Vec3& normal = place.normal;
  Finish f = {plain_color(),
              static_cast<float>(kBounce + kFill * std::max(0.0, dot(lamps.fill, normal))),
              static_cast<float>(kSky * (1 - kSkySlope + kSkySlope * dot(normal, lamps.up))),
              static_cast<float>(kKey * key_cosine(dot(lamps.key, normal)))};
  if (place.back) {
    f.color = back_color();
  } else if (!subject.colors.empty()) {
    f.color = place.color;
  } else if (subject.scalars != nullptr) {
    constexpr auto kShaded = static_cast<float>(1 - kFlatLight);
    f = {scale.color(place.scalar), static_cast<float>(kFlatLight) + kShaded * f.bounce,
         kShaded * f.sky, kShaded * f.key};
  }
  return f;
}

Color shade(const Subject& subject, const RayScene& scene, const Lamps& lamps,
            const ColorScale& scale, const LightSamples& lights, const PixelShift& pixel,
            const Place& place, int sample) {
  const double all = key_cosine(dot(lamps.key, place.normal));
  const double key = key_light(scene, lamps, place, lights, pixel, sample);
  const double sky = free_sky(scene, place, lights, pixel, sample);
  return finish(subject, lamps, scale, place)
      .lit(static_cast<float>(sky), all > 0 ? static_cast<float>(key / all) : 0);
}

}  // namespace rholm
