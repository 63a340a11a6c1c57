// rholm batch: a command for many shapes, and a row of results for each.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/batch/job.h"
#include "cli/batch/merge.h"
#include "cli/batch/row.h"
#include "cli/batch/workers.h"
#include "cli/commands/batch.h"
#include "cli/commands/commands.h"
#include "cli/commands/measures_report.h"
#include "cli/commands/spectrum_report.h"
#include "cli/files/outputs.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/suggest.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/batch.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

std::vector<std::string> names_for_batches() {
  std::vector<std::string> names;
  for (const auto make : command_makers()) {
    if (make == batch_command) continue;  // its description asks for these names
    const Command command = make();
    if (command.per_shape) names.push_back(command.name);
  }
  return names;
}

Command make_named(const std::string& name) {
  static const auto kMakers = [] {
    std::vector<std::pair<std::string, Command (*)()>> makers;
    for (const auto make : command_makers()) makers.emplace_back(make().name, make);
    return makers;
  }();
  for (const auto& [known, make] : kMakers) {
    if (known == name) return make();
  }
  throw UsageError(
      fmt::format("there is no command '{}'{}", name, did_you_mean(name, names_for_batches())));
}

BatchTable table_of(const BatchJob& job, const BatchJournal& journal) {
  BatchTable table = gather_batch(leading_columns(job.manifest, !job.options.no_times),
                                  job.rows.size(), [&](std::size_t i) {
                                    BatchRow cells = carried_cells(job.manifest, job.rows[i]);
                                    for (auto& cell : journal.read(job.rows[i])) {
                                      cells.push_back(std::move(cell));
                                    }
                                    return cells;
                                  });
  table.about = {{"command", job.options.command},
                 {"options", fmt::format("{}", fmt::join(job.options.words, " "))},
                 {"job", job.job},
                 {"coefficients",
                  "orthonormal, without Condon-Shortley phase; C_lm at "
                  "l^2 + l + m, S_lm at l^2 + l - m"}};
  if (!job.options.shard.empty()) table.about.emplace_back("shard", job.options.shard);
  return table;
}

// Counts by the exit codes, which are numbers, or texts in merged CSV.
std::size_t count_failed(const BatchTable& table) {
  const BatchColumn* codes = table.find("exit_code");
  if (codes == nullptr) return 0;
  const auto n_done =
      std::holds_alternative<std::vector<std::int64_t>>(codes->values)
          ? std::ranges::count(std::get<std::vector<std::int64_t>>(codes->values), kDone)
          : std::ranges::count(std::get<std::vector<std::string>>(codes->values), "0");
  return table.rows - static_cast<std::size_t>(n_done);
}

// Describes the results, which are written; returns the exit code.
int tell(const BatchOptions& options, const BatchTable& table, Session& session) {
  const std::size_t failed = count_failed(table);
  if (options.json) {
    print_json({{"output", options.output},
                {"rows", table.rows},
                {"failed", failed},
                {"columns", table.columns.size()}});
  }
  session.note(
      fmt::format("{}: {}, {} failed", options.output, counted(table.rows, "row"), failed));
  if (!options.strict || failed == 0) return kDone;
  throw Error(ErrorCode::kInvalidInput, fmt::format("{} of {} failed; the results are written",
                                                    failed, counted(table.rows, "row")));
}

int merge(const BatchOptions& options, Session& session) {
  check_writable(options.output);
  const BatchTable table = merge_parts(options);
  write_batch(table, options.output, true, options.raw_cells);
  return tell(options, table, session);
}

int run(const BatchOptions& options, const RunRows& run_rows_here, Session& session) {
  if (options.merge) return merge(options, session);
  const BatchJob job = make_job(options, commands_for_batches());
  check_writable(options.output);
  if (!options.outputs.empty()) std::filesystem::create_directories(options.outputs);
  const std::string journal_name = options.output + ".journal";
  if (options.restart) std::filesystem::remove(journal_name);
  const std::vector<std::string> identity = {job.job, options.shard};
  BatchJournal journal(journal_name, fingerprint(identity), job.manifest.items.size());
  if (journal.dropped_bytes() > 0) {
    session.note(
        fmt::format("{}: the last {} bytes are incomplete, and their row is processed again",
                    journal_name, journal.dropped_bytes()));
  }
  if (journal.done() > 0) {
    session.note(fmt::format("{}: {} already done", journal_name, counted(journal.done(), "row")));
  }
  if (!run_rows_here(job, journal, session)) {
    print_error(fmt::format(
        "interrupted: {} of {} rows are stored in {}; run the same command again to continue",
        journal.done(), job.rows.size(), journal_name));
    return 128 + interrupting_signal();
  }
  const BatchTable table = table_of(job, journal);
  write_batch(table, options.output, options.coefficients, options.raw_cells);
  journal.remove();
  return tell(options, table, session);
}

std::vector<Option> option_list(BatchOptions& o) {
  const std::vector<std::string> names = names_for_batches();
  return {
      {.name = "MANIFEST",
       .help = "CSV file with a column path, relative to the file, optionally id, and other "
               "columns, which are copied; - for standard input",
       .target = &o.manifest,
       .required = true,
       .offer = Offer::kAnyFile},
      {.name = "OPTIONS",
       .help = "after --: options of the command, the same for all shapes; with --merge: the "
               "results of the shards",
       .target = &o.words,
       .offer = Offer::kAnyFile},
      {.name = "command",
       .value = "COMMAND",
       .help = fmt::format("command to run for each shape; expand by default; one of {}",
                           fmt::join(names, ", ")),
       .target = &o.command,
       .choices = names},
      output_option(o.output, "table to write: .h5 (HDF5) or .csv"),
      {.name = "outputs",
       .value = "DIR",
       .help = "folder for the files that the command writes, as ID.EXTENSION; by default they are "
               "not kept",
       .target = &o.outputs,
       .offer = Offer::kAnyFile},
      {.name = "shard",
       .value = "I/N",
       .help = "process only the rows I, I + N, I + 2 N, ... of the manifest",
       .target = &o.shard},
      {.name = "merge", .help = "join the results of all shards", .target = &o.merge},
      {.name = "restart", .help = "ignore the results of an interrupted run", .target = &o.restart},
      {.name = "no-times",
       .help = "leave out the columns that differ from run to run, so that the same shapes give "
               "the same bytes",
       .target = &o.no_times},
      {.name = "coefficients",
       .help = "CSV: write the coefficients too, with one column each; HDF5 always has them",
       .target = &o.coefficients},
      {.name = "raw-cells",
       .help = "CSV: write texts unchanged; by default texts that a spreadsheet takes for formulas "
               "(they begin with =, +, -, @ and are no numbers) get an apostrophe",
       .target = &o.raw_cells},
      {.name = "strict",
       .help = "exit code 3 if a row failed, after all rows are written",
       .target = &o.strict},
      json_option(o.json)};
}

}  // namespace

BatchCommands commands_for_batches() {
  return {.make = make_named, .describe = [](const Expansion& expansion, const Context& context) {
            Json json = spectrum_json(expansion, spectrum_of(expansion));
            json.update(measures_json(measures_of(expansion, context).measures));
            return json;
          }};
}

Command batch_command() { return batch_command_by(run_rows); }

Command batch_command_by(const RunRows& run_rows_here) {
  auto options = std::make_shared<BatchOptions>();
  return {.name = "batch",
          .summary = "Run a command for many shapes and collect a table",
          .description =
              "Runs a command for each shape of a manifest and writes one row for each. A row has "
              "the columns of the manifest, the exit code, the message, the time, and all values "
              "of the report. A shape that fails has a row with its exit code and message, and the "
              "others continue.\n\nNested names are joined by dots. For coefficients the row also "
              "has the coefficients, their energy per degree, and " +
              descriptor_names() +
              " of their surface. The exit code is 0 when all rows are done.\n\nFinished rows are "
              "kept in OUT.journal until the end. After an interruption the same command processes "
              "only the missing rows. Several machines share the work by --shard, and --merge "
              "joins their results.\n\nSmall files are processed one per thread, and large files "
              "one after the other on all threads. The values do not depend on it.",
          .options = in_groups(
              option_list(*options),
              {{Group::kData, {"command", "shard", "merge"}},
               {Group::kOutput, {"outputs"}},
               {Group::kAdvanced, {"restart", "no-times", "coefficients", "raw-cells", "strict"}}}),
          .examples = {"rholm batch shapes.csv -o results.h5 -- --degree 16",
                       "rholm batch shapes.csv --command info -o info.csv",
                       "rholm batch shapes.csv --shard 1/2 -o part-1.h5 -- --degree 16",
                       "rholm batch shapes.csv --shard 2/2 -o part-2.h5 -- --degree 16",
                       "rholm batch shapes.csv --merge -o all.h5 part-1.h5 part-2.h5"},
          .run = [options, run_rows_here](Session& session) {
            return run(*options, run_rows_here, session);
          }};
}

}  // namespace rholm::cli
