// rholm synthesize for an atlas of caps. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/session.h"
#include "rholm/shape_io.h"
#include "rholm/simplify.h"

namespace rholm::cli {

struct SynthesizeAtlasOptions {
  std::string input, output;
  ShapeFormat format = ShapeFormat::kPly;
  bool ascii = false, json = false;
  std::optional<double> resolution;  // the grid's step, in the shape's unit
  std::optional<int> degree_limit;
  std::optional<SimplifyOptions> simplify;
};
int synthesize_atlas(const SynthesizeAtlasOptions& options, Session& session);

}  // namespace rholm::cli
