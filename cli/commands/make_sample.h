// Sampling of a mesh by 'rholm make'. Layer: cli.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/options/field_options.h"
#include "cli/terminal/session.h"
#include "rholm/mesh.h"
#include "rholm/points.h"

namespace rholm::cli {

struct SampleArguments {
  std::string mesh;
  Given<SampleOptions> options;  // without holes, normals and seed
  std::string holes;
  bool largest_component = false;
  bool no_normals = false;
};

Option sample_operand(SampleArguments& arguments);
std::vector<Option> sample_options(SampleArguments& arguments);

// Throws UsageError if any argument is given; `kind` is another kind of shape.
void refuse_given(const SampleArguments& arguments, const std::string& kind);

PointCloud make_sample(const SampleArguments& arguments, std::uint64_t seed, Session& session);

}  // namespace rholm::cli
