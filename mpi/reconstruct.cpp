#include "mpi/reconstruct.h"

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/reconstruct.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/pack.h"
#include "cluster/rank_crew.h"
#include "model/bricks/shared_bricks.h"
#include "mpi/share.h"

namespace rholm::mpi {
namespace {

std::uint64_t flags_of(const ReconstructOptions& o) {
  return (o.noise ? 1 : 0) | (o.sensor ? 2 : 0) | (o.remove_outliers ? 4 : 0) |
         (o.align_scans ? 8 : 0) | (o.confidence ? 16 : 0) | (o.simplify ? 32 : 0);
}

void put(const ReconstructOptions& o, Packer& packer) {
  packer.number(flags_of(o)).number(o.max_memory);
  packer.texts({to_string(o.holes), to_string(o.blend)});
  const Vec3 sensor = o.sensor.value_or(Vec3{});
  const SimplifyOptions simplify = o.simplify.value_or(SimplifyOptions{});
  packer.number(simplify.triangles);
  packer.real(o.step)
      .real(o.tolerance)
      .real(o.noise.value_or(0))
      .real(o.min_component)
      .real(sensor.x)
      .real(sensor.y)
      .real(sensor.z)
      .real(simplify.share)
      .real(simplify.max_error);
}

ReconstructOptions options_of(Unpacker& bytes) {
  ReconstructOptions o;
  const std::uint64_t flags = bytes.number();
  const auto has = [&](std::uint64_t flag) { return (flags & flag) != 0; };
  o.max_memory = bytes.number();
  const std::vector<std::string> names = bytes.texts();
  o.holes = parse_hole_policy(names.at(0));
  o.blend = parse_cap_blend(names.at(1));
  SimplifyOptions simplify;
  simplify.triangles = bytes.number();
  o.step = bytes.real();
  o.tolerance = bytes.real();
  const double noise = bytes.real();
  if (has(1)) o.noise = noise;
  o.min_component = bytes.real();
  Vec3 sensor;
  for (double* c : {&sensor.x, &sensor.y, &sensor.z}) *c = bytes.real();
  if (has(2)) o.sensor = sensor;
  simplify.share = bytes.real();
  simplify.max_error = bytes.real();
  if (has(32)) o.simplify = simplify;
  o.remove_outliers = has(4), o.align_scans = has(8), o.confidence = has(16);
  return o;
}

// What another rank needs.
struct Part {
  std::filesystem::path mesh;
  ReconstructOptions options;
  BrickOptions bricks;
  int threads = 0;
};

std::string bytes_of(const Part& part) {
  Packer packer;
  packer.texts({part.mesh.string(), part.bricks.work_dir.string(), part.bricks.model.string()})
      .number(part.bricks.points_per_brick)
      .number(static_cast<std::uint64_t>(part.threads));
  put(part.options, packer);
  return packer.take();
}

Part part_of(const std::string& bytes) {
  Unpacker packed(bytes);
  Part part;
  const std::vector<std::string> paths = packed.texts();
  part.mesh = paths.at(0), part.bricks.work_dir = paths.at(1), part.bricks.model = paths.at(2);
  part.bricks.points_per_brick = packed.number();
  part.threads = static_cast<int>(packed.number());
  part.options = options_of(packed);
  return part;
}

BrickReconstruction run(Ranks& ranks, const cli::PointsInput& points,
                        const std::filesystem::path& mesh, const ReconstructOptions& options,
                        const BrickOptions& bricks, cli::Session& session) {
  Context context = session.context();
  const int wanted = context.threads;
  context.threads = threads_here(ranks, wanted);
  RankCrew crew(ranks, context.threads);
  const auto begun = [&] {
    call(ranks, kReconstructService, bytes_of({mesh, options, bricks, wanted}));
    if (!bricks.resume) return;
    ranks.set_hint([folder = bricks.work_dir.string()] {
      return fmt::format("what is done is kept in {}: the same command goes on from there", folder);
    });
  };
  const SharedRun shared{.crew = crew,
                         .begun = begun,
                         .failed = [&](const std::exception_ptr& what) { ranks.fail(what); }};
  return points.cloud ? reconstruct_shared(*points.cloud, mesh, options, bricks, shared, context)
                      : reconstruct_shared(std::filesystem::path(points.file), mesh, options,
                                           bricks, shared, context);
}

}  // namespace

cli::Command reconstruct_command(Ranks* ranks) {
  cli::Command command = cli::reconstruct_command_by(
      [ranks](const cli::PointsInput& points, const std::filesystem::path& mesh,
              const ReconstructOptions& options, const BrickOptions& bricks,
              cli::Session& session) {
        return run(*ranks, points, mesh, options, bricks, session);
      },
      [ranks] { return ranks->size() > 1; });
  command.description +=
      "\n\nBricks are worked on by all ranks, which leave what they find in a folder of --work-dir "
      "that all of them see; the points are read and holes are closed by rank 0, which also "
      "reconstructs alone what is no more than one brick. The bytes are those of rholm "
      "reconstruct, and either goes on with --resume where the other ended.";
  command.examples = {
      "mpirun -n 16 rholm-mpi reconstruct points.ply --work-dir /scratch -o s.ply",
      "srun rholm-mpi reconstruct points.ply --work-dir /scratch --resume -o s.ply"};
  return command;
}

void serve_reconstruct(Ranks& ranks, const std::string& bytes) {
  const Part part = part_of(bytes);
  Context context;
  context.threads = threads_here(ranks, part.threads);
  context.progress = [](std::string_view, double) { return cli::keep_going(); };
  cli::keep_large_freed_memory();
  RankCrew crew(ranks, context.threads);
  help_reconstruct(part.mesh, part.options, part.bricks, crew, context);
}

}  // namespace rholm::mpi
