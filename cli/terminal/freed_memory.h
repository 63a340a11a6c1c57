// Placement of arrays in memory, and reuse of freed memory. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rholm::cli {

// Keeps freed memory for reuse. Pages returned to the system must be mapped and cleared again for
// the next array: 5 to 7 % of the time of pictures and reports. Arrays of the size of pictures, and
// some at the end of the heap, are kept. Larger arrays, as in reconstruct, are returned: with 32 MB
// instead of 16 a million points take 609 MB instead of 564.
void keep_freed_memory();

// Puts the first 64 MB of the heap on huge pages, if the system offers them. The first touch of a
// small page costs a page fault, 12 000 for a comparison. Pictures, comparisons and small analyses
// take 3 to 8 % less time with 1 to 2 MB more. Call it after keep_freed_memory().
void start_on_huge_pages();

// Keeps up to a gibibyte of freed memory: for work in tiles, which repeats arrays of the same
// sizes. On one thread, 4 million points take 8.8 s in the kernel instead of 19.7, with 8 % more
// memory.
void keep_large_freed_memory();

// Limits the memory of the process to `bytes` plus the small amount at its start, for the given
// threads. Larger allocations throw std::bad_alloc. Freed memory returns to the system at once,
// because it would count. Pages of mapped files do not count.
void limit_memory(std::size_t bytes, int threads);
// Returns the latest limit of limit_memory(), if any.
std::optional<std::size_t> memory_limit();
// Records a number of bytes that surely suffices for the work; the largest one counts.
void note_enough_memory(double bytes);
// Returns "this needs more than the 0.1 GiB of --max-memory", with a sufficient limit if known.
std::string beyond_memory_limit();
// Returns `bytes` as a value of --max-memory: GiB with two digits, rounded up.
std::string limit_to_type(double bytes);

}  // namespace rholm::cli
