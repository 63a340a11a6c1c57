// Points for a reconstruction: in memory, or in a file if they are many. Layer: cli.
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
  std::optional<PointCloud> cloud = {};        // empty: the file has more points than wanted
  std::uint64_t dropped = 0;                   // number of points left out of the cloud: not finite
  std::string file = {};                       // name of the file, for PointStream
  std::string columns = {};                    // its columns, as in ShapeReadOptions
  std::optional<std::uint64_t> n = {};         // number of points, if counted or stated in the file
  std::unique_ptr<SpooledInput> spooled = {};  // owns the file of points from a stream
};

// Reads at most `most` points in a format that PointStream reads, and all points in any
// other format. A mesh gives its vertices, with the mean normals of their faces.
// Warnings of the reader are passed on. Throws as the reader. `columns` is as in
// ShapeReadOptions.
PointsInput read_points_input(const std::string& path, std::uint64_t most,
                              const std::string& columns, const MemoryOptions& memory,
                              Session& session);

// Returns the bounding box of all finite points of the file.
Bounds bounds_of_points(const std::string& file, const std::string& columns, Session& session);

}  // namespace rholm::cli
