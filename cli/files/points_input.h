// Points to make a surface of: in memory, or where they lie, if they are many. Layer: cli.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cli/files/spooled_input.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/session.h"
#include "rholm/mesh.h"
#include "rholm/topology.h"

namespace rholm::cli {

struct PointsInput {
  std::optional<PointCloud> cloud = {};  // none: more than were wanted, in a file
  std::uint64_t dropped = 0;             // points of the file beside the cloud: not finite
  std::string file = {};                 // its name; PointStream reads it
  std::string columns = {};              // of it, as in ShapeReadOptions
  std::optional<std::uint64_t> n = {};   // points, if they have been counted or the file says it
  std::unique_ptr<SpooledInput> spooled = {};  // has the file, where points came from a stream
};

// At most `most` points of files that can be read one after the other, all of others; of a mesh the
// vertices, with the mean normals of their faces. Warnings of the reader are passed on. Throws what
// it throws.
// `columns` is as in ShapeReadOptions.
PointsInput read_points_input(const std::string& path, std::uint64_t most,
                              const std::string& columns, const MemoryOptions& memory,
                              Session& session);

// The box of all points of the file that are finite.
Bounds bounds_of_points(const std::string& file, const std::string& columns, Session& session);

}  // namespace rholm::cli
