// The memory this process has in use, and its highest mark, which can be set back.
#pragma once

#include <cstddef>
#include <optional>

namespace rholm {

// None where the system does not tell. Linux does.
std::optional<std::size_t> resident_memory();
std::optional<std::size_t> peak_memory();
// From now on the peak is that of what follows. False if that cannot be had.
bool restart_peak_memory();

}  // namespace rholm
