// Description of a batch: a command, its options, and the shapes of a manifest. Layer: cli.
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
  std::vector<std::string> words;  // words after --: options of the command, or parts to merge
  std::string shard;               // "2/8": one of several shards; empty: all rows
  std::string outputs;             // folder for the command's files; empty: files are not kept
  bool merge = false, restart = false, no_times = false, strict = false, coefficients = false;
  bool raw_cells = false;
  bool json = false;
};

// Functions of the program that a batch needs.
struct BatchCommands {
  // Makes a command with its own options; throws UsageError for an unknown name.
  std::function<Command(const std::string& name)> make;
  // Describes a written expansion in JSON, in addition to the report.
  std::function<Json(const Expansion&, const Context&)> describe;
};

struct BatchJob {
  BatchOptions options;
  BatchCommands commands;
  std::vector<char> manifest_text;
  Manifest manifest;                    // parsed from the text
  std::filesystem::path folder;         // base of relative paths
  std::vector<std::size_t> rows;        // rows to process, by number: all, or those of a shard
  std::vector<std::string> file_names;  // names of the command's output files, for all rows
  std::string extension;                // extension of these files; empty: the command writes none
  std::string job;                      // fingerprint of everything except the shard
};

// Makes the job. Throws UsageError for errors that need no shape (also in the command's options, by
// a run for a file that cannot exist), InvalidInput and Io for the manifest.
BatchJob make_job(const BatchOptions& options, const BatchCommands& commands);
// Makes the job from the text of a manifest.
BatchJob make_job(const BatchOptions& options, const BatchCommands& commands,
                  std::vector<char> manifest_text);

// Returns the words of the command for a shape; `output` is its output file, if it writes one.
std::vector<std::string> command_words(const BatchJob& job, const std::string& path,
                                       const std::string& output);

// Returns the leading columns, in order.
std::vector<std::string> leading_columns(const Manifest& manifest, bool with_times);

// Returns the columns that a row takes from the manifest.
BatchRow carried_cells(const Manifest& manifest, std::size_t row);

// Throws UsageError unless the name of the results' file implies a format.
void check_results_name(const std::string& path);

Manifest read_manifest(const std::string& path);

}  // namespace rholm::cli
