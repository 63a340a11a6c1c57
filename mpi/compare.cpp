#include "mpi/compare.h"

#include <algorithm>
#include <vector>

#include "base/bytes.h"
#include "cli/commands/compare.h"
#include "cli/grammar/run.h"
#include "cli/terminal/interrupt.h"
#include "cluster/collect.h"
#include "cluster/rank_executor.h"
#include "rholm/error.h"
#include "shape/fingerprint.h"
#include "surface/star/compare_samples.h"

namespace rholm::mpi {
namespace {

std::string fingerprints(const Mesh& a, const Mesh& b) {
  return ByteWriter().number(fingerprint(view_of(a))).number(fingerprint(view_of(b))).take();
}

// Returns the command line without the command, for ranks that print nothing.
std::vector<std::string> quiet(std::vector<std::string> words) {
  words.erase(words.begin());
  std::erase(words, "--quiet");
  words.insert(words.begin(), "--quiet");
  return words;
}

}  // namespace

cli::Command compare_command(Ranks* ranks, const std::shared_ptr<RankOptions>& options) {
  cli::Command command = cli::compare_command_by(
      {.begin =
           [ranks, options](const std::string& a, const std::string& b) {
             for (const std::string& path : {a, b}) check_input(*ranks, path);
             call(*ranks, kCompareService, ByteWriter().texts(quiet(options->words)).take());
           },
       .compare = [ranks](const Mesh& a, const Mesh& b, const CompareOptions& wanted,
                          const Context& context) -> std::optional<Comparison> {
         if (ranks->size() == 1) return compare(a, b, wanted, context);
         broadcast(*ranks, fingerprints(a, b));
         CompareSamples samples(a, b, wanted);
         RankExecutor executor(*ranks, context.threads);
         return compare(samples, context, &executor);
       }});
  command.description +=
      "\n\nEach rank reads both files, whose paths mean the same on all machines, and measures a "
      "part of the samples; half of the ranks measure one way, half of them the other. The report "
      "is that of rholm compare.";
  command.examples = {"mpirun -n 2 rholm-mpi compare scan.ply model.h5 --samples 50000000"};
  return command;
}

void serve_compare(Ranks& ranks, const std::string& bytes) {
  RankOptions ignored;
  cli::Command command = cli::compare_command_by(
      {.begin = [](const std::string&, const std::string&) {},
       .compare = [&ranks](const Mesh& a, const Mesh& b, const CompareOptions& wanted,
                           const Context& context) -> std::optional<Comparison> {
         if (broadcast(ranks, {}) != fingerprints(a, b)) {
           throw Error(ErrorCode::kInvalidInput,
                       "a file is not the one of that name that rank 0 has");
         }
         CompareSamples samples(a, b, wanted);
         RankExecutor executor(ranks, context.threads);
         executor.run({}, [&](std::size_t part, int) { return samples.work(part); }, {});
         return std::nullopt;
       }});
  append(command.options, rank_options(ignored));
  const CancelScope scope(cli::keep_going);
  run_command(command, ByteReader(bytes).texts());
}

}  // namespace rholm::mpi
