// rholm reconstruct: surfaces from points.
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
#include "io/file/temporary_folder.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/reconstruct_bricks.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  ReconstructOptions wanted;  // lengths as parts of the diagonal
  std::optional<int> resolution;
  MemoryOptions memory;
  std::optional<int> tile_points;
  bool resume = false;
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

// A brick that fits into the memory, if none is asked for: the surface of smaller bricks is another
// one, as good. What is enough for several of them is noted.
std::uint64_t points_per_brick(const Options& options) {
  constexpr std::uint64_t kSmall = 1 << 14;  // chosen: smaller ones are little but halo
  std::uint64_t points = kBrickPoints;
  if (options.tile_points) {
    points = static_cast<std::uint64_t>(*options.tile_points);
  } else {
    const std::size_t limit = options.memory.limit();
    while (points > kSmall && enough_for_bricks(points, points) > limit) points /= 2;
  }
  note_enough_memory(static_cast<double>(enough_for_bricks(points + 1, points)));
  return points;
}

// Whether what lies between the steps fits into memory with the rest.
bool is_small(const PointsInput& input, const BrickOptions& bricks, const Options& options) {
  if (!input.n) return false;
  const BrickForecast forecast = foresee_bricks(*input.n, bricks.points_per_brick);
  return forecast.memory + forecast.stored < options.memory.limit() / 2;
}

// The folder of a run in bricks: one that others find again, or one of its own, which is gone when
// this is.
class BrickFolder {
 public:
  explicit BrickFolder(const Options& options) {
    const std::filesystem::path base = options.memory.folder();
    if (options.resume) {
      path_ = base / (std::filesystem::path(options.output).filename().string() + ".tiles");
      return;
    }
    own_.emplace(base, "rholm-tiles-");
    path_ = own_->path() / "tiles";
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::optional<TemporaryFolder> own_;
  std::filesystem::path path_;
};

void end(const Reconstructed& made, const ReconstructOptions& wanted, const Options& options,
         Session& session) {
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json.update(json_of(made, wanted.confidence));
    print_json(json);
  } else if (options.output != "-") {
    session.report(fmt::format("{}: reconstructed\n", display_name(options.input)) +
                   report_text(made, wanted));
  }
  judge(made.report, wanted.holes == HolePolicy::kFill, session);
}

void run_in_one_piece(PointsInput input, ShapeFormat format, const Options& options,
                      Session& session) {
  const Bounds box = bounds(input.cloud->points);
  const ReconstructOptions wanted = library_options(options, box);
  Reconstruction made = reconstruct(std::move(*input.cloud), wanted, session.context());
  add_dropped(input.dropped, made.report);
  stop_if_interrupted();
  write_shape_output(made.mesh, options.output, {format, options.ascii}, session);
  // Last, as it is not interrupted: who reads that nothing was written finds nothing.
  if (!options.model.empty()) {
    made.model.input_numbers = 3 * made.report.points;  // with those that the reader dropped
    write_atlas(made.model, options.model);
  }
  end({.report = made.report,
       .coefficients = made.model.atlas.coefficients.size(),
       .vertices = made.mesh.vertices.size(),
       .triangles = made.mesh.triangles.size(),
       .diagonal = box.diagonal()},
      wanted, options, session);
}

// Who works on bricks.
struct BrickWorkers {
  RunBricks run;
  std::function<bool()> several;
};

void run_in_bricks(const PointsInput& input, ShapeFormat format, const Options& options,
                   const BrickWorkers& by, Session& session) {
  if (format != ShapeFormat::kPly || options.ascii) {
    throw UsageError(
        "so many points are reconstructed in tiles, to a binary PLY: -o NAME.ply; rholm convert "
        "makes other files of it");
  }
  // What is a part of the diagonal is known once the box is.
  const bool relative = options.resolution || has_lengths(options.wanted);
  Bounds box;
  if (relative) {
    box = input.cloud ? bounds(input.cloud->points)
                      : bounds_of_points(input.file, options.columns, session);
  }
  const ReconstructOptions wanted = library_options(options, box);
  BrickOptions bricks{.points_per_brick = points_per_brick(options),
                      .resume = options.resume,
                      .model = options.model,
                      .columns = options.columns};
  std::optional<BrickFolder> folder;
  const bool shared = by.several();
  if (shared && options.memory.work_dir.empty()) {
    throw UsageError("several ranks need a folder that all of them see: --work-dir DIR");
  }
  if (shared || options.resume || !is_small(input, bricks, options)) {
    bricks.work_dir = folder.emplace(options).path();
  }
  bricks.foreseen = [&](const BrickForecast& forecast) {
    constexpr double kGigabyte = 1e9;
    session.note(fmt::format(
        "{} points in {} tiles: some {:.1f} GB of memory, {:.1f} GB {}, {:.1f} GB of surface",
        forecast.points, forecast.bricks, static_cast<double>(forecast.memory) / kGigabyte,
        static_cast<double>(forecast.stored) / kGigabyte,
        bricks.work_dir.empty() ? "more" : "in " + bricks.work_dir.string(),
        static_cast<double>(forecast.written) / kGigabyte));
  };
  keep_large_freed_memory();
  BrickReconstruction made = by.run(input, options.output, wanted, bricks, session);
  add_dropped(input.dropped, made.report);
  for (const std::string& warning : made.warnings) {
    session.warn(fmt::format("{}: {}", display_name(options.input), warning));
  }
  end({.report = made.report,
       .coefficients = made.coefficients,
       .vertices = made.vertices,
       .triangles = made.triangles,
       .diagonal = made.bounds.diagonal(),
       .bricks = made.bricks,
       .stored = made.stored},
      wanted, options, session);
}

int run(const Options& options, const BrickWorkers& by, Session& session) {
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  if (!options.model.empty()) {
    check_rewindable(options.model);
    check_writable(options.model);
  }
  if (options.resume && is_stream(options.input)) {
    throw UsageError("--resume needs a file: standard input cannot be read again");
  }
  if (options.resume && options.output == "-") {
    throw UsageError("--resume needs an output with a name: -o NAME.ply");
  }
  options.memory.keep(session);
  const std::uint64_t most = points_per_brick(options);
  PointsInput input =
      read_points_input(options.input, most, options.columns, options.memory, session);
  if (input.cloud) validate(*input.cloud);
  if (input.cloud && input.cloud->points.size() <= most) {
    run_in_one_piece(std::move(input), format, options, session);
  } else {
    run_in_bricks(input, format, options, by, session);
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> options = {
      {.name = "POINTS",
       .help = "file of points, or - for standard input; normals are computed if there are "
               "none",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapes}};
  append(options, field_options(o.wanted));
  append(
      options,
      {{.name = "resolution",
        .value = "N",
        .help = "cubes of the grid along the longest side; by default from the spacing",
        .target = &o.resolution,
        .min = 4,
        .max = 65536},
       columns_option(o.columns),
       {.name = "tile-points",
        .value = "N",
        .help = "more points than that are cut into tiles of at most so many, worked on one after "
                "the other; 1048576 by default, or as many as memory has room for",
        .target = &o.tile_points,
        .min = 1000,
        .max = 1 << 28},
       max_memory_option(o.memory),
       {.name = "work-dir",
        .value = "DIR",
        .help =
            "where tiles are kept meanwhile, and what of standard input does not fit in memory; "
            "by default that of the system's temporary files",
        .target = &o.memory.work_dir},
       {.name = "resume",
        .help = "keep what is done, in a folder of --work-dir with the output's name, if work in "
                "tiles ends early, and take up what is there",
        .target = &o.resume},
       {.name = "model",
        .value = "FILE",
        .help = "write the caps to a model file, .h5, as well; rholm synthesize reads it",
        .target = &o.model,
        .offer = Offer::kAnyFile}});
  append(options, mesh_output_options(o.output, o.format, o.ascii));
  options.push_back(json_option(o.json));
  return options;
}

}  // namespace

Command reconstruct_command() {
  return reconstruct_command_by(
      [](const PointsInput& points, const std::filesystem::path& mesh,
         const ReconstructOptions& options, const BrickOptions& bricks, Session& session) {
        return points.cloud
                   ? reconstruct_bricks(*points.cloud, mesh, options, bricks, session.context())
                   : reconstruct_bricks(std::filesystem::path(points.file), mesh, options, bricks,
                                        session.context());
      },
      [] { return false; });
}

Command reconstruct_command_by(RunBricks run_bricks, std::function<bool()> several) {
  auto options = std::make_shared<Options>();
  return {.name = "reconstruct",
          .summary = "From points to a closed surface",
          .description =
              "Covers points with overlapping caps, each a function on a sphere of its own fitted "
              "to points and normals, blends them and extracts the surface: closed, 2-manifold, "
              "oriented outwards, with normals. Size of caps, noise and resolution are chosen from "
              "the data; outliers are left out, holes are closed smoothly, and colours and other "
              "properties of the points are carried over.",
          .options = option_list(*options),
          .examples = {"rholm reconstruct points.ply -o surface.ply",
                       "rholm reconstruct points.ply --holes keep --json -o surface.obj"},
          .run = [options, by = BrickWorkers{std::move(run_bricks), std::move(several)}](
                     Session& session) { return run(*options, by, session); },
          .per_shape = PerShape{.extension = "ply", .one_file = "model"}};
}

}  // namespace rholm::cli
