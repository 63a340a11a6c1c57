// Points of a file, some at a time: of files larger than memory. Layer: io.
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

// Reads a file from its begin to its end, and never holds more of it than is asked for at a time:
// PLY (binary and ascii; of a mesh its vertices) and points as lines of numbers (XYZ, PWN, TXT,
// CSV), with the same values as read_shape(), which decides what columns are in the same way: from
// the header and the first mebibyte.
class PointStream {
 public:
  // "-" is standard input. Throws Io if it cannot be read, InvalidInput if it is malformed or has
  // no points, Unsupported for other formats, and for those whose points cannot be told one after
  // the other: a PLY whose vertices have lists or do not come first, a PWN with normals behind all
  // points.
  explicit PointStream(const std::filesystem::path& path, const ShapeReadOptions& options = {});
  ~PointStream();
  PointStream(const PointStream&) = delete;
  PointStream& operator=(const PointStream&) = delete;

  // The next points, at most n of them, instead of what `cloud` holds; false at the end. Each has
  // the same attributes, of the same types. Throws as above, and Cancelled; and InvalidInput for a
  // value that is none of the type that its column has had so far.
  bool read(std::size_t n, PointCloud& cloud, const Context& context = {});

  std::uint64_t read_so_far() const;  // points, without those that are not finite
  std::uint64_t dropped() const;      // those that are not finite, so far
  // Points of the whole file with those that are not finite, if it says how many.
  std::optional<std::uint64_t> size() const;
  double part_read() const;             // of the bytes; 0 while their number is not known
  ShapeFormat format() const;           // kPly or kXyz
  const std::string& encoding() const;  // as in ShapeFile
  bool has_faces() const;               // a mesh
  // Whether the file is a binary PLY of these points, to the byte, and of nothing else.
  bool is_all() const;
  const std::vector<std::string>& warnings() const;  // what was passed over so far, with counts
  const TableColumns& table() const;                 // as in ShapeFile

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

// What convert_points() has written.
struct ConvertedPoints {
  std::uint64_t points = 0;                // how many
  std::vector<Attribute> attributes = {};  // of the file that was read, without values
  std::vector<std::string> warnings = {};  // of read_shape(), but for those of other elements
  TableColumns table = {};                 // as in ShapeFile
};
// Writes the points of a file as write_shape() does what read_shape() has read, with the same
// bytes, to PLY or XYZ (options.format, or the extension), and never holds more than some of them:
// 30 MB. `columns` is as in ShapeReadOptions. The file is read twice where points must be counted
// (of lines of numbers to PLY, and where some are not finite) or their normals looked at (to XYZ).
// Throws as both of them, and Unsupported for other formats and for meshes, whose faces would
// be lost; nothing is written then.
ConvertedPoints convert_points(const std::filesystem::path& from, const std::filesystem::path& to,
                               const ShapeWriteOptions& options = {}, const Context& context = {},
                               const std::string& columns = {});

}  // namespace rholm
