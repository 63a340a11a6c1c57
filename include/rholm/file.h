// Whole files: bytes in, bytes out. Layer: io.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rholm/image.h"

namespace rholm {

// Writes bytes to a temporary file beside `path` that replaces it when complete, so that an
// interrupted run leaves the old file whole; "-" is standard output. Throws Io.
void write_file(const std::filesystem::path& path, std::span<const char> bytes);

// A PNG file in memory. Throws InvalidInput for an image whose buffer does not fit.
std::vector<char> encode_png(const Image& image);
// Writes it in the same way. Throws Io as well.
void write_png(const std::filesystem::path& path, const Image& image);

// Removes the temporary files of all writes in progress. Async-signal-safe: for a program
// that leaves from a signal handler.
void discard_unfinished_files() noexcept;

}  // namespace rholm
