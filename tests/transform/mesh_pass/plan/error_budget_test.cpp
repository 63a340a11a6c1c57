#include "transform/mesh_pass/plan/error_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace rholm {
namespace {

constexpr std::uint32_t kAllNames = std::numeric_limits<std::uint32_t>::max();

TEST(sampled_error2, adds_half_edges_of_one_name_before_they_are_squared) {
  std::vector<SampledHalfEdge> sample = {{.name = 7, .error = 3, .lumped = true},
                                         {.name = 5, .error = 2, .lumped = true},
                                         {.name = 7, .error = -1, .lumped = true},
                                         {.name = 5, .error = -2, .lumped = true},
                                         {.name = 9, .error = 4, .lumped = false}};
  EXPECT_NEAR(sampled_error2(sample, kAllNames), 4, 1e-8);  // (3 - 1)^2 + 0
}

TEST(sampled_error2, counts_only_the_half_that_is_lumped) {
  std::vector<SampledHalfEdge> sample = {{.name = 1, .error = 3, .lumped = true},
                                         {.name = 1, .error = -3, .lumped = false}};
  EXPECT_NEAR(sampled_error2(sample, kAllNames), 9, 1e-8);
}

TEST(sampled_error2, stands_for_all_edges) {
  std::vector<SampledHalfEdge> sample = {{.name = 1, .error = 3, .lumped = true}};
  EXPECT_NEAR(sampled_error2(sample, 1u << 30), 4 * 9, 1e-12);
  std::vector<SampledHalfEdge> none;
  EXPECT_EQ(sampled_error2(none, 0), 0);
}

// The order in which threads deliver samples does not matter.
TEST(sampled_error2, is_the_same_in_any_order) {
  std::vector<SampledHalfEdge> sample;
  sample.reserve(1000);
  for (int k = 0; k < 1000; ++k) {
    sample.push_back({.name = static_cast<std::uint64_t>(k * 7919 % 331),
                      .error = std::sin(k) * std::exp(0.01 * k),
                      .lumped = k % 5 != 0});
  }
  std::vector<SampledHalfEdge> turned(sample.rbegin(), sample.rend());
  EXPECT_EQ(sampled_error2(sample, kAllNames), sampled_error2(turned, kAllNames));
}

TEST(norm_of_degrees, is_the_root_of_the_squares_of_those_degrees) {
  Coefficients c(3);
  c.c(0, 0) = 9;
  c.c(1, 1) = 3;
  c.s(2, 1) = 4;
  c.c(3, 0) = 12;
  EXPECT_DOUBLE_EQ(norm_of_degrees(c, 1, 2), 5);
  EXPECT_DOUBLE_EQ(norm_of_degrees(c, 1, 3), 13);
  EXPECT_EQ(norm_of_degrees(c, 2, 1), 0);
}

// Errors of parts add up in squares: each named part is contained in the whole.
TEST(error_of_pass, grows_with_what_lumps_nodes_windows_and_quanta_leave) {
  MeshPlan plan;
  plan.divided = {.degree = 20, .allowed = 1, .divided = true};
  plan.block.scale = 2;
  plan.block.sampled_names = kAllNames;
  plan.quanta_error = 3e-7;
  Coefficients none(20);
  const auto whole_of = [&](double face_error2, double node_error2, double source2) {
    PassFacts facts;
    facts.face_error2 = face_error2;
    facts.node_error2 = node_error2;
    facts.source2 = source2;
    facts.vertices = 100;
    facts.transform = plan_nonuniform({.degree = 20, .allowed = 1e-6, .sources = 100});
    return error_of_pass(plan, facts, none).whole;
  };
  EXPECT_DOUBLE_EQ(whole_of(0, 0, 0), 3e-7 / 2);
  EXPECT_DOUBLE_EQ(whole_of(0, 16e-14, 0), 5e-7 / 2);
  const double lumps = lumping_error(20);
  EXPECT_DOUBLE_EQ(whole_of(1, 0, 0), std::hypot(lumps, 3e-7) / 2);
  EXPECT_GT(whole_of(0, 0, 1), whole_of(0, 0, 0));
}

}  // namespace
}  // namespace rholm
