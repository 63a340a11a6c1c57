// The part of 'rholm make' that samples a mesh. Layer: cli.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/mesh.h"

namespace rholm::cli {

struct SampleArguments {
  std::string mesh;
  std::optional<int> points;
  std::optional<double> noise;
  std::optional<double> normal_noise;
  std::optional<double> outliers;
  std::string holes;
  std::optional<double> density_ratio;
  std::string pattern;
  std::optional<double> ratio;
  std::string axis;
  std::optional<int> scans;
  std::optional<double> misalign;
  std::optional<double> noise_per_scan;
  bool sensor = false;
  bool largest_component = false;
  bool no_normals = false;
};

Option sample_operand(SampleArguments& arguments);
std::vector<Option> sample_options(SampleArguments& arguments);

// Throws UsageError if any of them is given: `kind` is another kind of shape.
void refuse_given(const SampleArguments& arguments, const std::string& kind);

PointCloud make_sample(const SampleArguments& arguments, std::uint64_t seed, Session& session);

}  // namespace rholm::cli
