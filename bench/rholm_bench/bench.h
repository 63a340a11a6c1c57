// How long the way from a mesh to its coefficients takes on this machine, and what bounds it: what
// bench/rholm_bench is made of.
//
// Everything is measured, nothing printed. Each kind of run is repeated; kinds that are compared
// take turns, so that what else the machine does meets all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rholm/analyze.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/model.h"
#include "rholm_bench/bench_timing.h"

namespace rholm {

using Timings = std::map<std::string, Timing>;

struct BenchOptions {
  int degree = 256;
  double precision = 1e-6;
  bool allow_signed = false;  // see ChartOptions
  int repeat = 5;             // runs of each kind, at least 1
  // Numbers of threads for the way from file to coefficients, the first to compare with. All other
  // measurements are of one thread.
  std::vector<int> threads = {1};
  // An existing folder, where a model file is written and removed; empty: nothing is written.
  std::filesystem::path folder = {};
};

// Throws InvalidInput for options out of range.
void check(const BenchOptions& options);

// From the bytes of a file to coefficients, the centre given.
struct BenchRuns {
  int threads = 0;
  // "coefficients" is all of it but the norms; "norms"; parts of the first that are known: "read"
  // (looking at the file and mapping it, or reading), "topology", "center" (of meshes that
  // cannot stay where they lie), "order" (of triangles in random order), "triangles", "spread",
  // "fourier", "verify"; "write" of a model file.
  Timings stages;
  // Wall time of the first number of threads over that of this one: median over pairs of runs.
  double speedup = 1;
};

struct FileBench {
  Encoded encoded;  // of the last run
  std::uintmax_t file_bytes = 0;
  std::vector<BenchRuns> runs;  // one for each number of threads
  Timing center;                // finding the centre: the stage where it is searched
  double center_extra_cpu = 0;  // what the search makes the whole longer, median
  // Memory in use just before a run, and the most during it, pages of the file included; none where
  // the system does not tell.
  std::optional<std::size_t> memory_before, memory_peak;
};

// Measures encode_file(), with a first run that is not counted. Throws what that throws, and
// InvalidInput for options out of range.
FileBench bench_file(const std::filesystem::path& path, const BenchOptions& options,
                     const Context& context = {});

// Sums over the directions of a mesh's vertices by themselves, one thread.
struct SumsBench {
  std::size_t directions = 0;
  Timing adjoint;                // add_adjoint() of weights
  Timing adjoint_with_gradient;  // and of gradients
  Timing forward_with_gradient;  // evaluate_with_gradient()
  // add_adjoint() of weights by the direct engine: of a sample of the directions, even over the
  // mesh, and scaled to all.
  std::size_t sampled = 0;
  Timing direct;
};
SumsBench bench_sums(const Mesh& mesh, const Expansion& expansion, const BenchOptions& options,
                     const Context& context = {});

// What bounds the stages, one thread: the same amount of work stripped of everything else.
struct FloorsBench {
  Timing file_read;  // the file's bytes, page cache to a small buffer
  Timing copy;       // as many bytes from one array to another
  // The cells that the window of each vertex covers, updated with constant taps: the spread without
  // its window. As many points and the same precision as `fast` says.
  Timing row_updates;
  Timing legendre;             // the Legendre sums of the transform, on as many rings
  std::size_t grid_bytes = 0;  // of one grid
};
FloorsBench bench_floors(const std::filesystem::path& path, const Mesh& mesh,
                         const Expansion& expansion, const FastReport& fast,
                         const BenchOptions& options, const Context& context = {});

// Distance of two sets of coefficients of one degree.
struct CoefficientsError {
  double error = 0;      // l2 over 1 <= l <= L, relative to that norm of the reference
  double top_error = 0;  // of the degrees above 3L/4, relative to that band of the reference
  double mean = 0;       // of c_00, relative to it
};
CoefficientsError compare_coefficients(const Coefficients& found, const Coefficients& reference);

// Coefficients to compare with: about the given centre, by the direct engine where that takes no
// longer than seconds, else by the fast one; far more precise than `precision` wants.
struct Reference {
  Coefficients coefficients;
  Engine engine = Engine::kFast;
  double precision = 0;
};
Reference bench_reference(const std::filesystem::path& path, const Vec3& center,
                          const BenchOptions& options, const Context& context = {});

// What such a fast reference is worth: its distance from direct sums with quadrature of their own,
// on a mesh of 5120 triangles at degree 64.
CoefficientsError bench_reference_error(const Context& context = {});

// The vector instructions that inner loops use here: "AVX3" (which is AVX-512), "AVX2", ...
std::string vector_instructions();

}  // namespace rholm
