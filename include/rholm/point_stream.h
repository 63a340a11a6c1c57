// Reading the points of a file in portions: for files larger than memory. Layer: io.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/shape_io.h"

namespace rholm {

// Reads a file from beginning to end, and holds only the requested portion in memory. Formats are
// PLY (binary and ascii; vertices of a mesh) and lines of numbers (XYZ, PWN, TXT, CSV). The values
// are the same as from read_shape(). Columns are identified in the same way, from the header and
// the first mebibyte.
class PointStream {
 public:
  // Opens the file; "-" is standard input. Throws Io if it cannot be read, InvalidInput if it is
  // malformed or has no points, Unsupported for other formats. Also Unsupported if points are not
  // stored one after the other: a PLY whose vertices have lists or do not come first, a PWN with
  // normals behind all points.
  explicit PointStream(const std::filesystem::path& path, const ShapeReadOptions& options = {});
  ~PointStream();
  PointStream(const PointStream&) = delete;
  PointStream& operator=(const PointStream&) = delete;

  // Replaces the contents of `cloud` by the next points, at most n; returns false at the end. All
  // points have the same attributes of the same types. Throws as above, Cancelled, and InvalidInput
  // for a value that does not fit the type of its column so far.
  bool read(std::size_t n, PointCloud& cloud, const Context& context = {});

  std::uint64_t read_so_far() const;  // number of points so far, without points that are not finite
  std::uint64_t dropped() const;      // number of points so far that are not finite
  // Returns the number of points in the file, including points not finite, if the file states it.
  std::optional<std::uint64_t> size() const;
  double part_read() const;             // share of the bytes; 0 while their number is unknown
  ShapeFormat format() const;           // kPly or kXyz
  const std::string& encoding() const;  // as in ShapeFile
  bool has_faces() const;               // true for a mesh
  // Returns true if the file is a binary PLY with exactly these points and nothing else.
  bool is_all() const;
  const std::vector<std::string>& warnings() const;  // skipped contents so far, with counts
  const TableColumns& table() const;                 // as in ShapeFile

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

// Metadata and messages of convert_points().
struct ConvertedPoints {
  std::uint64_t points = 0;                // number of points
  std::vector<Attribute> attributes = {};  // attributes of the input, without values
  std::vector<std::string> warnings = {};  // warnings of read_shape() on points
  TableColumns table = {};                 // as in ShapeFile
};
// Converts the points of a file to PLY or XYZ (options.format, or the extension), with at most 30
// MB of points in memory. It writes the same bytes as read_shape() with write_shape(). `columns` is
// as in ShapeReadOptions. The file is read twice if points must be counted (lines of numbers to
// PLY, points that are not finite), or if normals must be inspected (to XYZ). Throws as both
// functions. Throws Unsupported, and writes nothing, for other formats and for meshes, whose faces
// would be lost.
ConvertedPoints convert_points(const std::filesystem::path& from, const std::filesystem::path& to,
                               const ShapeWriteOptions& options = {}, const Context& context = {},
                               const std::string& columns = {});

}  // namespace rholm
