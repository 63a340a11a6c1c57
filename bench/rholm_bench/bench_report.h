// Results of the benchmark, as JSON and as text.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json_text.h"
#include "rholm_bench/bench.h"

namespace rholm::cli {

// Results for one mesh at one degree and precision.
struct BenchCase {
  std::string mesh;           // name of the file, or of a made mesh
  bool random_order = false;  // True for triangles in random order
  int degree = 0;
  double precision = 0;
  FileBench file;
  CoefficientsError error;
  std::string reference;  // how the reference was computed
  // Present where measured: not repeated for random order.
  std::optional<SumsBench> sums;
  std::optional<FloorsBench> floors;
  double slowdown = 1;  // time for random order over time for file order
};

// Returns processor, number of parallel threads, vector instructions and compiler.
Json machine_json();
std::string machine_text();

Json case_json(const BenchCase& run);
std::string case_text(const BenchCase& run);

Json json_of(const CoefficientsError& error);

}  // namespace rholm::cli
