#include "cli/commands/synthesize_atlas.h"

#include <fmt/format.h>

#include "cli/commands/atlas_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "rholm/compress.h"

namespace rholm::cli {

int synthesize_atlas(const SynthesizeAtlasOptions& options, Session& session) {
  const AtlasModel model = read_atlas(options.input);
  AtlasSynthesisOptions wanted;
  if (options.resolution) wanted.step = *options.resolution;
  wanted.degree = options.degree_limit;
  wanted.simplify = options.simplify;
  const Mesh surface = synthesize(model, wanted, session.context());
  stop_if_interrupted();
  if (model.rules && !model.rules->left_out.empty()) {
    session.warn(fmt::format("{}: the surface had {}, which the model does not hold",
                             display_name(options.input), left_out_text(*model.rules)));
  }
  write_shape_output(surface, options.output, {options.format, options.ascii}, session);
  if (model.rules && model.rules->bricks) {
    session.note(
        fmt::format("{}: the surface was made in bricks: its vertices have another order "
                    "there, and what closes holes may differ by some steps of the grid",
                    display_name(options.input)));
  }
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json["output"] = options.output;
    json["counts"] = {{"vertices", surface.vertices.size()}, {"faces", surface.triangles.size()}};
    json["resolution"] = wanted.step > 0 ? wanted.step : model.step;
    print_json(json);
  } else {
    session.note(fmt::format("{} and {}", counted(surface.vertices.size(), "vertex", "vertices"),
                             counted(surface.triangles.size(), "face")));
  }
  return 0;
}

}  // namespace rholm::cli
