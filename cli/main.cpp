// The program rholm. Layer: cli.
#include <cstdlib>

#include "cli/program.h"
#include "cli/terminal/bus_error.h"
#include "cli/terminal/interrupt.h"
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

// Pages that are given back to the system are found and cleared again for the next array: 5 to 7 %
// of the time of pictures and reports. So arrays of pictures are not given back, nor are some of
// these at the end of the heap; larger ones, as reconstruct has, are: with 32 MB for 16 a million
// points take 609 MB instead of 564.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargest = 16 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 16 * kLargest);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  rholm::cli::install_signal_handlers();
  rholm::cli::install_bus_error_handler();
  return rholm::cli::run_program({argv + 1, argv + argc});
}
