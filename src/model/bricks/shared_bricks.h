// Reconstruction in bricks by several processes with one folder. Layer: model, private.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>

#include "model/bricks/brick_crew.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct_bricks.h"

namespace rholm {

// As reconstruct_bricks(), which has the arguments. `begun` is called once the folder is there:
// then all others of the crew have to call help_reconstruct().
struct SharedRun {
  BrickCrew& crew;
  std::function<void()> begun = {};
  // Called with what is thrown, before the folder goes: others may find nothing there then.
  std::function<void(const std::exception_ptr&)> failed = {};
};
BrickReconstruction reconstruct_shared(const std::filesystem::path& points,
                                       const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const SharedRun& run,
                                       const Context& context);
BrickReconstruction reconstruct_shared(const PointCloud& points, const std::filesystem::path& mesh,
                                       const ReconstructOptions& options,
                                       const BrickOptions& bricks, const SharedRun& run,
                                       const Context& context);

// The part of any other process of the crew, with the same arguments. Throws Io if it does not see
// the folder.
void help_reconstruct(const std::filesystem::path& mesh, const ReconstructOptions& options,
                      const BrickOptions& bricks, BrickCrew& crew, const Context& context);

}  // namespace rholm
