#include "rholm_bench/bench_report.h"

#include <fstream>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace rholm::cli {
namespace {

// A line of the table: `total` seconds for all faces and sources.
struct Row {
  std::string name;   // in JSON
  std::string label;  // in text
  Timing total;
};

std::size_t sources_of(const FileBench& file) {
  const Transform& transform = file.expanded.transform;
  return transform.fast ? transform.fast->vertices + transform.fast->nodes
                        : transform.edge_nodes + transform.face_nodes;
}

double per(double amount, std::size_t n) { return n > 0 ? amount / static_cast<double>(n) : 0; }

std::vector<Row> stage_rows(const Timings& stages) {
  constexpr std::pair<const char*, const char*> kStages[] = {
      {"coefficients", "bytes to coefficients"},
      {"read", "- look at file, map or read"},
      {"topology", "- join, pair edges"},
      {"center", "- check the centre"},
      {"order", "- sort the triangles"},
      {"faces", "- triangles"},
      {"spread", "- spread"},
      {"fourier", "- Fourier and Legendre"},
      {"verify", "- measured error"},
      {"norms", "norms"},
      {"write", "write a model file"}};
  std::vector<Row> rows;
  for (const auto& [name, label] : kStages) {
    const auto found = stages.find(name);
    if (found != stages.end()) rows.push_back({name, label, found->second});
  }
  return rows;
}

std::vector<Row> sum_rows(const SumsBench& sums) {
  return {{"adjoint", "adjoint, weights", sums.adjoint},
          {"adjoint_with_gradient", "adjoint, with gradients", sums.adjoint_with_gradient},
          {"forward_with_gradient", "forward, with gradients", sums.forward_with_gradient},
          {"direct", "adjoint, weights, direct", sums.direct}};
}

std::vector<Row> floor_rows(const FloorsBench& floors) {
  return {{"file_read", "read the bytes", floors.file_read},
          {"copy", "copy as many bytes", floors.copy},
          {"row_updates", "row updates alone", floors.row_updates},
          {"legendre", "Legendre sums alone", floors.legendre}};
}

Json row_json(const Row& row, std::size_t faces, std::size_t sources) {
  const Timing& t = row.total;
  return {{"cpu_seconds", t.median.cpu},
          {"least_cpu_seconds", t.minimum.cpu},
          {"seconds", t.median.wall},
          {"least_seconds", t.minimum.wall},
          {"cpu_ns_per_face", per(1e9 * t.median.cpu, faces)},
          {"cpu_ns_per_source", per(1e9 * t.median.cpu, sources)}};
}

Json rows_json(const std::vector<Row>& rows, std::size_t faces, std::size_t sources) {
  Json json = Json::object();
  for (const Row& row : rows) json[row.name] = row_json(row, faces, sources);
  return json;
}

double gigabytes_per_second(double bytes, const Timing& timing) {
  return timing.median.cpu > 0 ? 1e-9 * bytes / timing.median.cpu : 0;
}

double ratio(const Timing& a, const Timing& b) {
  return b.median.cpu > 0 ? a.median.cpu / b.median.cpu : 0;
}

Json memory_json(const BenchCase& run) {
  const FileBench& file = run.file;
  Json json = {{"peak_bytes", json_of(file.memory_peak)},
               {"before_bytes", json_of(file.memory_before)},
               {"file_bytes", file.file_bytes}};
  if (run.floors) json["grid_bytes"] = run.floors->grid_bytes;
  return json;
}

void add_floors(const BenchCase& run, std::size_t faces, Json& json) {
  const FloorsBench& floors = *run.floors;
  const double bytes = static_cast<double>(run.file.file_bytes);
  json["floors"] = rows_json(floor_rows(floors), faces, run.file.expanded.vertices);
  json["floors"]["file_read"]["gigabytes_per_second"] =
      gigabytes_per_second(bytes, floors.file_read);
  json["floors"]["copy"]["gigabytes_per_second"] = gigabytes_per_second(bytes, floors.copy);
}

void add_sums(const SumsBench& sums, std::size_t faces, Json& json) {
  json["sums"] = rows_json(sum_rows(sums), faces, sums.directions);
  json["sums"]["direct"]["sampled_directions"] = sums.sampled;
  json["ratios"]["direct_to_fast"] = ratio(sums.direct, sums.adjoint);
  json["ratios"]["forward_to_adjoint"] =
      ratio(sums.forward_with_gradient, sums.adjoint_with_gradient);
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

// Formats with at most seven characters, for any time that a person waits for.
std::string figure(double value) { return fmt::format("{:.{}f}", value, value < 1000 ? 3 : 0); }

std::string table_line(const Row& row, std::size_t faces, std::size_t sources,
                       const std::string& note = {}) {
  const Timing& t = row.total;
  return fmt::format("  {:<28}{:>10}{:>10}{:>10}{:>9.2f}{:>11.2f}{}\n", row.label,
                     figure(1e3 * t.median.cpu), figure(1e3 * t.minimum.cpu),
                     figure(1e3 * t.median.wall), per(1e9 * t.median.cpu, faces),
                     per(1e9 * t.median.cpu, sources), note.empty() ? "" : "  " + note);
}

std::string table_head(const std::string& title, const std::string& source) {
  return fmt::format("  {:<28}{:>10}{:>10}{:>10}{:>9}{:>11}\n", title, "CPU ms", "least", "wall ms",
                     "ns/face", "ns/" + source);
}

std::string error_text(const BenchCase& run) {
  const auto& fast = run.file.expanded.transform.fast;
  const char* kind = fast && fast->measured_share > 0 ? "measured" : "estimated";
  std::string text =
      line("error", fmt::format("{:.2g} of the wanted {:.2g}{}; of the degrees above {}: {:.2g}{}",
                                run.error.error, run.precision,
                                fast ? fmt::format(" ({} {:.2g})", kind, fast->error) : "",
                                3 * run.degree / 4, run.error.top_error,
                                fast ? fmt::format(" ({} {:.2g})", kind, fast->band_error) : ""));
  return text + line("", "measured against " + run.reference);
}

std::string memory_text(const BenchCase& run) {
  const FileBench& file = run.file;
  if (!file.memory_peak || !file.memory_before) return "";
  const auto mb = [](std::size_t bytes) { return 1e-6 * static_cast<double>(bytes); };
  std::string text = fmt::format("{:.1f} MB at most, {:.1f} MB of it before the run",
                                 mb(*file.memory_peak), mb(*file.memory_before));
  text += fmt::format("; the file has {:.1f} MB", mb(file.file_bytes));
  if (run.floors) text += fmt::format(", a grid {:.1f} MB", mb(run.floors->grid_bytes));
  return line("memory", text);
}

std::string engine_text(const BenchCase& run) {
  const auto& fast = run.file.expanded.transform.fast;
  if (!fast) return line("sums", "direct");
  return line("sums", fmt::format("in {} precision, windows of {} points, oversampling {:.3g}; {} "
                                  "vertices, {} further nodes",
                                  fast->single ? "single" : "double", fast->width,
                                  fast->oversampling, fast->vertices, fast->nodes));
}

std::string runs_text(const BenchCase& run) {
  const FileBench& file = run.file;
  const std::size_t faces = file.expanded.faces, sources = sources_of(file);
  std::string text;
  for (const BenchRuns& runs : file.runs) {
    text += table_head(
        fmt::format("{}, centre given", counted(static_cast<std::size_t>(runs.threads), "thread")),
        "source");
    for (const Row& row : stage_rows(runs.stages)) text += table_line(row, faces, sources);
    if (&runs == &file.runs.front()) {
      const double extra = file.center_extra_cpu;
      text += fmt::format("  {:<28}{:>10}{:>29.2f}\n", "automatic centre, further",
                          figure(1e3 * extra), per(1e9 * extra, faces));
    } else {
      text += fmt::format("  {:<28}{:>10.2f} times as fast (wall, bytes to coefficients)\n", "",
                          runs.speedup);
    }
  }
  return text;
}

std::string sums_text(const BenchCase& run) {
  const SumsBench& sums = *run.sums;
  std::string text = table_head("sums over vertices", "vertex");
  for (const Row& row : sum_rows(sums)) {
    std::string note;
    if (row.name == "direct") {
      note = fmt::format("{:.0f} times the fast ones; from {} of {}",
                         ratio(sums.direct, sums.adjoint), sums.sampled, sums.directions);
    } else if (row.name == "forward_with_gradient") {
      note = fmt::format("{:.2f} times the adjoint",
                         ratio(sums.forward_with_gradient, sums.adjoint_with_gradient));
    }
    text += table_line(row, run.file.expanded.faces, sums.directions, note);
  }
  return text;
}

std::string floors_text(const BenchCase& run) {
  std::string text = table_head("floors", "vertex");
  for (const Row& row : floor_rows(*run.floors)) {
    std::string note;
    if (row.name == "file_read" || row.name == "copy") {
      note = fmt::format("{:.1f} GB/s",
                         gigabytes_per_second(static_cast<double>(run.file.file_bytes), row.total));
    }
    text += table_line(row, run.file.expanded.faces, run.file.expanded.vertices, note);
  }
  return text;
}

}  // namespace

Json json_of(const CoefficientsError& error) {
  return {{"error", error.error},
          {"error_of_top_quarter", error.top_error},
          {"error_of_mean", error.mean},
          {"kinds",
           {{"error", "measured"},
            {"error_of_top_quarter", "measured"},
            {"error_of_mean", "measured"}}}};
}

Json machine_json() {
  return {{"processor", processor()},
          {"threads", std::thread::hardware_concurrency()},
          {"vector_instructions", vector_instructions()},
          {"compiler", compiler()}};
}

std::string machine_text() {
  return fmt::format("{}, {}, {}, {}\n", processor(),
                     counted(std::thread::hardware_concurrency(), "thread"), vector_instructions(),
                     compiler());
}

Json case_json(const BenchCase& run) {
  const FileBench& file = run.file;
  const std::size_t faces = file.expanded.faces, sources = sources_of(file);
  Json json;
  json["mesh"] = run.mesh;
  json["order"] = run.random_order ? "random" : "file";
  json["counts"] = {{"vertices", file.expanded.vertices}, {"faces", faces}, {"sources", sources}};
  json["degree"] = run.degree;
  json["precision"] = run.precision;
  if (file.expanded.transform.fast) json["fast"] = json_of(*file.expanded.transform.fast);
  json["accuracy"] = json_of(run.error);
  json["accuracy"]["reference"] = run.reference;
  json["runs"] = Json::array();
  for (const BenchRuns& runs : file.runs) {
    json["runs"].push_back({{"threads", runs.threads},
                            {"speedup", runs.speedup},
                            {"stages", rows_json(stage_rows(runs.stages), faces, sources)}});
  }
  json["automatic_center"] = {{"stage", row_json({"center", "", file.center}, faces, sources)},
                              {"further_cpu_seconds", file.center_extra_cpu},
                              {"further_cpu_ns_per_face", per(1e9 * file.center_extra_cpu, faces)}};
  if (run.floors) add_floors(run, faces, json);
  if (run.sums) add_sums(*run.sums, faces, json);
  if (run.random_order) json["ratios"]["random_to_file_order"] = run.slowdown;
  json["memory"] = memory_json(run);
  return json;
}

std::string case_text(const BenchCase& run) {
  std::string text =
      fmt::format("\n{}{}: {} vertices, {} faces; degree {}, precision {:g}\n", run.mesh,
                  run.random_order ? " in random order" : "", run.file.expanded.vertices,
                  run.file.expanded.faces, run.degree, run.precision);
  text += engine_text(run) + error_text(run) + memory_text(run);
  if (run.random_order) {
    text += line("order", fmt::format("{:.2f} times the time of the file's order", run.slowdown));
  }
  text += runs_text(run);
  if (run.sums) text += sums_text(run);
  if (run.floors) text += floors_text(run);
  return text;
}

}  // namespace rholm::cli
