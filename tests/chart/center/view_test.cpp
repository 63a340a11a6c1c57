// Centres and checks of meshes in memory of the caller, compared with slow, plain computations.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "chart/center/kernel.h"
#include "chart/center/linear_program.h"
#include "chart/center/slope_scan.h"
#include "chart/center/view_center.h"
#include "chart/center/view_scan.h"
#include "chart/star/cone.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "shape/measure.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/targets.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::l_prism;
using test::moved;
using test::packed;
using test::PackedMesh;
using test::random_direction;
using test::unpacked;

const Context kOneThread{.threads = 1, .progress = {}};

LocalView local(const MeshView& mesh) { return local_view(mesh, kOneThread); }

// Calls `run` with each instruction set of this machine.
template <class Test>
void for_each_target(const Test& run) {
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    run();
  });
}

// Returns a sphere with noise: all normals are inexact, and faces of all depths are near the
// optimum.
Mesh rough_sphere(int subdivisions, double noise) {
  Mesh mesh = icosphere(subdivisions);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i] *= 1 + test::random_in(-noise, noise, 7, i);
  }
  return mesh;
}

Mesh shuffled(Mesh mesh) {
  for (std::size_t i = mesh.faces.size() - 1; i > 0; --i) {
    const double u = random_uniform(5, i);
    std::swap(mesh.faces[i], mesh.faces[static_cast<std::size_t>(u * static_cast<double>(i + 1))]);
  }
  return mesh;
}

// Returns a sphere and one small face that looks along x from -0.4. It moves the best centre far,
// to (-0.7, 0, 0). A sample of every second face, or of fewer, does not contain this face.
Mesh cut_sphere(int subdivisions) {
  Mesh mesh = icosphere(subdivisions);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : {Vec3{-0.4, 0, 0}, {-0.4, 0.01, 0}, {-0.4, 0, 0.01}}) {
    mesh.vertices.push_back(v);
  }
  mesh.faces.insert(mesh.faces.begin() + 7, {first, first + 1, first + 2});
  return mesh;
}

// Solves the linear program with all faces at once.
double best_distance(const LocalView& view) {
  LinearProgram program(1.0625, 4);
  for (std::size_t t = 0; t < view.mesh.n_faces; ++t) {
    const FacePlane face = view.plane(t);
    if (face.exists()) program.add({.a = face.normal, .lift = 1, .bound = face.most_distance({})});
  }
  EXPECT_TRUE(program.solve());
  return program.top();
}

double smallest_distance(const LocalView& view, const Vec3& center) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < view.mesh.n_faces; ++t) {
    const FacePlane face = view.plane(t);
    if (face.exists()) smallest = std::min(smallest, face.distance(center));
  }
  return smallest;
}

TEST(chebyshev_center, is_that_of_the_program_with_all_faces) {
  const Mesh shapes[] = {bumpy_sphere(5, 0.3),  shuffled(bumpy_sphere(5, 0.3)),
                         rough_sphere(5, 0.01), rough_sphere(5, 1e-5),
                         rough_sphere(5, 0.1),  // its kernel is empty
                         torus(2, 0.5, 60, 40), icosphere(5),
                         cut_sphere(5)};
  for (const Mesh& mesh : shapes) {
    const PackedMesh floats = packed<float>(mesh), doubles = packed<double>(mesh, 5);
    for (const MeshView& view : {view_of(mesh), floats.view, doubles.view}) {
      const LocalView seen = local(view);
      const KernelCenter center = chebyshev_center(seen, kOneThread);
      // The search and its bound each have a gap of 1e-12.
      EXPECT_NEAR(center.value, best_distance(seen), 2e-12);
      EXPECT_NEAR(center.value, smallest_distance(seen, center.point), 1e-14);
    }
  }
}

TEST(chebyshev_center, is_the_same_with_all_vector_instructions_and_any_number_of_threads) {
  const PackedMesh mesh = packed<float>(bumpy_sphere(6, 0.3));
  const KernelCenter one = chebyshev_center(local(mesh.view), kOneThread);
  for_each_target([&] {
    for (const int threads : {1, 2, 4}) {
      const Context context{.threads = threads, .progress = {}};
      const KernelCenter other = chebyshev_center(local(mesh.view), context);
      EXPECT_LE(norm(other.point - one.point), 1e-14);
      EXPECT_NEAR(other.value, one.value, 1e-14);
    }
  });
}

// The bounds of the first pass prove the next optimum: the second pass reads few faces.
TEST(chebyshev_center, of_a_smooth_shape_takes_little_more_than_one_pass) {
  const PackedMesh mesh = packed<float>(bumpy_sphere(7, 0.3));  // 328 000 faces
  EXPECT_LT(chebyshev_center(local(mesh.view), kOneThread).scans, 1.5);
}

TEST(chebyshev_center, follows_floats_to_the_ends_of_their_range_and_far_away) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const PackedMesh here = packed<float>(mesh);
  const KernelCenter center = chebyshev_center(local(here.view), kOneThread);
  for (const int exponent : {-100, -20, 20, 126}) {  // powers of two leave all digits unchanged
    const PackedMesh there =
        packed<float>(moved(mesh, {.scale = std::ldexp(1, exponent), .shift = {}}));
    const KernelCenter other = chebyshev_center(local(there.view), kOneThread);
    EXPECT_EQ(other.point, center.point);
    EXPECT_EQ(other.value, center.value);
  }
  for (const double shift : {1e3, 1e6}) {
    const PackedMesh far = packed<float>(moved(mesh, {.shift = {shift, -shift, shift}}));
    const LocalView seen = local(far.view);
    EXPECT_NEAR(chebyshev_center(seen, kOneThread).value, best_distance(seen), 2e-12);
  }
}

TEST(chebyshev_center, passes_over_faces_without_area) {
  Mesh mesh = bumpy_sphere(5, 0.3);
  const double best = chebyshev_center(local(view_of(mesh)), kOneThread).value;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    mesh.faces.push_back({i, i, i + 1});
    mesh.faces.push_back({i, i, i});
  }
  for (const Mesh& other : {mesh, shuffled(mesh)}) {
    EXPECT_NEAR(chebyshev_center(local(view_of(other)), kOneThread).value, best, 1e-12);
  }
}

// Checks that every triangle below a limit is visited, and only few others.
template <class T>
void expect_scan_complete(const Mesh& mesh, const Vec3& center, const ScanLimits& limits) {
  const PackedMesh bytes = packed<T>(mesh, sizeof(T) == 4 ? 0 : 3);
  const LocalView view = local(bytes.view);
  const std::size_t begin = 3, end = view.mesh.n_faces - 5;
  std::set<std::size_t> visited;
  scan_below(view, begin, end, center, limits, [&](std::size_t t) {
    EXPECT_TRUE(visited.empty() || t > *visited.rbegin());
    visited.insert(t);
  });
  std::size_t needed = 0;
  for (std::size_t t = begin; t < end; ++t) {
    const FacePlane face = view.plane(t);
    double cosine = 1;
    for (const Vec3& corner : view.corners(t)) {
      cosine = std::min(cosine, face.distance(center) / norm(corner - view.frame.center - center));
    }
    const bool below = face.distance(center) < limits.distance || cosine < limits.cosine;
    needed += below;
    EXPECT_TRUE(!face.exists() || !below || visited.contains(t)) << t;
  }
  EXPECT_LE(visited.size(), needed + needed / 100 + 2);
}

TEST(scan_below, visits_all_faces_below_the_limits_in_order) {
  const double none = -std::numeric_limits<double>::infinity();
  const Mesh mesh = rough_sphere(4, 0.05);
  const Vec3 center = {0.1, -0.05, 0.02};
  for_each_target([&] {
    for (const double limit : {-0.2, 0.0, 0.3, 0.45, 10.0}) {
      expect_scan_complete<float>(mesh, center, {.distance = limit, .cosine = none});
      expect_scan_complete<double>(mesh, center, {.distance = limit, .cosine = none});
    }
    for (const double limit : {-0.1, 0.0, 0.5, 0.9}) {
      expect_scan_complete<float>(mesh, center, {.distance = none, .cosine = limit});
      expect_scan_complete<double>(mesh, center, {.distance = 0.2, .cosine = limit});
    }
  });
}

// Compares ranges of 1 ... 33 faces that begin anywhere with a loop over single faces.
template <class T>
void expect_any_range(const Mesh& mesh) {
  const PackedMesh bytes = packed<T>(mesh);
  const LocalView view = local(bytes.view);
  const ScanLimits limits = {.distance = 0.4, .cosine = 0.5};
  for (std::size_t n = 1; n <= 33; ++n) {
    const std::size_t begin = 5 * n;
    std::vector<std::size_t> all, single;
    scan_below(view, begin, begin + n, {0.1, 0, 0}, limits,
               [&](std::size_t t) { all.push_back(t); });
    for (std::size_t t = begin; t < begin + n; ++t) {
      scan_below(view, t, t + 1, {0.1, 0, 0}, limits, [&](std::size_t i) { single.push_back(i); });
    }
    EXPECT_EQ(all, single) << n;
  }
}

TEST(view_scan, takes_any_number_of_faces) {
  const Mesh mesh = rough_sphere(3, 0.05);
  for_each_target([&] {
    expect_any_range<float>(mesh);
    expect_any_range<double>(mesh);
  });
}

// Returns area (rho / d - d / rho) of one face as seen from `from`, by one point in its middle.
double slope_of_face(const LocalView& view, std::size_t t, const Vec3& from) {
  const auto corners = view.corners(t);
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const Vec3 m = (corners[0] + corners[1] + corners[2]) / 3 - view.frame.center - from;
  const double rho = norm(m), d = dot(normal, m) / norm(normal);
  return norm(normal) / 2 * (rho / d - d / rho);
}

// Differences of sixth order; `h` is as small as rounding of the sums allows.
double rise_by_differences(const LocalView& view, std::size_t begin, std::size_t end,
                           const SlopeLine& line, double t) {
  constexpr double h = 0.01;
  constexpr double kWeights[] = {3.0 / 4, -3.0 / 20, 1.0 / 60};
  double rise = 0;
  for (std::size_t face = begin; face < end; ++face) {
    for (int k = 1; k <= 3; ++k) {
      const Vec3 above = line.middle + (t + k * h) * line.way;
      const Vec3 below = line.middle + (t - k * h) * line.way;
      rise += kWeights[k - 1] / h *
              (slope_of_face(view, face, above) - slope_of_face(view, face, below));
    }
  }
  return rise;
}

// Ranges have 1 ... 33 faces and begin anywhere.
template <class T>
void expect_rises(const Mesh& mesh) {
  const PackedMesh bytes = packed<T>(mesh);
  const LocalView view = local(bytes.view);
  const SlopeLine line = {.middle = {0.05, -0.02, 0.01}, .way = {0.1, 0.05, -0.1}, .least = 0.05};
  const Places places = {-0.3, 0.1, 0.4, 1};
  const auto none = [](std::size_t t) { ADD_FAILURE() << t; };
  for (std::size_t n = 1; n <= 33; ++n) {
    const std::size_t begin = 5 * n, end = begin + n;
    const Rises four = sum_rises(view, begin, end, line, places, kMostPlaces, none);
    EXPECT_FALSE(four.too_near);
    for (std::size_t k = 0; k < kMostPlaces; ++k) {
      const double expected = rise_by_differences(view, begin, end, line, places[k]);
      EXPECT_NEAR(four.sums[k], expected, 1e-10) << n << " " << k;
      const Rises one = sum_rises(view, begin, end, line, {places[k]}, 1, none);
      EXPECT_EQ(one.sums[0], four.sums[k]);
      EXPECT_EQ(one.sums[1], 0);
    }
  }
}

TEST(sum_rises, is_the_derivative_of_the_slope_of_any_number_of_faces) {
  const Mesh mesh = rough_sphere(4, 0.02);
  for_each_target([&] {
    expect_rises<float>(mesh);
    expect_rises<double>(mesh);
  });
}

TEST(sum_rises, tells_planes_that_are_too_near_and_visits_large_faces) {
  const PackedMesh bytes = packed<float>(cut_sphere(5));  // face 7 looks along x from -0.4
  const LocalView view = local(bytes.view);
  for_each_target([&] {
    std::vector<std::size_t> visited;
    const auto visit = [&](std::size_t t) { visited.push_back(t); };
    const double scale = view.frame.scale;
    SlopeLine line = {.middle = {-0.7 * scale, 0, 0}, .way = {scale, 0, 0}, .least = 0.1 * scale};
    const auto near = [&](const Places& places) {
      return sum_rises(view, 0, view.mesh.n_faces, line, places, kMostPlaces, visit).too_near;
    };
    EXPECT_FALSE(near({0, 0.05, 0.1, 0.19}));
    EXPECT_TRUE(near({0, 0.05, 0.1, 0.21}));
    EXPECT_TRUE(near({0.21, 0.1, 0.05, 0}));
    visited.clear();
    line.middle.x = -0.405 * scale;  // at this distance the face is large
    sum_rises(view, 0, view.mesh.n_faces, line, {0}, 1, visit);
    EXPECT_EQ(visited, (std::vector<std::size_t>{7}));
  });
}

TEST(volume_centroid, is_that_of_sums_one_after_the_other) {
  const Mesh mesh = rough_sphere(3, 0.05);
  for (std::uint64_t gap = 1; gap <= 33;
       ++gap) {  // any number of faces; the sum is defined for open meshes too
    Mesh some = mesh;
    some.faces.resize(mesh.faces.size() - gap);
    const PackedMesh floats = packed<float>(some), doubles = packed<double>(some, 5);
    for_each_target([&] {
      for (const MeshView& view : {floats.view, doubles.view}) {
        const UnitFrame frame = local(view).frame;
        const Vec3 expected = measure(view, frame).volume_centroid;
        EXPECT_LE(norm(volume_centroid(view, frame, kOneThread) - expected), 1e-14) << gap;
      }
    });
  }
}

TEST(scan_lines, finds_the_two_faces_on_every_line) {
  const PackedMesh floats = packed<float>(bumpy_sphere(4, 0.3));
  const PackedMesh doubles = packed<double>(bumpy_sphere(4, 0.3));
  for_each_target([&] {
    for (const MeshView& mesh : {floats.view, doubles.view}) {
      const LocalView view = local(mesh);
      for (std::uint64_t i = 0; i < 50; ++i) {
        const Vec3 center{0.1, 0, 0};
        std::set<std::size_t> crossed, along;
        for (std::size_t t = 0; t < mesh.n_faces; ++t) {
          const auto corners = corners_from(view, t, view.frame.to_shape(center));
          for (const int side : {1, -1}) {
            if (cone_contains(corners, side * random_direction(1, i)) != 0) crossed.insert(t);
          }
        }
        scan_lines(view, 0, mesh.n_faces, {0.1, 0, 0}, random_direction(1, i),
                   [&](std::size_t t) { along.insert(t); });
        EXPECT_EQ(along, crossed);
        EXPECT_EQ(along.size(), 2u);
      }
    }
  });
}

void expect_refused(const MeshView& view, const char* word) {
  try {
    find_center(view, {.rays = 0});
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(views, with_bad_indices_or_coordinates_are_refused_wherever_they_stand) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const double inf = std::numeric_limits<double>::infinity();
  for (const std::size_t place : {0, 1, 700, 5000, 5118, 5119}) {
    Mesh bad = mesh;
    bad.faces[place][place % 3] = static_cast<std::uint32_t>(mesh.vertices.size());
    expect_refused(packed<float>(bad).view, "names vertex 2562");
    bad.faces[place][place % 3] = ~std::uint32_t{0};
    expect_refused(packed<double>(bad).view, "names vertex -1");
  }
  for (const std::size_t place : {0, 1, 15, 16, 2000, 2560, 2561}) {
    for (const double value : {inf, -inf, std::nan("")}) {
      Mesh bad = mesh;
      bad.vertices[place].y = value;
      for_each_target([&] {
        expect_refused(packed<float>(bad).view, "not a finite number");
        expect_refused(packed<double>(bad).view, "not a finite number");
        expect_refused(packed<double>(bad, 1).view, "not a finite number");
      });
    }
  }
}

TEST(views, have_the_centre_and_the_report_of_the_mesh_they_show) {
  for (const Mesh& mesh : {bumpy_sphere(5, 0.3), l_prism(2), torus(2, 0.5, 40, 20)}) {
    const PackedMesh bytes = packed<float>(mesh, 2);
    const Mesh same = unpacked(bytes.view);
    for (const CenterKind kind : {CenterKind::kAuto, CenterKind::kSlope, CenterKind::kCosine,
                                  CenterKind::kNone, CenterKind::kCentroid, CenterKind::kVolume}) {
      const CenterOptions options{.kind = kind, .point = {}, .rays = 500};
      const StarReport a = find_center(same, options), b = find_center(bytes.view, options);
      // The cosine is promised to 1e-6.
      EXPECT_LE(norm(a.center - b.center), kind == CenterKind::kCosine ? 1e-4 : 1e-11);
      EXPECT_NEAR(a.min_d, b.min_d, 1e-5);
      EXPECT_EQ(a.star_shaped, b.star_shaped);
      EXPECT_NEAR(a.once_share, b.once_share, 0.003);
    }
  }
}

TEST(check_star, of_a_view_is_that_of_every_face) {
  const Mesh mesh = rough_sphere(4, 0.05);
  const PackedMesh bytes = packed<float>(mesh);
  const LocalView view = local(bytes.view);
  for (const Vec3& center : {Vec3{0.1, 0.2, 0.3}, Vec3{0, 0, 1}, Vec3{5, 0, 0}}) {
    double min_d = 4e9, min_cosine = 1;
    std::size_t bad = 0;
    for (std::size_t t = 0; t < view.mesh.n_faces; ++t) {
      const FacePlane face = view.plane(t);
      const double d = face.distance(view.frame.to_local(center));
      min_d = std::min(min_d, d / view.frame.scale);
      bad += d <= 0;
      for (const Vec3& corner : view.corners(t)) {
        const double length = norm(corner - view.frame.scale * center);
        min_cosine = std::min(min_cosine, d / length);
      }
    }
    for_each_target([&] {
      const StarReport report = check_star(bytes.view, center, 0, kOneThread);
      EXPECT_NEAR(report.min_d, min_d, 1e-14);
      EXPECT_NEAR(report.min_cos_gamma, min_cosine, 1e-13);
      EXPECT_EQ(report.bad_faces, bad);
      EXPECT_EQ(report.star_shaped, bad == 0);
    });
  }
}

}  // namespace
}  // namespace rholm
