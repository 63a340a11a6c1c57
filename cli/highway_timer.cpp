// Highway 1.0 measures the resolution of the processor's clock whenever it is loaded, for
// benchmarks that nobody here runs: 4 ms of the 14 that a start takes. The program's own symbol
// goes before that of the library. Where that has another name one day, only time is lost.
#include <hwy/nanobenchmark.h>

namespace hwy::platform {

uint64_t TimerResolution() { return 1; }

}  // namespace hwy::platform
