#include "mpi/expand.h"

#include <algorithm>
#include <memory>
#include <set>

#include "base/bytes.h"
#include "cli/commands/expand.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/rank_executor.h"
#include "model/expand/expand_file.h"
#include "mpi/rank_options.h"

namespace rholm::mpi {
namespace {

// Ranks share one expansion by the fast engine with the method edge. For other options they would
// wait for rank 0.
void keep_what_is_shared(cli::Command& command) {
  static const std::set<std::string> others = {"samples", "deviation", "most-samples", "seed",
                                               "weld"};
  std::erase_if(command.options,
                [](const cli::Option& option) { return others.contains(option.name); });
  for (cli::Option& option : command.options) {
    if (option.name == "method") {
      option.choices = {"edge"};
      option.help = "edge: the radius, over edges and faces; 'rholm expand' has others";
    } else if (option.name == "SHAPE") {
      option.help = "file of a closed mesh, or, on one rank, - for standard input";
    } else if (option.name == "engine") {
      option.choices = {"fast"};
      option.help = "fast: sums on an oversampled grid; 'rholm expand' has another";
    }
  }
}

}  // namespace

cli::Command expand_command(Ranks* ranks) {
  cli::Command command = cli::expand_command_by(
      {.expand_file =
           [ranks](const std::string& path, const ExpandOptions& options, const Context& context,
                   const std::function<Mesh()>& read) {
             if (ranks->size() == 1) return expand_file(path, options, context, read);
             return expand_file(path, options, context, read, [&](const std::string& mesh) {
               return std::make_unique<RankExecutor>(
                   *ranks, context.threads,
                   [ranks, mesh, threads = context.threads](const Parts& parts) {
                     call(*ranks, kExpandService,
                          ByteWriter()
                              .number(static_cast<std::uint64_t>(threads))
                              .text(mesh)
                              .text(parts.job)
                              .text(parts.input)
                              .take());
                   });
             });
           },
       .check_input = [ranks](const std::string& path) { check_input(*ranks, path); }});
  keep_what_is_shared(command);
  command.description =
      "Expands the radius of a star-shaped mesh in real spherical harmonics, with the result of "
      "rholm expand to the byte.\n\nThe ranks share the pass over the triangles, and the norms. "
      "Each rank opens the file itself, whose path means the same on all machines. Rank 0 alone "
      "looks for the centre, measures errors and writes; it makes the pass alone where triangles "
      "lie "
      "in random order, and all of a mesh that has to be changed first: not closed, inside out. "
      "Other methods and --weld are options of rholm expand.";
  command.examples = {"mpirun -n 16 rholm-mpi expand huge.ply --degree 480 -o huge.h5",
                      "srun rholm-mpi expand huge.ply --tolerance 1e-3 --unit diagonal -o huge.h5"};
  return command;
}

std::function<void(Ranks& ranks, const std::string& bytes)> expand_service() {
  struct Opened {
    std::string name;
    std::unique_ptr<SharedMesh> mesh;
  };
  return [opened = std::make_shared<Opened>()](Ranks& ranks, const std::string& bytes) {
    ByteReader packed(bytes);
    const int threads = static_cast<int>(packed.number());
    const std::string_view mesh = packed.text(), job = packed.text(), input = packed.text();
    if (opened->name != mesh || !opened->mesh) {
      const CancelScope scope(cli::keep_going);
      opened->mesh.reset();
      opened->mesh = std::make_unique<SharedMesh>(mesh, Context{.threads = threads});
      opened->name = mesh;
    }
    RankExecutor(ranks, threads).run({}, opened->mesh->work_of(job, input), {});
  };
}

}  // namespace rholm::mpi
