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

// Processes that work on tiles. `begun` is called with the folder of a shared run once it is there:
// then all other processes must call help_reconstruct().
struct SharedRun {
  Executor& executor;
  std::function<void(const std::filesystem::path& folder)> begun = {};
  // Called with the exception, before the folder goes: other processes may find nothing there then.
  std::function<void(const std::exception_ptr&)> failed = {};
};

// Reconstructs a file that PointStream can read, as reconstruct() does. The output may have any
// name.
Reconstruction reconstruct_tiles(const std::filesystem::path& points, const std::string& columns,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);
// Does the same with points in memory, which must not change meanwhile. `dropped` is the number of
// points that their reader has left out.
Reconstruction reconstruct_tiles(const PointCloud& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);
// Does the same without a copy of the points.
Reconstruction reconstruct_tiles(PointCloud&& points, std::uint64_t dropped,
                                 const ReconstructOptions& options, const SharedRun& run,
                                 const Context& context);

// Does the part of any other process, with the same options. Throws Io if it does not see the
// folder.
void help_reconstruct(const std::filesystem::path& folder, const ReconstructOptions& options,
                      Executor& executor, const Context& context);

}  // namespace rholm
