// Runs from a file to coefficients.
#include "rholm_bench/bench.h"

#include <string>
#include <utility>

#include "io/file/temporary_folder.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm_bench/bench_timing.h"
#include "rholm_bench/peak_memory.h"

namespace rholm {
namespace {

using Runs = std::map<std::string, std::vector<StageTime>>;

EncodeOptions encode_options(const BenchOptions& options) {
  EncodeOptions wanted;
  wanted.analyze = {.degree = options.degree, .precision = options.precision};
  wanted.errors = false;  // a separate stage, not part of the transform
  wanted.chart.allow_signed = options.allow_signed;
  return wanted;
}

EncodeOptions about(const Vec3& center, EncodeOptions wanted) {
  wanted.chart.center = {.kind = CenterKind::kGiven, .point = center, .rays = 0};
  return wanted;
}

StageTime minus(const StageTime& a, const StageTime& b) { return {a.wall - b.wall, a.cpu - b.cpu}; }

// Runs once and notes the stages.
Encoded run(const std::filesystem::path& path, const EncodeOptions& wanted, const Context& context,
            Runs& runs) {
  StageTimes times;
  Encoded encoded =
      timed(times, "coefficients", [&] { return encode_file(path, wanted, context); });
  times.insert(encoded.times.begin(), encoded.times.end());
  times.insert(encoded.analysis.times.begin(), encoded.analysis.times.end());
  times["coefficients"] = minus(times["coefficients"], times["norms"]);
  times.erase("transform");  // time outside its parts is small
  for (const auto& [name, time] : times) runs[name].push_back(time);
  return encoded;
}

void write_once(const Expansion& expansion, const std::filesystem::path& folder, Runs& runs) {
  const std::filesystem::path path = folder / "model.h5";
  std::filesystem::remove(path);  // replacing an existing file would take longer
  runs["write"].push_back(time_once([&] { write_model(expansion, path); }));
}

double median_speedup(const std::vector<StageTime>& base, const std::vector<StageTime>& runs) {
  std::vector<double> ratios;
  ratios.reserve(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) ratios.push_back(base[i].wall / runs[i].wall);
  return median(ratios);
}

BenchRuns summary(int threads, const Runs& runs, const std::vector<StageTime>& base) {
  BenchRuns result{.threads = threads, .stages = {}};
  for (const auto& [name, times] : runs) {
    if (name != "center" || runs.contains("topology")) result.stages[name] = timing_of(times);
  }
  result.speedup = median_speedup(base, runs.at("coefficients"));
  return result;
}

// Compares runs that search for a centre with runs that do not.
void summarise_center(const Runs& searched, const Runs& given, FileBench& bench) {
  bench.center = timing_of(searched.at("center"));
  std::vector<double> extra;
  const auto &with = searched.at("coefficients"), &without = given.at("coefficients");
  extra.reserve(with.size());
  for (std::size_t i = 0; i < with.size(); ++i) extra.push_back(with[i].cpu - without[i].cpu);
  bench.center_extra_cpu = median(extra);
}

}  // namespace

void check(const BenchOptions& options) {
  const auto least = [](int value, int limit, const char* what) {
    if (value >= limit) return;
    throw Error(ErrorCode::kInvalidInput, std::string(what) + " must be at least " +
                                              std::to_string(limit) + ", not " +
                                              std::to_string(value));
  };
  least(options.repeat, 1, "the number of runs");
  least(static_cast<int>(options.threads.size()), 1, "the number of thread counts");
  for (const int threads : options.threads) least(threads, 1, "a number of threads");
}

FileBench bench_file(const std::filesystem::path& path, const BenchOptions& options,
                     const Context& context) {
  check(options);
  FileBench bench;
  bench.file_bytes = std::filesystem::file_size(path);
  const EncodeOptions search = encode_options(options);
  // The first run is not counted: it loads the file into memory, plans transforms, starts threads.
  Runs first, searched;
  const EncodeOptions given =
      about(run(path, search, measured(context, 0, 0), first).star.center, search);
  std::vector<Runs> runs(options.threads.size());
  std::optional<TemporaryFolder> folder;
  if (!options.folder.empty()) folder.emplace(options.folder, "rholm-bench-");
  for (int i = 0; i < options.repeat; ++i) {
    const double fraction = static_cast<double>(i) / options.repeat;
    for (std::size_t t = 0; t < runs.size(); ++t) {
      const bool watched = i == 0 && t == 0 && restart_peak_memory();
      if (watched) bench.memory_before = resident_memory();
      bench.encoded = run(path, given, measured(context, options.threads[t], fraction), runs[t]);
      if (watched) bench.memory_peak = peak_memory();
    }
    if (folder) write_once(bench.encoded.analysis.expansion, folder->path(), runs[0]);
    run(path, search, measured(context, options.threads[0], fraction), searched);
  }
  for (std::size_t t = 0; t < runs.size(); ++t) {
    bench.runs.push_back(summary(options.threads[t], runs[t], runs[0].at("coefficients")));
  }
  summarise_center(searched, runs[0], bench);
  return bench;
}

}  // namespace rholm
