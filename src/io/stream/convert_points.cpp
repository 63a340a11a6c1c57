// Converts points from file to file, in blocks.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/plain_text.h"
#include "io/file/atomic_file.h"
#include "io/file/output_buffer.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/point_stream.h"

namespace rholm {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 14;  // points; chosen: 3 MB with ten attributes

// Properties of all points on which the first rows of the written file depend.
struct Ahead {
  std::uint64_t points = 0;
  XyzNames names;
};

Ahead look_ahead(const std::filesystem::path& from, const std::string& columns,
                 const Context& context) {
  PointStream stream(from, {.attributes = false, .columns = columns});
  Ahead ahead;
  PointCloud piece;
  while (stream.read(kPiece, piece, context)) {
    for (std::size_t i = 0; i < piece.normals.size(); ++i) {
      ahead.names.add(piece.points[i], piece.normals[i]);
    }
  }
  ahead.points = stream.read_so_far();
  return ahead;
}

// The attributes of all blocks, and the numbers of their values that are not finite.
class AttributeNotes {
 public:
  void add(PointCloud& piece) {
    not_finite_.resize(piece.attributes.size());
    for (std::size_t k = 0; k < not_finite_.size(); ++k) {
      const std::vector<double>& values = piece.attributes[k].values;
      not_finite_[k] += static_cast<std::size_t>(std::count_if(
          values.begin(), values.end(), [](double value) { return !std::isfinite(value); }));
    }
    if (!described_.empty()) return;
    for (const Attribute& a : piece.attributes) described_.push_back({a.name, a.type, {}});
  }
  void take_to(ConvertedPoints& converted) {
    for (std::size_t k = 0; k < not_finite_.size(); ++k) {
      if (not_finite_[k] == 0) continue;
      converted.warnings.push_back(not_finite_warning(described_[k].name, not_finite_[k]));
    }
    converted.attributes = std::move(described_);
  }

 private:
  std::vector<Attribute> described_;
  std::vector<std::size_t> not_finite_;
};

[[noreturn]] void refuse_changed(const std::filesystem::path& from) {
  throw Error(ErrorCode::kIo, from.string() + " changed while it was read");
}

}  // namespace

ConvertedPoints convert_points(const std::filesystem::path& from, const std::filesystem::path& to,
                               const ShapeWriteOptions& options, const Context& context,
                               const std::string& columns) {
  const ShapeFormat format = written_format(to, options);
  if (!shape_format_info(format).in_pieces) {
    std::vector<std::string> names;
    for (const ShapeFormatInfo& known : shape_formats()) {
      if (known.in_pieces) names.push_back(known.file.name);
    }
    throw Error(ErrorCode::kUnsupported, "points are written a piece at a time as " +
                                             listed(names, "and") + " only, not as " +
                                             to_string(format));
  }
  std::optional<Ahead> ahead;
  for (;;) {
    PointStream stream(from, {.columns = columns});
    if (stream.has_faces()) {
      throw Error(ErrorCode::kUnsupported, from.string() + " is a mesh: its faces would be lost");
    }
    PointCloud piece;
    if (!stream.read(kPiece, piece, context)) {
      throw Error(ErrorCode::kInvalidInput, from.string() + " has no points");
    }
    const bool is_xyz = format == ShapeFormat::kXyz;
    const bool look = is_xyz ? !piece.normals.empty() : !stream.size() || to == "-";
    if (look && !ahead) ahead = look_ahead(from, columns, context);
    const std::uint64_t points = ahead ? ahead->points : stream.size().value_or(0);

    AtomicFile file(to, context);
    OutputBuffer out(&file, points, context);
    PlyPoints ply(points, options.ascii, out);
    if (is_xyz) put_xyz_header(!piece.normals.empty() && ahead->names.are_needed(), out);
    AttributeNotes notes;
    do {
      notes.add(piece);
      if (is_xyz) {
        put_xyz_rows(shape_view_of(piece), out);
      } else {
        ply.put(piece);
      }
    } while (stream.read(kPiece, piece, context));
    if (ahead && stream.read_so_far() != ahead->points) refuse_changed(from);
    if (!is_xyz && stream.read_so_far() != points) {  // some are not finite
      ahead = look_ahead(from, columns, context);
      continue;
    }
    ConvertedPoints converted{
        .points = stream.read_so_far(), .warnings = stream.warnings(), .table = stream.table()};
    out.flush();
    file.commit();
    notes.take_to(converted);
    return converted;
  }
}

}  // namespace rholm
