// The cost of one small mesh, which bench/python/overhead.py compares with Python: CPU and wall
// time of `count` calls of encode() at 320 faces and degree 16, as JSON on standard output. Usage:
// small_meshes_bench [COUNT [THREADS]]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "rholm/model.h"
#include "rholm/primitives.h"

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 1000;
  const int threads = argc > 2 ? static_cast<int>(std::strtol(argv[2], nullptr, 10)) : 1;
  const rholm::Mesh mesh = rholm::bumpy_sphere(2);  // 320 faces
  double sum = 0;                                   // keeps the compiler from removing calls
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  for (long i = 0; i < count; ++i) {
    const auto encoded = rholm::encode(mesh, {.analyze = {.degree = 16}}, {.threads = threads});
    sum += encoded.analysis.expansion.coefficients.c(0, 0);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  std::printf("{\"wall\": %.6f, \"cpu\": %.6f, \"sum\": %.17g}\n", wall.count(),
              static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, sum);
  return 0;
}
