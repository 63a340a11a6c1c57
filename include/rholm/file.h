// Reading and writing of whole files. Layer: io.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rholm/image.h"

namespace rholm {

// Writes bytes to a temporary file beside `path`, which replaces `path` when complete: an
// interrupted run leaves the old file unchanged. "-" is standard output. Throws Io.
void write_file(const std::filesystem::path& path, std::span<const char> bytes);

// Returns a PNG file in memory. Throws InvalidInput for an image whose buffer has a wrong size.
std::vector<char> encode_png(const Image& image);
// Writes a PNG file by write_file(). Throws Io as well.
void write_png(const std::filesystem::path& path, const Image& image);

// Removes the temporary files of all writes in progress. It is async-signal-safe: a program may
// call it in a signal handler before it exits.
void discard_unfinished_files() noexcept;

}  // namespace rholm
