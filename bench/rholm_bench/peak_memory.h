// The memory that this process has in use, and its peak, which can be reset.
#pragma once

#include <cstddef>
#include <optional>

namespace rholm {

// Returns bytes, or nothing where the system does not report them. Linux does.
std::optional<std::size_t> resident_memory();
std::optional<std::size_t> peak_memory();
// Resets the peak to the memory in use. Returns false if this is not possible.
bool restart_peak_memory();

}  // namespace rholm
