#include "surface/star/compare_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

Comparison compare_in_portions(const MeshInPlace& a, const MeshInPlace& b, std::size_t triangles,
                               const CompareOptions& options, const Context& context) {
  CompareSamples samples(a, b, triangles, options, context);
  return compare(samples, context);
}

void expect_same(const Distances& a, const Distances& b) {
  EXPECT_EQ(a.rms, b.rms);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.max, b.max);
}

void expect_same(const Comparison& a, const Comparison& b) {
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.diagonal, b.diagonal);
  expect_same(a.a_to_b, b.a_to_b);
  expect_same(a.b_to_a, b.b_to_a);
  EXPECT_EQ(a.hausdorff, b.hausdorff);
  EXPECT_EQ(a.threshold, b.threshold);
  EXPECT_EQ(a.precision, b.precision);
  EXPECT_EQ(a.recall, b.recall);
  EXPECT_EQ(a.f_score, b.f_score);
  EXPECT_EQ(a.normal_median_degrees, b.normal_median_degrees);
  EXPECT_EQ(a.normal_mean_degrees, b.normal_mean_degrees);
}

// Compares in memory and in portions of one triangle up to all, on one and several threads.
void expect_the_same_in_portions(const Mesh& a, const Mesh& b, const CompareOptions& options) {
  const Comparison expected = compare(a, b, options);
  const std::size_t all = std::max(a.faces.size(), b.faces.size());
  for (const std::size_t triangles : {std::size_t{1}, std::size_t{7}, all / 3 + 1, all}) {
    if (all / triangles > 2000) continue;  // would take a second
    for (const int threads : {1, 3}) {
      SCOPED_TRACE(std::to_string(triangles) + " triangles, threads " + std::to_string(threads));
      expect_same(compare_in_portions({.mesh = view_of(a)}, {.mesh = view_of(b)}, triangles,
                                      options, {.threads = threads}),
                  expected);
    }
  }
}

Mesh moved(Mesh mesh, double scale, const Vec3& offset) {
  for (Vec3& vertex : mesh.vertices) vertex = scale * vertex + offset;
  return mesh;
}

// Returns triangles in an order unrelated to their positions.
Mesh shuffled(Mesh mesh) {
  const std::size_t n = mesh.faces.size();
  for (std::size_t t = 0; t < n; ++t) std::swap(mesh.faces[t], mesh.faces[t * 7919 % n]);
  return mesh;
}

TEST(compare_in_portions, has_the_bits_of_a_comparison_in_memory) {
  const Mesh a = bumpy_sphere(3, 0.4), b = moved(icosphere(3), 1.1, {0.1, 0.2, -0.1});
  expect_the_same_in_portions(a, b, {.samples = 3000, .seed = 5});
  expect_the_same_in_portions(shuffled(a), shuffled(b), {.samples = 1000, .seed = 6});
  expect_the_same_in_portions(box({1, 2, 3}), a, {.samples = 700});
  expect_the_same_in_portions(a, moved(a, 1, {1e3, 0, 0}), {.samples = 50});
}

// On edges and faces of cubes whose triangles occur twice, two triangles are equally near. They
// differ in their normals, which the median and the mean contain.
TEST(compare_in_portions, ties_go_to_the_same_triangles) {
  Mesh a = box({2, 2, 2}, 4), b = moved(a, 0.7, {0.123, 0.456, 0.789});
  for (Mesh* mesh : {&a, &b}) {
    const std::vector<Triangle> once = mesh->faces;
    for (const Triangle& t : once) mesh->faces.push_back({t[0], t[2], t[1]});
    mesh->faces.insert(mesh->faces.end(), once.begin(), once.end());
  }
  expect_the_same_in_portions(a, b, {.samples = 2000});
  expect_the_same_in_portions(a, a, {.samples = 2000});
  const Mesh above = moved(box({0.5, 0.5, 0.5}), 1, {0, 0, 3});
  expect_the_same_in_portions(above, b, {.samples = 2000});
}

TEST(compare_in_portions, takes_degenerate_triangles_and_any_scale) {
  Mesh mesh = bumpy_sphere(2, 0.5);
  for (std::size_t t = 0; t < 40; ++t) mesh.faces[7 * t] = {0, 0, 1};
  for (std::size_t t = 0; t < 9; ++t) mesh.faces.push_back({2, 3, 3});  // the last faces
  mesh.vertices.push_back({3, 3, 3});                                   // belongs to no triangle
  const Mesh other = icosphere(2);
  for (const double scale : {1.0, 1e-200, 1e200}) {
    expect_the_same_in_portions(moved(mesh, scale, {}), moved(other, scale, {}), {.samples = 500});
  }
  expect_the_same_in_portions(mesh, moved(other, 1e-12, {}), {.samples = 300});
}

// Rows of a file: floats with other bytes before and after.
TEST(compare_in_portions, takes_rows_of_any_kind_and_releases_them) {
  const Mesh a = bumpy_sphere(3, 0.4);
  std::vector<std::byte> vertices(31 * a.vertices.size() + 3), triangles(13 * a.faces.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    const Vec3& v = a.vertices[i];
    const float row[3] = {static_cast<float>(v.x), static_cast<float>(v.y),
                          static_cast<float>(v.z)};
    std::memcpy(vertices.data() + 31 * i + 3, row, sizeof row);
  }
  for (std::size_t t = 0; t < a.faces.size(); ++t) {
    std::memcpy(triangles.data() + 13 * t + 1, a.faces[t].data(), 12);
  }
  std::vector<int> released(a.faces.size());
  std::size_t vertices_released = 0;
  const MeshInPlace place{.mesh = {.vertices = vertices.data() + 3,
                                   .n_vertices = a.vertices.size(),
                                   .vertex_stride = 31,
                                   .coordinate = ScalarType::kFloat32,
                                   .faces = triangles.data() + 1,
                                   .n_faces = a.faces.size(),
                                   .face_stride = 13},
                          .release_vertices =
                              [&](std::size_t first, std::size_t n) {
                                ASSERT_LE(first + n, a.vertices.size());
                                vertices_released += n;
                              },
                          .release_faces =
                              [&](std::size_t first, std::size_t n) {
                                for (std::size_t t = first; t < first + n; ++t) ++released[t];
                              }};
  const Mesh b = icosphere(3), rounded = mesh_of(place.mesh);
  const CompareOptions options{.samples = 900};
  expect_same(compare_in_portions(place, {.mesh = view_of(b)}, 100, options, {}),
              compare(rounded, b, options));
  // Passes for indices, areas, samples, scouts, and closest points.
  EXPECT_GE(*std::min_element(released.begin(), released.end()), 4);
  EXPECT_GE(vertices_released, 4 * a.vertices.size());
  // Once with everything in memory, once with as little as possible.
  for (const std::size_t memory : {std::size_t{0}, std::size_t{1} << 40}) {
    expect_same(compare(place, {.mesh = view_of(b)}, memory, options),
                compare(rounded, b, options));
  }
}

void expect_refused(const Mesh& a, const Mesh& b, const CompareOptions& options,
                    const std::vector<std::string>& words) {
  try {
    compare_in_portions({.mesh = view_of(a)}, {.mesh = view_of(b)}, 10, options, {});
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    for (const std::string& word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST(compare_in_portions, refuses_what_a_comparison_refuses) {
  const Mesh good = icosphere(1);
  Mesh bad = good;
  bad.faces[50][1] = 42;
  expect_refused(good, bad, {}, {"B", "50", "42"});
  expect_refused(bad, good, {}, {"A", "50", "42"});
  bad = good;
  bad.vertices[7].y = NAN;
  expect_refused(bad, good, {}, {"A", "vertex 7"});
  Mesh flat = good;
  flat.faces = {{0, 0, 1}};
  expect_refused(flat, good, {}, {"area 0"});
  expect_refused(good, flat, {}, {"area 0"});
  expect_refused(good, {}, {}, {"area 0"});
  expect_refused(good, good, {.samples = 0}, {"samples"});
  expect_refused(good, good, {.threshold = -1}, {"threshold"});
}

TEST(compare_in_portions, can_be_cancelled) {
  const Mesh a = bumpy_sphere(4, 0.4), b = icosphere(4);
  double last = 0;
  int calls = 0;
  const auto run = [&](int most) {
    calls = 0;
    last = 0;
    compare_in_portions({.mesh = view_of(a)}, {.mesh = view_of(b)}, 500, {.samples = 2000},
                        {.progress = [&](std::string_view stage, double fraction) {
                          if (!stage.empty()) {
                            EXPECT_GE(fraction, last);
                            last = fraction;
                          }
                          return ++calls < most;
                        }});
  };
  run(1 << 30);
  EXPECT_EQ(last, 1);
  const int all = calls;
  for (const int most : {1, all / 2, all}) EXPECT_THROW(run(most), Error) << most;
}

// Portions are as large as allowed, but never too small to be efficient.
TEST(triangles_of_portion, follow_the_memory) {
  EXPECT_EQ(triangles_of_portion(0, 0), triangles_of_portion(1000, 1 << 20));
  EXPECT_LE(triangles_of_portion(0, 0) * 163, 3u << 20);
  const std::size_t gib = std::size_t{1} << 30;
  EXPECT_LE(triangles_of_portion(0, gib) * 163, gib);
  EXPECT_GT(triangles_of_portion(0, gib) * 170, gib);
  EXPECT_LT(triangles_of_portion(gib, gib), triangles_of_portion(0, gib));
}

}  // namespace
}  // namespace rholm
