#include "cli/batch/row.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/grammar/run.h"
#include "cli/grammar/values.h"
#include "cli/terminal/capture.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"

namespace rholm::cli {
namespace {

double seconds_of(clockid_t clock) {
  timespec now = {};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Returns the output file of the command. Files that are not kept get a folder each, because some
// commands write several files.
std::string output_of(const BatchJob& job, std::size_t row, const std::filesystem::path& scratch) {
  if (job.extension.empty()) return {};
  if (!job.options.outputs.empty()) {
    return (std::filesystem::path(job.options.outputs) /
            fmt::format("{}.{}", job.file_names[row], job.extension))
        .string();
  }
  const std::filesystem::path folder = scratch / fmt::format("{}", row);
  std::filesystem::create_directories(folder);
  return (folder / ("out." + job.extension)).string();
}

// Order: by degree, within each degree m = -l ... l: C_lm at l^2 + l + m, S_lm at l^2 + l - m.
std::vector<double> listed(const Coefficients& coefficients) {
  std::vector<double> list;
  for (int l = 0; l <= coefficients.degree(); ++l) {
    for (int m = l; m > 0; --m) list.push_back(coefficients.s(l, m));
    for (int m = 0; m <= l; ++m) list.push_back(coefficients.c(l, m));
  }
  return list;
}

// Puts the command in front of a name that the manifest or the results already have.
std::string free_name(const BatchJob& job, const std::string& name) {
  const auto& columns = job.manifest.columns;
  const bool taken = is_batch_column(name) ||
                     std::any_of(columns.begin(), columns.end(), [&](const std::string& column) {
                       return column == name || column.starts_with(name + ".");
                     });
  return taken ? job.options.command + "." + name : name;
}

bool is_number_or_null(const Json& value) { return value.is_number() || value.is_null(); }

Cell cell_of_list(const Json& list) {
  if (list.empty()) return {};
  if (std::all_of(list.begin(), list.end(), is_number_or_null)) {
    std::vector<double> numbers;
    for (const Json& value : list) {
      numbers.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                        : value.get<double>());
    }
    return numbers;
  }
  if (!std::all_of(list.begin(), list.end(), [](const Json& v) { return v.is_string(); })) {
    return list.dump();
  }
  std::string text;
  for (const Json& value : list) text += (text.empty() ? "" : "; ") + value.get<std::string>();
  return text;
}

Cell cell_of(const Json& value) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > kMost) return value.get<double>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  return value.is_array() ? cell_of_list(value) : Cell();
}

void flatten_within(const Json& object, const std::string& prefix,
                    const std::function<bool(const std::string&)>& wanted, BatchRow& row) {
  for (const auto& [key, value] : object.items()) {
    const std::string name = prefix + key;
    if (value.is_object()) {
      flatten_within(value, name + ".", wanted, row);
    } else if (wanted(name)) {
      const bool is_there =
          std::any_of(row.begin(), row.end(), [&](const auto& cell) { return cell.first == name; });
      if (!is_there) row.emplace_back(name, cell_of(value));
    }
  }
}

// Flattens an object. Nested values get names joined by dots. Lists of numbers stay lists, lists of
// texts become one text with "; " between, other lists become JSON. null is no value. Leaves out
// names that `wanted` refuses, and names that `row` already has.
void flatten(const Json& report, const std::function<bool(const std::string&)>& wanted,
             BatchRow& row) {
  if (report.is_object()) flatten_within(report, "", wanted, row);
}

// Returns true for a column of times or memory, which differs from run to run.
bool is_of_the_run(const std::string& name) {
  const std::vector<std::string> parts = split(name, '.');
  return std::any_of(parts.begin(), parts.end(), [](const std::string& part) {
    return part == "seconds" || part == "cpu_seconds" || part == "wall_seconds" ||
           part == "times" || part == "peak_memory_bytes";
  });
}

// Returns false for places of files, and for processor times of all threads together, which are no
// results for one row.
bool is_wanted(const BatchJob& job, const std::string& name) {
  if (name == "file" || name == "output" || name == "peak_memory_bytes") return false;
  if (name.ends_with(".cpu") || name.starts_with("cpu_seconds") || name.ends_with(".cpu_seconds")) {
    return false;
  }
  return !job.options.no_times || !is_of_the_run(name);
}

void add_results(const BatchJob& job, const Capture& said, int threads, BatchRow& row) {
  BatchRow found;
  const auto wanted = [&](const std::string& name) { return is_wanted(job, name); };
  const Json report = Json::parse(said.report, nullptr, false);
  flatten(report, wanted, found);
  if (said.expansion) {
    flatten(job.commands.describe(*said.expansion, {.threads = threads}), wanted, found);
    row.emplace_back("coefficients", listed(said.expansion->coefficients));
  }
  for (auto& [name, cell] : found) row.emplace_back(free_name(job, name), std::move(cell));
}

}  // namespace

std::filesystem::path path_of(const BatchJob& job, std::size_t row) {
  const std::filesystem::path path = job.manifest.items[row].path;
  // A shape is neither standard input nor an option.
  const bool is_word = job.folder.empty() && path.native().starts_with('-');
  return (is_word ? "." : job.folder) / path;
}

bool has_failed(const BatchRow& row) {
  const auto found =
      std::find_if(row.begin(), row.end(), [](const auto& c) { return c.first == "exit_code"; });
  return found == row.end() || found->second != Cell(std::int64_t{kDone});
}

std::optional<BatchRow> run_row(const BatchJob& job, std::size_t row, int threads,
                                const std::filesystem::path& scratch) {
  // A row on one thread has its own clock; a row on several threads runs alone.
  const clockid_t cpu = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID;
  const double wall_begin = seconds_of(CLOCK_MONOTONIC), cpu_begin = seconds_of(cpu);
  Capture said;
  const Outcome outcome = outcome_of([&] {
    std::vector<std::string> words =
        command_words(job, path_of(job, row).string(), output_of(job, row, scratch));
    words.push_back(fmt::format("--threads={}", threads));
    return run_command(job.commands.make(job.options.command), words);
  });
  std::error_code ignored;
  std::filesystem::remove_all(scratch / fmt::format("{}", row), ignored);
  if (interrupting_signal() != 0) return std::nullopt;
  BatchRow cells = {{"exit_code", std::int64_t{outcome.code}},
                    {"message", outcome.message},
                    {"warnings", fmt::format("{}", fmt::join(said.warnings, "; "))}};
  if (!job.options.no_times) {
    cells.emplace_back("seconds", seconds_of(CLOCK_MONOTONIC) - wall_begin);
    cells.emplace_back("cpu_seconds", seconds_of(cpu) - cpu_begin);
  }
  add_results(job, said, threads, cells);
  return cells;
}

}  // namespace rholm::cli
