#include "cli/batch/job.h"
#include "cli/files/formats.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/batch/outputs_folder.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/old_names.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/run.h"
#include "cli/grammar/values.h"
#include "cli/terminal/capture.h"
#include "rholm/error.h"
#include "rholm/version.h"

namespace rholm::cli {
namespace {

// This path cannot exist, because /dev/null is no folder.
constexpr const char* kNoFile = "/dev/null/shape";

// Returns the rows i - 1, i - 1 + n, ... of the manifest for --shard i/n.
std::vector<std::size_t> rows_of_shard(const std::string& shard, std::size_t n_rows) {
  std::uint64_t part = 1, parts = 1;
  if (!shard.empty()) {
    const std::vector<std::string> numbers = split(shard, '/');
    const bool read = numbers.size() == 2 && read_whole(numbers[0], part) &&
                      read_whole(numbers[1], parts) && part >= 1 && part <= parts;
    if (!read) {
      throw UsageError(
          fmt::format("--shard is '{}'; it must be I/N with 1 <= I <= N, for example 2/8", shard));
    }
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = part - 1; row < n_rows; row += parts) rows.push_back(row);
  return rows;
}

void check_words(const BatchOptions& options, const PerShape& about) {
  for (const std::string& word : options.words) {
    const std::string name = word.substr(0, word.find('='));
    if (name == "--output" || (word.starts_with("-o") && !word.starts_with("--"))) {
      throw UsageError(fmt::format(
          "'{}' names the same file for all shapes; --outputs DIR keeps the files of '{}'", word,
          options.command));
    }
    if (name == "--json" || name == "--threads" || name == "--quiet") {
      throw UsageError(fmt::format("'{}' is an option of the batch; write it before --", word));
    }
    if (!about.one_file.empty() && name == "--" + about.one_file) {
      throw UsageError(fmt::format("'{}' names the same file for all shapes; leave it out", word));
    }
  }
}

std::string chosen_format(const Command& command) {
  for (const Option& option : command.options) {
    const auto* target = std::get_if<std::string*>(&option.target);
    if (option.name == "format" && target != nullptr) return **target;
  }
  return {};
}

// Parses the options, then runs the command for a file that does not exist. An error before it
// opens the file is an error for all shapes.
void check_command(BatchJob& job) {
  const std::string& name = job.options.command;
  const Command command = job.commands.make(name);
  if (!command.per_shape) {
    throw UsageError(
        fmt::format("'{}' cannot run in a batch, because it does not report on one shape", name));
  }
  check_words(job.options, *command.per_shape);
  job.extension = command.per_shape->extension;
  if (job.options.outputs.empty() && !command.per_shape->writes_always) job.extension.clear();
  if (!job.options.outputs.empty() && job.extension.empty()) {
    throw UsageError(fmt::format("--outputs does not apply to '{}', which writes no file", name));
  }
  const auto words = [&] {
    return command_words(job, kNoFile, job.extension.empty() ? "" : "out." + job.extension);
  };
  CommonOptions common;
  try {
    std::vector<std::string> today = words();
    replace_old_names(command, today);
    parse(command, today, common);
    const std::string format = chosen_format(command);
    if (!format.empty() && !job.extension.empty()) job.extension = extension_of_format(format);
    const Capture silent;
    Session session(common);
    command.run(session);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} (option of '{}' after --)", error.what(), name));
  } catch (const std::exception&) {
    return;  // all checks before opening the file passed
  }
}

// Returns a fingerprint of everything that determines a row.
std::string fingerprint_of(const BatchJob& job) {
  std::vector<std::string> texts = {kVersion, job.options.command, job.options.outputs,
                                    job.options.no_times ? "without times" : "with times"};
  texts.insert(texts.end(), job.options.words.begin(), job.options.words.end());
  texts.insert(texts.end(), job.manifest.columns.begin(), job.manifest.columns.end());
  for (const ManifestItem& item : job.manifest.items) {
    texts.push_back(item.id);
    texts.push_back(item.path);
    texts.insert(texts.end(), item.values.begin(), item.values.end());
  }
  return fmt::format("{:016x}", fingerprint(texts));
}

// Checks everything that does not need the manifest.
BatchJob checked_job(const BatchOptions& options, const BatchCommands& commands) {
  BatchJob job;
  job.options = options;
  job.commands = commands;
  check_results_name(options.output);
  rows_of_shard(options.shard, 0);
  check_command(job);
  return job;
}

void add_manifest(BatchJob& job, std::vector<char> text) {
  const BatchOptions& options = job.options;
  job.manifest = parse_manifest(text, display_name(options.manifest));
  job.manifest_text = std::move(text);
  job.rows = rows_of_shard(options.shard, job.manifest.items.size());
  if (options.manifest != "-") {
    job.folder = std::filesystem::path(options.manifest).parent_path();
  }
  job.file_names = file_names(job.manifest);
  job.job = fingerprint_of(job);
}

}  // namespace

void check_results_name(const std::string& path) {
  const std::string extension = extension_of(path);
  if (path == "-" || (extension != ".h5" && extension != ".csv")) {
    throw UsageError(
        fmt::format("'{}' has no known extension; the results are NAME.h5 or NAME.csv", path));
  }
}

Manifest read_manifest(const std::string& path) {
  const std::vector<char> text = read_all_bytes(path);
  return parse_manifest(text, display_name(path));
}

std::vector<std::string> leading_columns(const Manifest& manifest, bool with_times) {
  std::vector<std::string> columns;
  for (const std::string& column : batch_columns()) {
    if (column == "exit_code") {
      columns.insert(columns.end(), manifest.columns.begin(), manifest.columns.end());
    }
    if (with_times || !column.ends_with("seconds")) columns.push_back(column);
  }
  return columns;
}

BatchRow carried_cells(const Manifest& manifest, std::size_t row) {
  const ManifestItem& item = manifest.items[row];
  BatchRow cells = {{"id", item.id}, {"path", item.path}};
  for (std::size_t i = 0; i < manifest.columns.size(); ++i) {
    cells.emplace_back(manifest.columns[i], item.values[i]);
  }
  return cells;
}

std::vector<std::string> command_words(const BatchJob& job, const std::string& path,
                                       const std::string& output) {
  std::vector<std::string> words = {path, "--json"};
  if (!output.empty()) {
    words.emplace_back("--output");
    words.push_back(output);
  }
  words.insert(words.end(), job.options.words.begin(), job.options.words.end());
  return words;
}

BatchJob make_job(const BatchOptions& options, const BatchCommands& commands) {
  BatchJob job = checked_job(options, commands);
  add_manifest(job, read_all_bytes(options.manifest));
  return job;
}

BatchJob make_job(const BatchOptions& options, const BatchCommands& commands,
                  std::vector<char> manifest_text) {
  BatchJob job = checked_job(options, commands);
  add_manifest(job, std::move(manifest_text));
  return job;
}

}  // namespace rholm::cli
