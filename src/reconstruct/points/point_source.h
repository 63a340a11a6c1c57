// Points that can be gone through several times, a piece at a time. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "parts/store.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm {

class PointSource {
 public:
  virtual ~PointSource() = default;
  // Goes back to the first point.
  virtual void rewind() = 0;
  // Replaces `piece` by the next points, at least one; false at the end. All pieces have the same
  // attributes, and either all or none have normals.
  virtual bool next(PointCloud& piece, const Context& context) = 0;
  virtual std::optional<std::uint64_t> size() const = 0;  // points, where that is known
  virtual double part_read() const = 0;                   // since the last rewind(), 0 ... 1
  // Points since the last rewind() that are not finite and in no piece.
  virtual std::uint64_t dropped() const { return 0; }
  virtual std::vector<std::string> warnings() const { return {}; }  // of the file
  virtual void finish() {}  // frees memory: no more points will be read
};

// Returns the points of a file, as PointStream reads it. A file that can be read only once ("-", a
// pipe) is copied to the store's piece "input/0" for the next time. Throws as PointStream does.
std::unique_ptr<PointSource> open_points(const std::filesystem::path& path,
                                         const ShapeReadOptions& options, PieceStore& store);

// Returns points in memory, which are not copied and must stay. `dropped` is the number of points
// that their reader has left out.
std::unique_ptr<PointSource> points_in_memory(const PointCloud& cloud, std::uint64_t dropped = 0);
// Does the same, and owns the points until finish().
std::unique_ptr<PointSource> points_in_memory(PointCloud&& cloud, std::uint64_t dropped = 0);

}  // namespace rholm
