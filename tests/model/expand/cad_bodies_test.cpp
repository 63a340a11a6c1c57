// Bodies of CAD programs with faces thinner than single precision resolves: centres are found as
// for the exact bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rholm/model.h"
#include "rholm/repair.h"
#include "rholm/simplify.h"
#include "rholm/star.h"
#include "support/cad_bodies.h"

namespace rholm {
namespace {

using test::cad_body;
using test::CadBody;
using test::CadRarity;

constexpr int kBodies = 300;

// Checks bodies that are closed.
void expect_is_seen_from_the_centre_of_the_exact_body(int i) {
  const CadBody body = cad_body(i);
  if (body.junctions) return;
  // The bound is 1 % of the radius of a ball of the same volume.
  const double allowed = 0.01 * std::cbrt(0.239 * enclosed_volume(body.exact));
  for (const CenterKind kind : {CenterKind::kAuto, CenterKind::kKernel, CenterKind::kVolume}) {
    SCOPED_TRACE(body.name + " " + std::to_string(i) + ", centre " +
                 std::to_string(static_cast<int>(kind)));
    const CenterOptions options{.kind = kind, .point = {}, .rays = 0};
    const StarReport exact = find_center(body.exact, options);
    const StarReport seen = find_center(body.written, options);
    ASSERT_TRUE(exact.star_shaped);
    EXPECT_TRUE(seen.star_shaped);
    EXPECT_LT(norm(seen.center - exact.center), allowed);
  }
}

TEST(CadBodies, are_seen_as_star_shaped_from_the_centre_of_the_exact_body) {
  std::size_t thin = 0;
  for (int i = 0; i < kBodies; i += RHOLM_CAD_STEP) {
    expect_is_seen_from_the_centre_of_the_exact_body(i);
    thin += inspect(cad_body(i).written).degenerate_faces;
  }
  EXPECT_GT(thin, 0u);
}

// Rounding turns coplanar faces against each other, so that the linear program for the centre of
// the kernel does not end by the rules of exact planes.
TEST(CadBodies, are_seen_where_faces_of_one_side_are_turned_against_each_other) {
  for (const int i : {78, 148, 187, 229, 254, 257}) {
    expect_is_seen_from_the_centre_of_the_exact_body(i);
  }
}

void expect_is_repaired(int i, CadRarity rarity) {
  const CadBody body = cad_body(i, rarity);
  SCOPED_TRACE(body.name + " " + std::to_string(i));
  const Repaired repaired = repair(body.written);
  EXPECT_EQ(repaired.report.after.degenerate_faces, 0u);
  const Repaired again = repair(repaired.mesh);
  EXPECT_TRUE(again.mesh.vertices == repaired.mesh.vertices);
  EXPECT_TRUE(again.mesh.faces == repaired.mesh.faces);
  EXPECT_TRUE(repaired.report.after.closed);
  EXPECT_TRUE(repaired.report.after.manifold);
  EXPECT_EQ(repaired.report.closed_holes, 0u);
  EXPECT_NEAR(repaired.report.after.volume / enclosed_volume(body.exact), 1, 1e-4);
  EXPECT_TRUE(find_center(repaired.mesh, {.rays = 0}).star_shaped);
}

TEST(CadBodies, are_repaired_in_one_run_without_thin_faces) {
  for (int i = 0; i < kBodies; i += RHOLM_CAD_STEP) expect_is_repaired(i, CadRarity::kNone);
}

TEST(CadBodies, are_repaired_where_slivers_of_two_faces_meet) {
  for (int i = 0; i < kBodies; i += RHOLM_CAD_STEP) expect_is_repaired(i, CadRarity::kSliversMeet);
}

TEST(CadBodies, are_repaired_where_vertices_are_in_one_face_of_an_edge_only) {
  for (int i = 0; i < kBodies; i += RHOLM_CAD_STEP) expect_is_repaired(i, CadRarity::kJunctions);
}

TEST(CadBodies, are_analysed_with_the_errors_of_the_exact_body) {
  for (int i = 0; i < kBodies; i += 4 * RHOLM_CAD_STEP) {
    const CadBody body = cad_body(i);
    if (body.junctions) continue;
    SCOPED_TRACE(body.name + " " + std::to_string(i));
    ExpandOptions options{.degree = 8};
    options.chart.center.rays = 0;
    const Expanded exact = expand(body.exact, options);
    options.chart.center = {.kind = CenterKind::kGiven, .point = exact.star.center, .rays = 0};
    const Expanded written = expand(body.written, options);
    const Expansion& one = exact.transform.expansion;
    const Expansion& other = written.transform.expansion;
    const double mean = std::abs(one.coefficients.c(0, 0));
    for (int l = 0; l <= 8; ++l) {
      for (int m = 0; m <= l; ++m) {
        EXPECT_NEAR(other.coefficients.c(l, m), one.coefficients.c(l, m), 1e-4 * mean);
      }
    }
    ASSERT_TRUE(one.errors && other.errors);
    ASSERT_TRUE(one.errors->rms && other.errors->rms);
    EXPECT_NEAR(*other.errors->rms / *one.errors->rms, 1, 0.01);
    // Vertices on edges are additional places of measurement: the largest error is not smaller, and
    // not much larger.
    ASSERT_TRUE(one.errors->measured_max && other.errors->measured_max);
    const double largest = *other.errors->measured_max / *one.errors->measured_max;
    EXPECT_GT(largest, 0.99);
    EXPECT_LT(largest, 1.3);
  }
}

TEST(CadBodies, lose_their_thin_faces_when_simplified) {
  for (int i = 0; i < kBodies; i += 4 * RHOLM_CAD_STEP) {
    const CadBody body = cad_body(i);
    if (body.junctions) continue;
    SCOPED_TRACE(body.name + " " + std::to_string(i));
    const Simplification simple =
        simplify(body.written, {.max_error = 1e-5 * bounds(body.written.vertices).diagonal()});
    EXPECT_EQ(inspect(simple.mesh).degenerate_faces, 0u);
    EXPECT_TRUE(inspect(simple.mesh).closed);
  }
}

}  // namespace
}  // namespace rholm
