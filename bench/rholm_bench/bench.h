// Measures the time from a mesh to its coefficients on this machine, and lower bounds for it: the
// parts of the program bench/rholm_bench.
//
// Everything is measured, nothing is printed. Each kind of run is repeated. Kinds that are compared
// take turns, so that other load of the machine affects all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/model.h"
#include "rholm/transform.h"
#include "rholm_bench/bench_timing.h"

namespace rholm {

using Timings = std::map<std::string, Timing>;

struct BenchOptions {
  int degree = 256;
  double precision = 1e-6;
  bool allow_signed = false;  // see ChartOptions
  int repeat = 5;             // runs of each kind, at least 1
  // Numbers of threads for runs from file to coefficients; the first number is the reference. All
  // other measurements use one thread.
  std::vector<int> threads = {1};
  // Existing folder in which a model file is written and removed; if empty, nothing is written.
  std::filesystem::path folder = {};
};

// Throws InvalidInput for options out of range.
void check(const BenchOptions& options);

// Times of runs from the bytes of a file to coefficients, with a given centre.
struct BenchRuns {
  int threads = 0;
  // Times of stages. "norms" are the norms, "coefficients" everything else. "write" is the time of
  // writing a model file. Parts of "coefficients" are "read" (mapping or reading the file), "order"
  // (of triangles in random order), "topology" and "center". Meshes used in place have no "center".
  // Other parts are "faces", "spread", "fourier" and "verify".
  Timings stages;
  // Wall time at the first number of threads over wall time at this one: median over pairs of runs.
  double speedup = 1;
};

struct FileBench {
  Expanded expanded;  // result of the last run
  std::uintmax_t file_bytes = 0;
  std::vector<BenchRuns> runs;  // one for each number of threads
  Timing center;                // the stage that finds the centre, where it is searched
  double center_extra_cpu = 0;  // additional time of runs with the search, median
  // Bytes in use before a run, and the largest number during it, with pages of the file; absent
  // where the system does not report them.
  std::optional<std::size_t> memory_before, memory_peak;
};

// Measures expand_file() after a first run that is not counted. Throws the errors of expand_file(),
// and InvalidInput for options out of range.
FileBench bench_file(const std::filesystem::path& path, const BenchOptions& options,
                     const Context& context = {});

// Times of sums over the directions of a mesh's vertices alone, on one thread.
struct SumsBench {
  std::size_t directions = 0;
  Timing adjoint;                // add_adjoint() of weights
  Timing adjoint_with_gradient;  // add_adjoint() of weights and gradients
  Timing forward_with_gradient;  // evaluate_with_gradient()
  // Time of add_adjoint() of weights by the direct engine, for a sample of the directions taken
  // evenly from the mesh, and scaled to all directions.
  std::size_t sampled = 0;
  Timing direct;
};
SumsBench bench_sums(const Mesh& mesh, const Expansion& expansion, const BenchOptions& options,
                     const Context& context = {});

// Lower bounds of the stages on one thread: the same amount of work without anything else.
struct FloorsBench {
  Timing file_read;  // the file's bytes, page cache to a small buffer
  Timing copy;       // equally many bytes from one array to another
  // Updates of the cells under the window of each vertex with constant taps: spreading without its
  // window. `fast` has the number of grid points and the precision.
  Timing row_updates;
  Timing legendre;             // the Legendre sums of the transform, on equally many rings
  std::size_t grid_bytes = 0;  // bytes of one grid
};
FloorsBench bench_floors(const std::filesystem::path& path, const Mesh& mesh,
                         const Expansion& expansion, const FastReport& fast,
                         const BenchOptions& options, const Context& context = {});

// Distance between two sets of coefficients of the same degree.
struct CoefficientsError {
  double error = 0;      // l2 over 1 <= l <= L, relative to the norm of the reference
  double top_error = 0;  // degrees above 3L/4, relative to the same band of the reference
  double mean = 0;       // error of c_00, relative to the reference's
};
CoefficientsError compare_coefficients(const Coefficients& found, const Coefficients& reference);

// Coefficients to compare with, about the given centre. They come from the direct engine if it
// takes only seconds, otherwise from the fast engine with a far higher precision than `precision`.
struct Reference {
  Coefficients coefficients;
  Engine engine = Engine::kFast;
  double precision = 0;
};
Reference bench_reference(const std::filesystem::path& path, const Vec3& center,
                          const BenchOptions& options, const Context& context = {});

// Returns the error of a fast reference: its distance from direct sums with their own quadrature,
// on a mesh of 5120 triangles at degree 64.
CoefficientsError bench_reference_error(const Context& context = {});

// Returns the vector instructions of inner loops: "AVX3" (which is AVX-512), "AVX2", ...
std::string vector_instructions();

}  // namespace rholm
