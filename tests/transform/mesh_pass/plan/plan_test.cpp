#include "transform/mesh_pass/plan/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "harmonic/nonuniform/cost_model.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/adversarial_meshes.h"

namespace rholm {
namespace {

MeshSample unit_sample() {
  MeshSample sample;
  sample.mean = 1;
  sample.norm = 0.5;
  return sample;
}

TEST(divide_error, shares_add_up_in_squares_to_no_more_than_the_wish) {
  for (const double precision : {1e-2, 1e-6, 1e-10}) {
    const AllowedErrors allowed = divide_error(unit_sample(), precision, 1);
    const double sum = std::hypot(allowed.caution * allowed.rules, allowed.window, allowed.quanta);
    EXPECT_LE(sum, precision * 0.5);
    EXPECT_GT(sum, precision * 0.25);
    EXPECT_EQ(allowed.mean, precision);
  }
}

TEST(divide_error, asks_for_no_more_than_rounding_leaves) {
  const AllowedErrors allowed = divide_error(unit_sample(), 1e-30, 1);
  EXPECT_GT(allowed.rules, 0.1 * kLumpRounding);
  EXPECT_EQ(allowed.mean, kLumpRounding);
}

TEST(divide_error, tightens_all_shares_alike) {
  const AllowedErrors loose = divide_error(unit_sample(), 1e-5, 1);
  const AllowedErrors tight = divide_error(unit_sample(), 1e-5, 4);
  EXPECT_DOUBLE_EQ(tight.rules, loose.rules / 4);
  EXPECT_DOUBLE_EQ(tight.window, loose.window / 4);
  EXPECT_DOUBLE_EQ(tight.quanta, loose.quanta / 4);
  EXPECT_DOUBLE_EQ(tight.most_window, loose.most_window / 4);
}

TEST(divide_error, is_careful_with_sheets_that_overlap_and_edges_along_the_grid) {
  MeshSample sample = unit_sample();
  const AllowedErrors plain = divide_error(sample, 1e-5, 1);
  sample.overlaps = true;
  sample.aligned = 1;
  const AllowedErrors careful = divide_error(sample, 1e-5, 1);
  EXPECT_GT(careful.caution, 1);
  EXPECT_LT(careful.rules, plain.rules);
  EXPECT_LT(careful.most_window, plain.most_window / 5);
}

TEST(divide_error, refuses_a_surface_that_no_direction_sees) {
  EXPECT_THROW(divide_error(MeshSample{}, 1e-5, 1), Error);
}

TEST(choose_lumps, lumps_fine_meshes_whole_and_coarse_ones_less) {
  const Mesh mesh = bumpy_sphere(5);
  const auto share_at = [&](int degree) {
    const MeshSample sample = sample_mesh(view_of(mesh), {}, degree);
    return choose_lumps(sample, divide_error(sample, 1e-4, 1), degree).node_share;
  };
  EXPECT_EQ(share_at(8), 0);
  EXPECT_GT(share_at(200), 0.5);
}

// Elements much shorter than a wave have the phase of their neighbours.
TEST(choose_lumps, counts_short_elements_as_in_step) {
  const Mesh mesh = icosphere(5);
  const MeshSample sample = sample_mesh(view_of(mesh), {}, 1);
  const LumpChoice choice = choose_lumps(sample, divide_error(sample, 1e-6, 1), 1);
  EXPECT_GT(choice.neighbours, 5);
  EXPECT_DOUBLE_EQ(choice.neighbours, neighbours_in_step(sample.angle * sample.angle));
}

TEST(choose_hessians, takes_none_where_all_is_lumped_and_what_is_cheaper_elsewhere) {
  const Mesh mesh = bumpy_sphere(5);
  for (const int degree : {8, 64, 128}) {
    const MeshSample sample = sample_mesh(view_of(mesh), {}, degree);
    const LumpChoice lumps = choose_lumps(sample, divide_error(sample, 1e-5, 1), degree);
    const auto hermite = choose_hessians(sample, lumps, 20);
    if (lumps.node_share == 0) {
      EXPECT_FALSE(hermite.has_value());
    } else if (hermite) {
      EXPECT_LT(hermite->cost, 20 * own_node_cost() * lumps.node_share);
    }
    EXPECT_EQ(hermite.has_value(), degree > 8) << degree;
  }
}

TEST(single_suffices, only_where_its_rounding_is_below_the_windows_share) {
  const Mesh mesh = bumpy_sphere(4);
  const MeshSample sample = sample_mesh(view_of(mesh), {}, 32);
  bool before = true;
  for (double precision = 1e-2; precision > 1e-12; precision /= 10) {
    const bool single = single_suffices(sample, divide_error(sample, precision, 1), 32, false);
    EXPECT_LE(single, before) << precision;
    before = single;
  }
  EXPECT_TRUE(single_suffices(sample, divide_error(sample, 1e-3, 1), 32, false));
  EXPECT_FALSE(before);
}

TEST(choose_quantum, is_a_power_of_two_within_its_share) {
  for (const std::size_t vertices : {4ul, 1000ul, 10'000'000ul}) {
    for (const double precision : {1e-2, 1e-8}) {
      const AllowedErrors allowed = divide_error(unit_sample(), precision, 1);
      const Quantum fine = choose_quantum(allowed, vertices, false);
      const Quantum coarse = choose_quantum(allowed, vertices, true);
      int exponent;
      EXPECT_EQ(std::frexp(coarse.size, &exponent), 0.5);
      EXPECT_LE(coarse.error, allowed.quanta);
      EXPECT_GT(coarse.error, allowed.quanta / 2);
      EXPECT_EQ(coarse.size, 64 * fine.size);
      EXPECT_EQ(coarse.error, 64 * fine.error);
      // The variance is q^2 / 12 at four of six corners and twice that at the others, over 4 pi.
      const double variance = coarse.size * coarse.size * 2 / 3 * static_cast<double>(vertices);
      EXPECT_NEAR(coarse.error, std::sqrt(variance / (4 * 3.14159265358979)), 1e-9 * coarse.error);
    }
  }
}

MeshPlan plan_of(const Mesh& mesh, int degree, double precision, const PlanLimits& limits = {}) {
  const MeshView view = view_of(mesh);
  return plan_mesh(view, sample_mesh(view, {}, degree), {}, degree, precision, limits);
}

TEST(plan_mesh, lumps_a_fine_smooth_mesh_in_single_precision) {
  const MeshPlan plan = plan_of(bumpy_sphere(6), 32, 1e-4);
  EXPECT_EQ(plan.node_share, 0);
  EXPECT_TRUE(plan.single);
  EXPECT_FALSE(plan.block.hessians);
  EXPECT_EQ(plan.hessian2, 0);
}

TEST(plan_mesh, gives_a_coarse_mesh_hessians_or_nodes) {
  const MeshPlan plan = plan_of(bumpy_sphere(4), 64, 1e-6);
  EXPECT_TRUE(plan.block.hessians || plan.node_share > 0);
  EXPECT_GT(plan.divided.allowed, 0);
  EXPECT_TRUE(plan.divided.divided);
}

TEST(plan_mesh, minds_what_a_first_try_has_taught) {
  const Mesh mesh = bumpy_sphere(6);
  EXPECT_FALSE(plan_of(mesh, 32, 1e-4, {.forbid_single = true}).single);
  const MeshPlan certain = plan_of(mesh, 32, 1e-4, {.no_lumps = true});
  EXPECT_EQ(certain.block.tolerance2, 0);
  EXPECT_EQ(certain.node_share, 1);
  EXPECT_FALSE(certain.block.hessians);
  const MeshPlan loose = plan_of(mesh, 32, 1e-4), tight = plan_of(mesh, 32, 1e-4, {.tighten = 3});
  EXPECT_DOUBLE_EQ(tight.allowed.rules, loose.allowed.rules / 3);
  EXPECT_LT(tight.block.tolerance2, loose.block.tolerance2);
}

TEST(allowed_window_error, keeps_the_share_for_sources_of_any_size) {
  const MeshPlan plan = plan_of(bumpy_sphere(5), 32, 1e-5);
  for (const double source2 : {1e-6, 1.0, 1e6}) {
    const double relative = allowed_window_error(plan, source2);
    EXPECT_LE(relative * std::sqrt(source2 / (4 * 3.14159265358979)),
              plan.allowed.window * (1 + 1e-12));
    EXPECT_LE(relative, plan.allowed.most_window);
  }
  EXPECT_EQ(allowed_window_error(plan, 0), plan.allowed.most_window);
}

}  // namespace
}  // namespace rholm
