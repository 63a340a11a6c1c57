// Where arrays lie, and what becomes of memory that is freed. Layer: cli.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rholm::cli {

// Pages that are given back to the system are found and cleared again for the next array: 5 to 7 %
// of the time of pictures and reports. So arrays of pictures are not given back, nor are some of
// these at the end of the heap; larger ones, as reconstruct has, are: with 32 MB for 16 a million
// points take 609 MB instead of 564.
void keep_freed_memory();

// The first 64 MB of the heap on huge pages, where the system offers them: a first touch of each
// small one costs a page fault, 12 000 for a comparison. Pictures, comparisons and small analyses
// take 3 to 8 % less time with 1 to 2 MB more. After keep_freed_memory(), or it is given back.
void start_on_huge_pages();

// All of it, up to a gibibyte: for work in tiles, which has arrays of the same sizes again and
// again, and little else. Of 4 million points on one thread 8.8 s in the kernel instead of 19.7,
// with 8 % more memory.
void keep_large_freed_memory();

// From here on the process is refused memory (std::bad_alloc) beyond `bytes` and the little that it
// has at its start, on so many threads. Memory that is freed goes back to the system at once, since
// it would count. The pages of mapped files do not.
void limit_memory(std::size_t bytes, int threads);
// What limit_memory() was told last, if anything.
std::optional<std::size_t> memory_limit();
// Bytes that are surely enough for the work, about; the largest that was noted counts.
void note_enough_memory(double bytes);
// "this needs more than the 0.1 GiB of --max-memory", with a limit that would do where it is known.
std::string beyond_memory_limit();
// `bytes` as a value of --max-memory: GiB with two digits, rounded up.
std::string limit_to_type(double bytes);

}  // namespace rholm::cli
