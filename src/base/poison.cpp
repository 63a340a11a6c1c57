// This file is compiled twice: for the library, and with RHOLM_POISON_SCRATCH for the test
// programs.
#include "base/poison.h"

#include <cstring>

namespace rholm {

#ifdef RHOLM_POISON_SCRATCH
// All bits set are a NaN in single and in double precision.
void poison_scratch(void* data, std::size_t bytes) {
  if (bytes > 0) std::memset(data, 0xFF, bytes);
}
#else
void poison_scratch(void*, std::size_t) {}
#endif

}  // namespace rholm
