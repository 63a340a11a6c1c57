// What a batch is to do: a command, its options, and the shapes of a manifest. Layer: cli.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/batch.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm::cli {

struct BatchOptions {
  std::string manifest, output;
  std::string command = "analyze";
  std::vector<std::string> words;  // behind --: options of the command, or parts to merge
  std::string shard;               // "2/8"; empty: all rows
  std::string outputs;             // the folder; empty: files are not kept
  bool merge = false, restart = false, no_times = false, strict = false, coefficients = false;
  bool raw_cells = false;
  bool json = false;
};

// What the commands of the program bring along.
struct BatchCommands {
  // Makes a command, with options of its own; throws UsageError for a name that is none.
  std::function<Command(const std::string& name)> make;
  // What is said of an expansion that was written, beside the report.
  std::function<Json(const Expansion&, const Context&)> describe;
};

struct BatchJob {
  BatchOptions options;
  BatchCommands commands;
  std::vector<char> manifest_text;
  Manifest manifest;                    // that it is
  std::filesystem::path folder;         // that paths are relative to
  std::vector<std::size_t> rows;        // of the manifest, that are done here: all, or a shard's
  std::vector<std::string> file_names;  // of what the command writes, for all rows
  std::string extension;                // of that; empty: it writes nothing
  std::string job;                      // the fingerprint of what does not depend on the shard
};

// Throws UsageError for everything that is wrong without looking at a shape (options of the
// command, too: it is run for a file that cannot exist), InvalidInput and Io for the manifest.
BatchJob make_job(const BatchOptions& options, const BatchCommands& commands);
// The same for a manifest that is read already.
BatchJob make_job(const BatchOptions& options, const BatchCommands& commands,
                  std::vector<char> manifest_text);

// The words of the command for a shape; `output` is where it writes, if it does.
std::vector<std::string> command_words(const BatchJob& job, const std::string& path,
                                       const std::string& output);

// Columns that come first, in their order.
std::vector<std::string> leading_columns(const Manifest& manifest, bool with_times);

// The columns that a row has from the manifest.
BatchRow carried_cells(const Manifest& manifest, std::size_t row);

// Throws UsageError unless the results' name says a format.
void check_results_name(const std::string& path);

Manifest read_manifest(const std::string& path);

}  // namespace rholm::cli
