// rholm reconstruct: reconstructs surfaces from points.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/reconstruct.h"
#include "cli/commands/reconstruct_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/points_input.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  ReconstructOptions wanted;  // lengths as fractions of the diagonal
  std::optional<int> resolution;
  MemoryOptions memory;
  std::string model;
  std::string columns;
  std::string output;
  std::string format;
  bool ascii = false;
  bool json = false;
};

ReconstructOptions library_options(const Options& o, const Bounds& box) {
  ReconstructOptions options = o.wanted;
  scale_lengths(options, box.diagonal());
  const Vec3 size = box.max - box.min;
  if (o.resolution) options.step = std::max({size.x, size.y, size.z}) / *o.resolution;
  options.max_memory = o.memory.limit();
  return options;
}

void end(const ReconstructReport& report, const ReconstructOptions& wanted, const Options& options,
         Session& session) {
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json.update(json_of(report, wanted.confidence));
    print_json(json);
  } else if (options.output != "-") {
    session.report(fmt::format("{}: reconstructed\n", display_name(options.input)) +
                   report_text(report, wanted));
  }
  judge(report, wanted.holes == HolePolicy::kFill, session);
}

void run_in_one_piece(PointsInput input, ShapeFormat format, const Options& options,
                      Session& session) {
  ReconstructOptions wanted = library_options(options, bounds(input.cloud->points));
  wanted.resume = false;  // a single tile keeps no work
  Reconstruction made = reconstruct(std::move(*input.cloud), wanted, session.context());
  add_dropped(input.dropped, made.report);
  stop_if_interrupted();
  write_shape_output(made.mesh, options.output, {format, options.ascii}, session);
  // Written last, because this is not interruptible: after an error no output exists.
  if (!options.model.empty()) {
    made.model.input_numbers = 3 * made.report.points;  // including points that the reader dropped
    write_atlas(made.model, options.model);
  }
  end(made.report, wanted, options, session);
}

// Functions that work on tiles.
struct TileWorkers {
  RunTiles run;
  std::function<bool()> several;
};

void run_in_tiles(const PointsInput& input, ShapeFormat format, const Options& options,
                  const TileWorkers& by, Session& session) {
  if (format != ShapeFormat::kPly || options.ascii) {
    throw UsageError(
        "so many points are reconstructed in tiles, to a binary PLY: -o NAME.ply; rholm convert "
        "makes other files of it");
  }
  // Fractions of the diagonal are converted once the box is known.
  const bool relative = options.resolution || has_lengths(options.wanted);
  Bounds box;
  if (relative) {
    box = input.cloud ? bounds(input.cloud->points)
                      : bounds_of_points(input.file, options.columns, session);
  }
  ReconstructOptions wanted = library_options(options, box);
  if (by.several() && options.memory.work_dir.empty()) {
    throw UsageError("several ranks need a folder that all of them see: --work-dir DIR");
  }
  wanted.output = options.output, wanted.model = options.model;
  wanted.work_dir = options.memory.work_dir;
  wanted.foreseen = [&](const TileForecast& forecast) {
    constexpr double kGigabyte = 1e9;
    session.note(fmt::format(
        "{} points in {} tiles: some {:.1f} GB of memory, {:.1f} GB between the steps, {:.1f} GB "
        "of surface",
        forecast.points, forecast.tiles, static_cast<double>(forecast.memory) / kGigabyte,
        static_cast<double>(forecast.stored) / kGigabyte,
        static_cast<double>(forecast.written) / kGigabyte));
  };
  keep_large_freed_memory();
  ReconstructReport report = by.run(input, wanted, session).report;
  add_dropped(input.dropped, report);
  for (const std::string& warning : report.warnings) {
    session.warn(fmt::format("{}: {}", display_name(options.input), warning));
  }
  end(report, wanted, options, session);
}

int run(const Options& options, const TileWorkers& by, Session& session) {
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  if (!options.model.empty()) {
    check_rewindable(options.model);
    check_writable(options.model);
  }
  if (options.wanted.resume && is_stream(options.input)) {
    throw UsageError("--resume needs a file: standard input cannot be read again");
  }
  if (options.wanted.resume && options.output == "-") {
    throw UsageError("--resume needs an output with a name: -o NAME.ply");
  }
  options.memory.keep(session);
  const std::uint64_t most = options.wanted.tile_points;
  // Several tiles took up to 2.5 times the estimate for one tile (reconstruct_tiles.cpp).
  note_enough_memory(2.5 * static_cast<double>(foresee_tiles(most, most).memory));
  PointsInput input =
      read_points_input(options.input, most, options.columns, options.memory, session);
  if (input.cloud) validate(*input.cloud);
  if (input.cloud && input.cloud->points.size() <= most) {
    run_in_one_piece(std::move(input), format, options, session);
  } else {
    run_in_tiles(input, format, options, by, session);
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> options = {
      {.name = "POINTS",
       .help = "file of points, or - for standard input; missing normals are computed",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapes}};
  append(options, field_options(o.wanted));
  append(options,
         {{.name = "resolution",
           .value = "N",
           .help = "number of grid cubes along the longest side; by default from the spacing of "
                   "the points",
           .target = &o.resolution,
           .min = 4,
           .max = 65536},
          columns_option(o.columns),
          max_memory_option(o.memory),
          {.name = "work-dir",
           .value = "DIR",
           .help = "folder for tiles and for the part of standard input that does not fit in "
                   "memory; by default the folder for temporary files",
           .target = &o.memory.work_dir},
          {.name = "model",
           .value = "FILE",
           .help = "also write the caps to this model file (.h5), which rholm synthesize reads",
           .target = &o.model,
           .offer = Offer::kAnyFile}});
  append(options, mesh_output_options(o.output, o.format, o.ascii));
  options.push_back(json_option(o.json));
  return options;
}

}  // namespace

Command reconstruct_command() {
  return reconstruct_command_by(
      [](const PointsInput& points, const ReconstructOptions& options, Session& session) {
        return points.cloud ? reconstruct(*points.cloud, options, session.context())
                            : reconstruct(std::filesystem::path(points.file), options,
                                          session.context(), points.columns);
      },
      [] { return false; });
}

Command reconstruct_command_by(RunTiles run_tiles, std::function<bool()> several) {
  auto options = std::make_shared<Options>();
  return {
      .name = "reconstruct",
      .summary = "Make a closed surface from points",
      .description =
          "Covers points with overlapping caps and extracts a surface: closed, 2-manifold, "
          "oriented outwards, with normals. Cap size, noise and resolution are chosen from the "
          "data.\n\nEach cap is a function on its own sphere, fitted to points and normals, "
          "and the caps are blended. Outliers are removed, holes are closed smoothly, and "
          "colours and other attributes of the points are kept.",
      .options = in_groups(option_list(*options), {{Group::kData, {"holes"}},
                                                   {Group::kAccuracy, {"tolerance", "resolution"}},
                                                   {Group::kAdvanced, {"model", "work-dir"}},
                                                   {Group::kPaper, {"blend"}}}),
      .examples = {"rholm reconstruct points.ply -o surface.ply",
                   "rholm reconstruct points.ply --holes keep --json -o surface.obj"},
      .run = [options, by = TileWorkers{std::move(run_tiles), std::move(several)}](
                 Session& session) { return run(*options, by, session); },
      .per_shape = PerShape{.extension = "ply", .one_file = "model"}};
}

}  // namespace rholm::cli
