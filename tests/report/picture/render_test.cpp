#include "rholm/render.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "report/picture/canvas.h"
#include "report/picture/color.h"
#include "report/picture/shade.h"
#include "report/picture/shared_light.h"
#include "report/picture/view.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

// Small pictures without effects, to be fast: front view with x to the right and z up.
RenderOptions front() {
  RenderOptions options;
  options.width = 96;
  options.height = 80;
  options.view = {0, 1, 0};
  options.samples = 2;
  options.occlusion_rays = 2;
  return options;
}

std::array<int, 3> pixel(const Image& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}
constexpr std::array<int, 3> kWhite = {255, 255, 255};
int brightness(const Image& image, int x, int y) {
  const auto [r, g, b] = pixel(image, x, y);
  return r + g + b;
}

Image render_one(const Mesh& mesh, const RenderOptions& options, const Context& context = {}) {
  Panel panel;
  panel.mesh = &mesh;
  return render({&panel, 1}, options, context);
}

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

// The sphere fills 90 % of the height: a disc of diameter 72. A pixel is coloured if one of its 4
// samples hits, so the disc grows by about half a pixel: its border is pi 72 pixels long.
TEST(render, of_a_sphere_is_a_centred_disc_on_white) {
  const Image image = render_one(icosphere(4), front());
  ASSERT_EQ(image.width, 96);
  ASSERT_EQ(image.height, 80);
  ASSERT_EQ(image.rgb.size(), 3u * 96 * 80);
  double area = 0, x_mean = 0, y_mean = 0;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (pixel(image, x, y) == kWhite) continue;
      ++area;
      x_mean += x + 0.5;
      y_mean += y + 0.5;
    }
  }
  const double pi = std::numbers::pi;
  EXPECT_NEAR(area, pi * 36 * 36, pi * 72);
  EXPECT_NEAR(x_mean / area, 48, 0.5);
  EXPECT_NEAR(y_mean / area, 40, 0.5);
  for (const int x : {0, 95}) {
    for (const int y : {0, 79}) EXPECT_EQ(pixel(image, x, y), kWhite);
  }
}

TEST(render, shows_right_as_right_and_up_as_up) {
  Mesh mesh;  // a plate in the plane y = 0 whose upper right quarter is missing
  mesh.vertices = {{-1, 0, -1}, {0, 0, -1}, {1, 0, -1}, {-1, 0, 0},
                   {0, 0, 0},   {1, 0, 0},  {-1, 0, 1}, {0, 0, 1}};
  mesh.faces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}};
  const Image image = render_one(mesh, front());
  EXPECT_EQ(pixel(image, 48 + 18, 40 - 18), kWhite);
  EXPECT_NE(pixel(image, 48 - 18, 40 - 18), kWhite);
  EXPECT_NE(pixel(image, 48 - 18, 40 + 18), kWhite);
  EXPECT_NE(pixel(image, 48 + 18, 40 + 18), kWhite);
}

TEST(render, lights_from_the_upper_left) {
  const Image image = render_one(icosphere(4), front());
  EXPECT_GT(brightness(image, 48 - 15, 40 - 15), brightness(image, 48 + 15, 40 + 15));
}

TEST(render, shows_faces_from_behind_in_another_colour) {
  Mesh mesh = icosphere(3);
  const auto [r0, g0, b0] = pixel(render_one(mesh, front()), 48, 40);
  flip(mesh);
  const auto [r1, g1, b1] = pixel(render_one(mesh, front()), 48, 40);
  EXPECT_LT(r0, 1.5 * b0);
  EXPECT_GT(r1, 1.5 * b1);
}

// In the corner between two plates at a right angle, each plate sees half of its sky.
TEST(render, darkens_corners_by_occlusion) {
  Mesh mesh;  // floor z = 0 and wall y = 1, seen from above and the front
  mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {1, 1, 2}, {-1, 1, 2}};
  mesh.faces = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
  RenderOptions options = front();
  options.view = {0, 1, -1};
  options.occlusion_rays = 8;
  const Image with = render_one(mesh, options);
  options.occlusion_rays = 0;
  const Image without = render_one(mesh, options);
  EXPECT_LT(brightness(with, 48, 42), brightness(without, 48, 42) - 20);  // just below the corner
  EXPECT_LT(brightness(with, 48, 42), brightness(with, 48, 70));          // the free edge
}

TEST(render, gives_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  const Image one = render_one(mesh, front(), {.threads = 1});
  for (const int threads : {2, 4, 7}) {
    EXPECT_EQ(one.rgb, render_one(mesh, front(), {.threads = threads}).rgb);
  }
}

// The picture has pixels in more than one strip.
TEST(render, of_many_pixels_gives_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  RenderOptions options = front();
  options.width = options.height = 800;
  options.samples = options.occlusion_rays = 1;
  const Image one = render_one(mesh, options, {.threads = 1});
  for (const int threads : {2, 3}) {
    EXPECT_EQ(one.rgb, render_one(mesh, options, {.threads = threads}).rgb);
  }
}

// A strip takes from the strip above exactly the values that it would compute itself.
TEST(draw_shared, gives_the_same_bits_for_any_strips) {
  const RenderOptions options = front();
  const Subject subject = {.mesh = bumpy_sphere(3, 0.3), .normals = {}, .radius = 1.3};
  const View view = make_view(options, subject.radius);
  const PlaneBox box = projected_box(view, subject.mesh);
  const ColorScale scale;
  const PanelPicture panel = {subject, view, Lamps(view), scale, box, 280 / box.height(),
                              150,     150,  0,           300,   300};
  const RayScene scene(subject.mesh);
  const auto drawn = [&](int strip_cells) {
    Canvas canvas = make_canvas(300, 300, {1, 1, 1});
    draw_shared(canvas, panel, scene, options, {.threads = 1}, {}, strip_cells);
    return to_image(canvas).rgb;
  };
  const std::vector<std::uint8_t> at_once = drawn(1 << 20);
  EXPECT_EQ(drawn(1), at_once);  // four strips of 64 rows and a shorter one
  EXPECT_EQ(drawn(100 * 300), at_once);
}

// On a convex body no part of the sky is hidden, nor is the key light from sides that face it.
TEST(render, of_a_convex_body_has_no_shadows) {
  const Mesh mesh = icosphere(2);
  for (const bool fine : {false, true}) {
    RenderOptions options = front();
    options.fine = fine;
    const Image with = render_one(mesh, options);
    options.occlusion_rays = 0;
    EXPECT_EQ(with.rgb, render_one(mesh, options).rgb);
  }
}

// A plate under a free sky gets the whole light of the sky and the key light. The mean of the key
// light over the samples of its disc is known.
TEST(render, of_a_plate_has_the_light_of_its_direction) {
  Mesh plate;
  plate.vertices = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  plate.faces = {{0, 1, 2}, {0, 2, 3}};
  RenderOptions options = front();
  for (const Vec3& from : {Vec3{0, 1, 0}, Vec3{0.5, 1, -0.2}, Vec3{-1, 0.4, 0.7}}) {
    options.view = from;
    const View view = make_view(options, 1);
    Place place;
    place.face = place.normal = {0, -1, 0};
    const Lamps lamps(view);
    const Finish light = finish({}, lamps, {}, place);
    double key = 0;
    const LightSamples many = make_light_samples(4096, 0);
    for (const LightSamples::Polar& point : many.key) {
      key += std::max(0.0, dot(key_direction(lamps, point, {}), place.normal)) / 4096;
    }
    EXPECT_NEAR(light.key, 0.70 * key, 1e-4);  // 0.70 is the strength of the key light in shade.cpp
    const Color color = light.lit(1, 1);
    const auto [r, g, b] = pixel(render_one(plate, options), 48, 40);
    EXPECT_EQ(r, to_srgb_byte(color.r));
    EXPECT_EQ(g, to_srgb_byte(color.g));
    EXPECT_EQ(b, to_srgb_byte(color.b));
  }
}

// Returns the rms difference from the picture with all rays for all samples, in levels of 255.
double off_from_fine(const Mesh& mesh, RenderOptions options) {
  options.samples = 4;
  const Image shared = render_one(mesh, options);
  options.fine = true;
  options.occlusion_rays = 16;
  const Image fine = render_one(mesh, options);
  double sum = 0;
  for (std::size_t k = 0; k < fine.rgb.size(); ++k) {
    const double off = double(shared.rgb[k]) - fine.rgb[k];
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(fine.rgb.size()));
}

// At shadows the difference is a few levels of 255; scripts/render-figures measures more shapes.
TEST(render, shares_light_without_changing_it) {
  EXPECT_LT(off_from_fine(bumpy_sphere(4, 0.3), front()), 2);
}

// Slats under a roof whose width makes a unit one pixel. No two neighbours have the same depth, and
// each slat lies between the cells that look for shadows first. Measured: 5.1 if all cells looked,
// 7.0 if cells without a suitable neighbour did not look themselves.
TEST(render, sees_shadows_on_what_is_narrower_than_two_pixels) {
  Mesh mesh;
  const auto add_plate = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {corner, corner + u, corner + u + v, corner + v});
    mesh.faces.insert(mesh.faces.end(), {{n, n + 1, n + 2}, {n, n + 2, n + 3}});
  };
  for (int k = 0; k < 20; ++k) {
    add_plate({7.1 + 4 * k, k % 2 == 0 ? 0.0 : 8.0, 0}, {0.8, 0, 0}, {0, 0, 40});
  }
  add_plate({4.8, -40, 41}, {86.4, 0, 0}, {0, 80, 0});
  EXPECT_LT(off_from_fine(mesh, front()), 6);
}

TEST(render, does_not_depend_on_the_unit_and_hardly_on_the_place) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  for (const bool perspective : {false, true}) {
    RenderOptions options = front();
    options.perspective = perspective;
    const Image one = render_one(mesh, options);
    for (const double scale : {0x1p-900, 0x1p-20, 0x1p20, 0x1p900}) {
      EXPECT_EQ(one.rgb, render_one(moved(mesh, scale, {}), options).rgb) << scale;
    }
    // Rounding of coordinates sometimes moves a ray across an edge.
    const Image there = render_one(moved(mesh, 1, {1000, -500, 3}), options);
    int different = 0;
    for (std::size_t k = 0; k < one.rgb.size(); ++k) {
      different += std::abs(one.rgb[k] - there.rgb[k]) > 16;
    }
    EXPECT_LT(different, 20);
  }
}

TEST(render, draws_panels_side_by_side_at_one_scale_with_labels_below) {
  const Mesh large = icosphere(3), small = moved(large, 0.5, {});
  std::array<Panel, 2> panels;
  panels[0].mesh = &large;
  panels[1].mesh = &small;
  RenderOptions options = front();
  options.width = 192;
  const auto coloured = [&](const Image& image, int from, int to, int top, int bottom) {
    int n = 0;
    for (int y = top; y < bottom; ++y) {
      for (int x = from; x < to; ++x) n += pixel(image, x, y) != kWhite;
    }
    return n;
  };
  const Image plain = render(panels, options);
  const double ratio = coloured(plain, 0, 96, 0, 80) * 1.0 / coloured(plain, 96, 192, 0, 80);
  EXPECT_NEAR(ratio, 4, 0.3);  // the border adds half a pixel to radii of 36 and 18
  EXPECT_EQ(coloured(plain, 0, 192, 76, 80), 0);
  panels[1].label = "L = 64";
  const Image labelled = render(panels, options);
  EXPECT_EQ(coloured(labelled, 0, 96, 75, 80), 0);
  EXPECT_GT(coloured(labelled, 96, 192, 74, 80), 10);
}

TEST(render, fills_each_panel_on_demand_whatever_the_sizes) {
  const Mesh large = moved(icosphere(3), 0x1p300, {}), small = moved(icosphere(3), 0x1p-300, {});
  std::array<Panel, 2> panels;
  panels[0].mesh = &large;
  panels[1].mesh = &small;
  RenderOptions options = front();
  options.width = 192;
  options.fit_each = true;
  for (const bool perspective : {false, true}) {
    options.perspective = perspective;
    const Image image = render(panels, options);
    int inked[2] = {0, 0};
    for (int y = 0; y < options.height; ++y) {
      for (int x = 0; x < 192; ++x) inked[x / 96] += pixel(image, x, y) != kWhite;
    }
    EXPECT_GT(inked[0], 3000);  // a disc of 0.9 of the height of 80: 4070
    EXPECT_NEAR(inked[1], inked[0], 30);
  }
}

TEST(render, colours_scalars_and_draws_their_scale) {
  const Mesh mesh = icosphere(4);
  Panel panel;
  panel.mesh = &mesh;
  for (const Vec3& v : mesh.vertices) panel.scalars.push_back(v.x);
  RenderOptions options = front();
  options.scale_label = "x";
  const Image image = render({&panel, 1}, options);
  const auto [r0, g0, b0] = pixel(image, 48 - 20, 32);
  const auto [r1, g1, b1] = pixel(image, 48 + 20, 32);
  EXPECT_GT(b0, r0);  // negative: blue
  EXPECT_GT(r1, b1);  // positive: red
  options.scale_min = -1e6;
  options.scale_max = 1e6;
  const auto [r2, g2, b2] = pixel(render({&panel, 1}, options), 48 - 20, 32);
  EXPECT_NEAR(b2, r2, 8);  // close to the neutral middle
}

TEST(render, draws_a_constant_scalar) {
  const Mesh mesh = icosphere(2);
  for (const double value : {0.0, 3.0, -3.0, 1e300}) {
    Panel panel{&mesh, "", std::vector<double>(mesh.vertices.size(), value), false};
    EXPECT_NE(pixel(render({&panel, 1}, front()), 48, 32), kWhite) << value;
    // A surface is compared with itself: the scale has zero length, and all values lie at it.
    RenderOptions from = front(), to = front();
    from.scale_min = value;
    to.scale_max = value;
    for (const RenderOptions& options : {from, to}) {
      EXPECT_NE(pixel(render({&panel, 1}, options), 48, 32), kWhite) << value;
    }
  }
}

// On a coarse sphere with exact normals, neighbouring pixels inside the disc differ little. With
// flat faces there are steps at the edges.
TEST(render, smooth_shading_hides_the_facets) {
  Mesh mesh = icosphere(1);
  const auto component = [&](const char* name, double Vec3::*member) {
    Attribute attribute{name, ScalarType::kFloat64, {}};
    for (const Vec3& v : mesh.vertices) attribute.values.push_back(v.*member);
    mesh.attributes.push_back(attribute);
  };
  component("nx", &Vec3::x);
  component("ny", &Vec3::y);
  component("nz", &Vec3::z);
  RenderOptions options = front();
  options.occlusion_rays = 0;
  Panel panel;
  panel.mesh = &mesh;
  const auto largest_step = [&](bool smooth) {
    panel.smooth = smooth;
    const Image image = render({&panel, 1}, options);
    int step = 0;
    for (int y = 25; y < 55; ++y) {
      for (int x = 33; x < 63; ++x) {
        step = std::max(step, std::abs(brightness(image, x, y) - brightness(image, x + 1, y)));
      }
    }
    return step;
  };
  EXPECT_LT(3 * largest_step(true), largest_step(false));
}

TEST(render, draws_degenerate_shapes) {
  Mesh point, line, plate;
  point.vertices = {{1, 2, 3}};
  point.faces = {{0, 0, 0}};
  line.vertices = {{0, 0, 0}, {1, 0, 0}};
  line.faces = {{0, 1, 0}};
  plate.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  plate.faces = {{0, 1, 2}};
  for (const bool perspective : {false, true}) {
    for (const Mesh& mesh : {point, line, plate}) {
      RenderOptions options = front();  // the plate is seen edge-on
      options.perspective = perspective;
      EXPECT_EQ(render_one(mesh, options).rgb.size(), 3u * 96 * 80);
    }
  }
  RenderOptions above = front();
  above.view = {0, 0, -1};  // along `up`
  EXPECT_NE(pixel(render_one(icosphere(2), above), 48, 40), kWhite);
  RenderOptions least = front();
  least.width = least.height = 16;
  Panel panel{&plate, "a long label in a small picture", {0, 1, 2}, true};
  EXPECT_EQ(render({&panel, 1}, least).rgb.size(), 3u * 16 * 16);
}

// A body of relative size 1e-30 beside a sphere has no pixel and causes no overflow.
TEST(render, leaves_white_what_is_far_below_a_pixel) {
  const Mesh large = icosphere(2), small = moved(icosphere(2), 1e-30, {});
  for (const Mesh* first : {&large, &small}) {
    std::vector<Panel> panels(2);
    panels[0].mesh = first;
    panels[1].mesh = first == &large ? &small : &large;
    const Image image = render(panels, front());
    const int center_of_large = first == &large ? 24 : 72;
    EXPECT_NE(pixel(image, center_of_large, 40), kWhite);
    EXPECT_EQ(pixel(image, 96 - center_of_large, 40), kWhite);
  }
}

TEST(render, refuses_what_it_cannot_draw) {
  const Mesh good = icosphere(1), empty;
  const auto refused = [](const std::vector<Panel>& panels, const RenderOptions& options) {
    try {
      render(panels, options);
      return false;
    } catch (const Error& error) {
      return error.code() == ErrorCode::kInvalidInput;
    }
  };
  const Panel panel{&good, "", {}, false};
  EXPECT_FALSE(refused({panel}, front()));
  EXPECT_TRUE(refused({}, front()));
  EXPECT_TRUE(refused({Panel{}}, front()));
  EXPECT_TRUE(refused({Panel{&empty, "", {}, false}}, front()));
  EXPECT_TRUE(refused({Panel{&good, "", {1, 2}, false}}, front()));
  EXPECT_TRUE(refused(std::vector<Panel>(100, panel), front()));
  std::vector<double> scalars(good.vertices.size(), 1.0);
  const auto with = [&](auto change) {
    RenderOptions options = front();
    change(options);
    return refused({Panel{&good, "", scalars, false}}, options);
  };
  EXPECT_TRUE(with([](RenderOptions& o) { o.width = 15; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.height = 16385; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.samples = 0; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.samples = 17; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.occlusion_rays = -1; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.view = {}; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.up = {0, std::nan(""), 1}; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.scale_min = o.scale_max = 2; }));
  EXPECT_TRUE(with([](RenderOptions& o) { o.scale_max = double{INFINITY}; }));
  scalars[3] = std::nan("");
  EXPECT_TRUE(with([](RenderOptions&) {}));
}

TEST(render, can_be_cancelled) {
  const Context context = {.progress = [](std::string_view, double part) { return part < 0.3; }};
  const Mesh mesh = icosphere(2);
  EXPECT_THROW(render_one(mesh, front(), context), Error);
}

Image render_points(const PointCloud& cloud, double radius, const RenderOptions& options = front(),
                    const Context& context = {}) {
  const Panel panel{.points = &cloud, .point_radius = radius};
  return render({&panel, 1}, options, context);
}

// The unit sphere is drawn as a ball about one point, and as a fine mesh with its normals.
TEST(render, draws_a_point_as_a_ball) {
  Mesh sphere = icosphere(6);
  const char* const names[] = {"nx", "ny", "nz"};
  for (const char* name : names) {
    sphere.attributes.push_back({name, ScalarType::kFloat64, {}});
  }
  for (const Vec3& v : sphere.vertices) {
    sphere.attributes[0].values.push_back(v.x);
    sphere.attributes[1].values.push_back(v.y);
    sphere.attributes[2].values.push_back(v.z);
  }
  for (const bool perspective : {false, true}) {
    RenderOptions options = front();
    options.perspective = perspective;
    options.occlusion_rays = 0;
    const Panel mesh{.mesh = &sphere, .smooth = true};
    const Image expected = render({&mesh, 1}, options);
    const Image image = render_points({.points = {{3, 2, 1}}}, 1, options);
    int others = 0;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 96; ++x) {
        others += std::abs(brightness(image, x, y) - brightness(expected, x, y)) > 12;
      }
    }
    EXPECT_LT(others, 12);  // of some 230 pixels at the border, where rounding decides
  }
}

// 21 x 21 points on a grid: their default radius closes the square, a small radius does not.
TEST(render, closes_a_surface_of_points) {
  PointCloud cloud;
  for (int x = -10; x <= 10; ++x) {
    for (int z = -10; z <= 10; ++z) {
      cloud.points.push_back({static_cast<double>(x), 0, static_cast<double>(z)});
    }
  }
  const Image closed = render_points(cloud, 0), open = render_points(cloud, 0.1);
  int white_in_closed = 0, white_in_open = 0;
  for (int y = 20; y < 60; ++y) {
    for (int x = 28; x < 68; ++x) {
      white_in_closed += pixel(closed, x, y) == kWhite;
      white_in_open += pixel(open, x, y) == kWhite;
    }
  }
  EXPECT_EQ(white_in_closed, 0);
  EXPECT_GT(white_in_open, 800);
}

TEST(render, gives_points_their_colours_and_scalars) {
  const PointCloud cloud{.points = {{-1, 0, 0}, {1, 0, 0}}};
  Panel panel{.points = &cloud, .point_radius = 0.8};
  panel.colors = {{1, 0, 0}, {0, 0, 1}};
  const Image image = render({&panel, 1}, front());
  const auto left = pixel(image, 24, 40), right = pixel(image, 72, 40);
  EXPECT_GT(left[0], 150);
  EXPECT_EQ(left[2], 0);
  EXPECT_GT(right[2], 150);
  EXPECT_EQ(right[0], 0);
  panel.colors.clear();
  panel.scalars = {0, 1};  // dark blue, yellow
  const Image scale = render({&panel, 1}, front());
  EXPECT_LT(brightness(scale, 24, 33), brightness(scale, 72, 33));
}

TEST(render, draws_points_alike_for_any_number_of_threads) {
  const PointCloud cloud = sample_surface(icosphere(3), {.points = 3000});
  EXPECT_EQ(render_points(cloud, 0, front(), {.threads = 1}).rgb,
            render_points(cloud, 0, front(), {.threads = 2}).rgb);
}

TEST(render, draws_degenerate_points) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const std::vector<std::vector<Vec3>> clouds = {{{1, 2, 3}},
                                                 {{1, 2, 3}, {1, 2, 3}},
                                                 {{0, 0, 0}, {1, 0, 0}},
                                                 {{-kMost, 0, 0}, {kMost, kMost, 0}},
                                                 {{1e-320, 0, 0}, {0, 1e-320, 0}},
                                                 {{1e9, 0, 0}, {1e9 + 1, 0, 0}}};
  for (const std::vector<Vec3>& points : clouds) {
    for (const double radius : {0.0, 1e-300, 1.0, 1e300}) {
      for (const bool perspective : {false, true}) {
        RenderOptions options = front();
        options.perspective = perspective;
        EXPECT_EQ(render_points({.points = points}, radius, options).rgb.size(), 3u * 96 * 80);
      }
    }
  }
}

TEST(render, refuses_points_that_it_cannot_draw) {
  const PointCloud good{.points = {{0, 0, 0}}}, none, bad{.points = {{NAN, 0, 0}}};
  const Mesh mesh = icosphere(1);
  const auto refused = [](const Panel& panel) {
    try {
      render({&panel, 1}, front());
      return false;
    } catch (const Error& error) {
      return error.code() == ErrorCode::kInvalidInput;
    }
  };
  EXPECT_FALSE(refused({.points = &good}));
  EXPECT_TRUE(refused({.points = &none}));
  EXPECT_TRUE(refused({.points = &bad}));
  EXPECT_TRUE(refused({.mesh = &mesh, .points = &good}));
  EXPECT_TRUE(refused({.points = &good, .point_radius = -1}));
  EXPECT_TRUE(refused({.points = &good, .point_radius = NAN}));
  EXPECT_TRUE(refused({.scalars = {1, 2}, .points = &good}));
  EXPECT_TRUE(refused({.colors = {{1, 1, 1}, {0, 0, 0}}, .points = &good}));
}

// A ray through a point of the picture plane projects back to it, from any position on the ray.
TEST(view, projects_its_rays_to_points) {
  for (const bool perspective : {false, true}) {
    RenderOptions options;
    options.perspective = perspective;
    const View view = make_view(options, 1.5);
    EXPECT_NEAR(dot(view.right, view.up), 0, 1e-15);
    EXPECT_NEAR(dot(view.right, view.forward), 0, 1e-15);
    EXPECT_GT(view.up.z, 0);
    for (const PlanePoint& p : {PlanePoint{0, 0}, PlanePoint{1, -0.5}, PlanePoint{-0.2, 1.3}}) {
      const Ray ray = view.ray(p);
      for (const double t : {4.5, 6.0, 8.0}) {
        const PlanePoint q = view.project(ray.origin + t * ray.direction);
        EXPECT_NEAR(q.x, p.x, 1e-14);
        EXPECT_NEAR(q.y, p.y, 1e-14);
      }
    }
  }
}

}  // namespace
}  // namespace rholm
