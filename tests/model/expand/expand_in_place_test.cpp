// Reasons why a mesh cannot be expanded in place, and the ways that are then taken.
#include "model/expand/expand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "io/shapes/test_support.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/primitives.h"
#include "rholm/shape_io.h"
#include "rholm/topology.h"
#include "support/oracle.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

constexpr ExpandOptions kOptions{.degree = 8, .precision = 1e-9};

ExpandOptions about(const Vec3& center) {
  ExpandOptions options = kOptions;
  options.chart.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0};
  return options;
}

// Numbers of stages that were begun; a stage begins by reporting 0.
struct Stages {
  int center = 0, topology = 0;
  Context context() {
    return {.threads = 1, .progress = [this](std::string_view stage, double fraction) {
              center += stage == "center" && fraction == 0;
              topology += stage == "topology" && fraction == 0;
              return true;
            }};
  }
};

NotInPlace reason_of(const Mesh& mesh, const ExpandOptions& options = kOptions) {
  const auto result = expand_in_place(view_of(mesh), options, {}, {});
  if (const NotInPlace* reason = std::get_if<NotInPlace>(&result)) return *reason;
  ADD_FAILURE() << "expanded in place";
  return {};
}

ErrorCode code_of(const Mesh& mesh, const ExpandOptions& options = kOptions) {
  try {
    expand(mesh, options);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

TEST(expand_in_place, leaves_welding_and_other_methods) {
  const Mesh mesh = bumpy_sphere(2);
  ExpandOptions welding = kOptions, direct = kOptions, gauge = kOptions;
  welding.weld_tolerance = 1e-9;
  direct.engine = Engine::kDirect;
  gauge.method = Method::kGauge;
  for (const ExpandOptions& options : {welding, direct, gauge}) {
    EXPECT_EQ(reason_of(mesh, options), NotInPlace::kOptions);
    Stages stages;
    EXPECT_TRUE(expand(mesh, options, stages.context()).star.star_shaped);
    EXPECT_EQ(stages.topology, 1);
  }
}

TEST(expand_in_place, has_no_use_for_what_is_no_surface) {
  Mesh none = bumpy_sphere(2), far = none, unnumbered = none, flat = none;
  none.faces.clear();
  far.faces[7][1] = static_cast<std::uint32_t>(far.vertices.size());
  unnumbered.vertices[7].y = std::numeric_limits<double>::quiet_NaN();
  for (Vec3& v : flat.vertices) v = {1, 2, 3};
  for (const Mesh& mesh : {none, far, unnumbered, flat}) {
    EXPECT_EQ(reason_of(mesh), NotInPlace::kUnusable);
    EXPECT_EQ(code_of(mesh), ErrorCode::kInvalidInput);
  }
  // Only the passes run, without the search for a centre.
  for (const Mesh& mesh : {none, far, unnumbered}) {
    EXPECT_EQ(reason_of(mesh, about({})), NotInPlace::kUnusable);
  }
}

TEST(expand_in_place, has_no_use_for_faces_that_a_hook_refuses) {
  const Mesh mesh = bumpy_sphere(2);
  MeshPassOptions hooks;
  hooks.check = [](std::size_t, std::size_t) -> bool {
    throw Error(ErrorCode::kInvalidInput, "a face is not a triangle");
  };
  const auto result = expand_in_place(view_of(mesh), kOptions, hooks, {});
  EXPECT_EQ(std::get<NotInPlace>(result), NotInPlace::kUnusable);
}

TEST(expand_in_place, needs_a_point_that_sees_all_faces) {
  const Mesh mesh = torus(1, 0.3, 24, 12);
  EXPECT_EQ(reason_of(mesh), NotInPlace::kNoCenter);
  EXPECT_EQ(code_of(mesh), ErrorCode::kNotStarShaped);
}

TEST(expand_in_place, needs_a_closed_surface_that_is_oriented_alike) {
  Mesh open = bumpy_sphere(3), misoriented = open;
  open.faces.pop_back();
  std::swap(misoriented.faces[5][0], misoriented.faces[5][1]);
  EXPECT_EQ(reason_of(open), NotInPlace::kNotClosed);
  EXPECT_EQ(code_of(open), ErrorCode::kInvalidInput);
  EXPECT_EQ(reason_of(misoriented, about({})), NotInPlace::kNotClosed);
  EXPECT_EQ(code_of(misoriented, about({})), ErrorCode::kInvalidInput);
}

TEST(expand_in_place, leaves_turning_to_prepare) {
  Mesh mesh = bumpy_sphere(3);
  flip(mesh);
  EXPECT_EQ(reason_of(mesh, about({})), NotInPlace::kInsideOut);
  EXPECT_TRUE(expand(mesh, about({})).flipped);
}

TEST(expand_in_place, takes_folds_where_they_are_allowed) {
  const Mesh prism = test::l_prism(1);
  ExpandOptions options = about({2, 0.5, 0.1});
  EXPECT_EQ(reason_of(prism, options), NotInPlace::kFolded);
  EXPECT_EQ(code_of(prism, options), ErrorCode::kNotStarShaped);
  options.chart.allow_signed = true;
  EXPECT_TRUE(std::holds_alternative<Expanded>(expand_in_place(view_of(prism), options, {}, {})));
  // An alternating sum has no error that could be kept within a tolerance.
  options.tolerance = Tolerance{.error = 0.1};
  EXPECT_EQ(reason_of(prism, options), NotInPlace::kFolded);
  EXPECT_EQ(code_of(prism, options), ErrorCode::kInvalidInput);
}

TEST(expand_in_place, sees_a_second_sheet) {
  Mesh around = icosphere(0);
  for (Vec3& v : around.vertices) v *= 3;
  const Mesh mesh = test::joined(bumpy_sphere(4), around);
  EXPECT_EQ(reason_of(mesh, about({})), NotInPlace::kCoveredTwice);
  EXPECT_EQ(code_of(mesh, about({})), ErrorCode::kNotStarShaped);
}

void expect_same_bits(const Expanded& a, const Expanded& b) {
  const Expansion &x = a.transform.expansion, &y = b.transform.expansion;
  EXPECT_TRUE(std::ranges::equal(x.coefficients.values(), y.coefficients.values()));
  EXPECT_EQ(x.center, y.center);
  EXPECT_EQ(x.norm_squared, y.norm_squared);
  EXPECT_EQ(x.tail_strength, y.tail_strength);
  EXPECT_EQ(x.precision, y.precision);
  EXPECT_EQ(x.signed_sum, y.signed_sum);
  ASSERT_EQ(x.errors.has_value(), y.errors.has_value());
  if (x.errors) {
    EXPECT_EQ(x.errors->rms, y.errors->rms);
    EXPECT_EQ(x.errors->measured_max, y.errors->measured_max);
    EXPECT_EQ(x.errors->predicted_max, y.errors->predicted_max);
  }
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.star.star_shaped, b.star.star_shaped);
  EXPECT_EQ(a.star.multiple_share, b.star.multiple_share);
}

// The centre is searched for or given, and in one case the degree is searched for.
std::vector<ExpandOptions> several_ways() {
  ExpandOptions volume = kOptions, tolerance = kOptions;
  volume.chart.center.kind = CenterKind::kVolume;
  tolerance.tolerance = Tolerance{.error = 0.02, .norm = ErrorNorm::kMax};
  return {kOptions, about({0.01, 0.02, 0}), volume, tolerance};
}

TEST(expand, a_turned_mesh_gives_the_bits_of_one_that_is_outward) {
  const Mesh mesh = test::rotated(bumpy_sphere(3));
  Mesh inward = mesh;
  flip(inward);
  for (const ExpandOptions& options : several_ways()) {
    const Expanded turned = expand(inward, options);
    EXPECT_TRUE(turned.flipped);
    expect_same_bits(turned, expand(mesh, options));
  }
}

TEST(expand, a_welded_mesh_gives_the_bits_of_one_without_seams) {
  const Mesh mesh = test::rotated(bumpy_sphere(3));
  Mesh soup;
  for (const Triangle& t : mesh.faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t i : t) {
      const auto apart = static_cast<double>(soup.vertices.size() % 5);
      soup.vertices.push_back((1 + 1e-12 * apart) * mesh.vertices[i]);
    }
    soup.faces.push_back({first, first + 1, first + 2});
  }
  constexpr double kWeld = 1e-9;
  for (ExpandOptions options : several_ways()) {
    options.weld_tolerance = 0;
    EXPECT_THROW(expand(soup, options), Error);
    const Expanded expected = expand(outward(soup, kWeld).welded.mesh, options);
    options.weld_tolerance = kWeld;
    const Expanded welded = expand(soup, options);
    EXPECT_EQ(welded.merged_vertices, soup.vertices.size() - mesh.vertices.size());
    expect_same_bits(welded, expected);
  }
}

// Compares with direct sums on a chart.
TEST(expand, a_turned_surface_that_folds_has_the_wanted_precision) {
  const std::pair<Mesh, ExpandOptions> cases[] = {
      {test::l_prism(1), about({2, 0.5, 0.1})},
      {test::rotated(torus(2, 0.5, 40, 20)), kOptions}};  // has an empty kernel
  for (auto [mesh, options] : cases) {
    Mesh inward = mesh;
    flip(inward);
    options.chart.allow_signed = true;
    options.chart.center.rays = 2000;
    const Expanded turned = expand(inward, options);
    EXPECT_TRUE(turned.flipped);
    EXPECT_TRUE(turned.transform.expansion.signed_sum);
    expect_same_bits(turned, expand(mesh, options));
    options.engine = Engine::kDirect;
    EXPECT_LT(test::relative_error(turned.transform.expansion.coefficients,
                                   expand(inward, options).transform.expansion.coefficients),
              2 * options.precision);
  }
}

constexpr ErrorCode kNotOfTheMesh[] = {ErrorCode::kIo, ErrorCode::kOutOfMemory,
                                       ErrorCode::kUnsupported, ErrorCode::kNotConverged,
                                       ErrorCode::kCancelled};

// After a file that can no longer be read, or refused memory, nothing is tried again.
TEST(expand_in_place, passes_on_at_once_what_is_no_fault_of_the_mesh) {
  const Mesh mesh = bumpy_sphere(3);
  for (const ErrorCode code : kNotOfTheMesh) {
    MeshPassOptions hooks;
    hooks.check = [&](std::size_t, std::size_t) -> bool { throw Error(code, "of the hook"); };
    try {
      expand_in_place(view_of(mesh), kOptions, hooks, {});
      ADD_FAILURE() << to_string(code);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      EXPECT_STREQ(error.what(), "of the hook");
    }
  }
}

TEST(expand, passes_on_at_once_what_is_no_fault_of_the_mesh) {
  const Mesh mesh = bumpy_sphere(3);
  for (const ErrorCode code : kNotOfTheMesh) {
    bool again = false;
    const Context context{.progress = [&](std::string_view stage, double) -> bool {
      again = again || stage == "topology";
      if (stage == "transform") throw Error(code, "of the caller");
      return true;
    }};
    try {
      expand(mesh, kOptions, context);
      ADD_FAILURE() << to_string(code);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
    }
    EXPECT_FALSE(again) << to_string(code);
  }
}

TEST(expand, refuses_options_out_of_range_before_all_work) {
  const Mesh mesh = bumpy_sphere(3);
  ExpandOptions degree = kOptions, precision = kOptions, tolerance = kOptions, most = kOptions;
  degree.degree = -1;
  precision.precision = 1;
  tolerance.tolerance = Tolerance{.error = 0};
  most.tolerance = Tolerance{.error = 1, .max_degree = -1};
  for (const ExpandOptions& options : {degree, precision, tolerance, most}) {
    Stages stages;
    EXPECT_THROW(expand(mesh, options, stages.context()), Error);
    EXPECT_EQ(stages.center + stages.topology, 0);
  }
}

// A fault of the mesh in the file is also a fault in memory: the mesh is prepared at once.
TEST(expand_file, does_not_try_a_second_time_what_the_mesh_cannot) {
  Mesh open = bumpy_sphere(3);
  open.faces.pop_back();
  const testing::TemporaryFolder folder;
  write_shape(open, folder / "m.ply");
  Stages stages;
  EXPECT_THROW(expand_file(folder / "m.ply", kOptions, stages.context()), Error);
  EXPECT_EQ(stages.center, 1);  // the chart starts no second search
  EXPECT_EQ(stages.topology, 1);
}

TEST(expand_file, asks_the_caller_to_read_only_what_cannot_stay_in_the_file) {
  const testing::TemporaryFolder folder;
  Mesh closed = bumpy_sphere(3), open = closed;
  open.faces.pop_back();
  write_shape(closed, folder / "closed.ply");
  write_shape(open, folder / "open.ply");
  int reads = 0;
  const auto reader = [&](const Mesh& mesh) { return [&reads, &mesh] { return ++reads, mesh; }; };
  const Expanded expanded = expand_file(folder / "closed.ply", kOptions, {}, reader(closed));
  EXPECT_EQ(reads, 0);
  EXPECT_TRUE(expanded.times.contains("read"));
  Stages stages;
  EXPECT_THROW(expand_file(folder / "open.ply", kOptions, stages.context(), reader(open)), Error);
  EXPECT_EQ(reads, 1);
  EXPECT_EQ(stages.center, 1);
}

}  // namespace
}  // namespace rholm
