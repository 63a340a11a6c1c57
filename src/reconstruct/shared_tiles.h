// Reconstruction by this process, and by several with one folder. Layer: reconstruct, private.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "parts/executor.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Who works on tiles. `begun` is called with the folder of a shared run once it is there: then all
// other processes have to call help_reconstruct().
struct SharedRun {
  Executor& executor;
  std::function<void(const std::filesystem::path& folder)> begun = {};
  // Called with what is thrown, before the folder goes: others may find nothing there then.
  std::function<void(const std::exception_ptr&)> failed = {};
};

// Reconstructs a file that PointStream can read, as reconstruct() does. The output may have any
// name.
Reconstruction reconstruct_tiles(const std::filesystem::path& points, const std::string& columns,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);
// The same of points in memory, which must not change meanwhile. `dropped` more were left out by
// their reader.
Reconstruction reconstruct_tiles(const PointCloud& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);
// The same, without a copy of the points.
Reconstruction reconstruct_tiles(PointCloud&& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);

// The part of any other process, with the same options. Throws Io if it does not see
// the folder.
void help_reconstruct(const std::filesystem::path& folder, const ReconstructOptions& options,
                      Executor& executor, const Context& context);

// Bytes of ReconstructOptions::max_memory that are enough for the work on tiles, beside what is
// stored in memory: with what runs have taken beyond their forecast.
std::uint64_t enough_for_tiles(std::uint64_t points, std::uint64_t tile_points);

}  // namespace rholm
