#include "rholm/file.h"

#include "io/file/atomic_file.h"

namespace rholm {

void write_file(const std::filesystem::path& path, std::span<const char> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace rholm
