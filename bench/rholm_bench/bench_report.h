// What the benchmark found, as JSON and as text.
#pragma once

#include <optional>
#include <string>

#include "cli/terminal/json_text.h"
#include "rholm_bench/bench.h"

namespace rholm::cli {

// One mesh at one degree and precision.
struct BenchCase {
  std::string mesh;           // the file's name, or what the program made
  bool random_order = false;  // of its triangles
  int degree = 0;
  double precision = 0;
  FileBench file;
  CoefficientsError error;
  std::string reference;  // what the error is the distance from
  // Where measured: not again for random order.
  std::optional<SumsBench> sums;
  std::optional<FloorsBench> floors;
  double slowdown = 1;  // of random order against that of the file
};

// Processor, number of threads it runs at once, vector instructions, compiler.
Json machine_json();
std::string machine_text();

Json case_json(const BenchCase& run);
std::string case_text(const BenchCase& run);

Json json_of(const CoefficientsError& error);

}  // namespace rholm::cli
