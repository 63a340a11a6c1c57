#include "rholm/point_stream.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/plain_text.h"
#include "io/file/input_file.h"
#include "io/ply/ply_body.h"
#include "io/ply/ply_header.h"
#include "io/ply/ply_vertices.h"
#include "io/shapes/plate_table.h"
#include "io/shapes/shape_formats.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/xyz.h"
#include "io/shapes/xyz_columns.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Reads a file from start to end through a window.

class ByteWindow {
 public:
  // Opens a file; "-" is standard input. Throws Io.
  explicit ByteWindow(const std::filesystem::path& path) : file_(path) {}

  const std::string& name() const { return file_.name(); }
  // Reads until the window has n bytes or the file ends; returns the window. Throws Io, Cancelled.
  std::span<const char> at_least(std::size_t n, const Context& context);
  std::span<const char> bytes() const { return {bytes_.data() + first_, last_ - first_}; }
  // Moves the window's start forward.
  void pass(std::size_t n) {
    first_ += n;
    passed_ += n;
  }
  bool ended() const { return ended_; }
  std::uint64_t passed() const { return passed_; }
  std::uint64_t size() const { return file_.size(); }  // 0 for pipes and devices

 private:
  InputFile file_;
  std::uint64_t passed_ = 0;
  bool ended_ = false;
  std::vector<char> bytes_;
  std::size_t first_ = 0, last_ = 0;  // range of the window in bytes_
};

std::span<const char> ByteWindow::at_least(std::size_t n, const Context& context) {
  constexpr std::size_t kLeastRoom = std::size_t{1} << 16;  // default capacity of a pipe
  while (last_ - first_ < n && !ended_) {
    if (first_ > 0) {
      std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(first_),
                bytes_.begin() + static_cast<std::ptrdiff_t>(last_), bytes_.begin());
      last_ -= first_;
      first_ = 0;
    }
    if (bytes_.size() < std::max(n, last_ + kLeastRoom)) {
      // Grows as bytes arrive, because n may exceed the rest of the file.
      bytes_.resize(std::min(std::max(n, last_ + kLeastRoom), 2 * last_ + kLeastRoom));
    }
    const InputFile::Piece piece = file_.read(std::span(bytes_).subspan(last_));
    last_ += piece.size;
    ended_ = piece.ended;
    report_progress(context, "read",
                    size() == 0 ? 0
                                : std::min(1.0, static_cast<double>(passed_ + last_) /
                                                    static_cast<double>(size())));
  }
  return bytes();
}

constexpr std::size_t kMostHeader = std::size_t{1}
                                    << 20;  // bytes of a PLY; chosen: above any sensible header
constexpr std::size_t kMostPiece = std::size_t{64} << 20;  // bytes in memory; chosen
constexpr std::size_t kValueText = 16;  // bytes of a value and its separators; chosen
constexpr std::size_t kMostLine = std::size_t{1} << 20;  // bytes

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw Error(ErrorCode::kUnsupported, name + ": " + what);
}

// Returns the end of the given number of words, or the end of the text.
const char* behind_words(std::span<const char> text, std::uint64_t words) {
  TextCursor cursor(text);
  for (std::uint64_t k = 0; k < words && !cursor.at_end(); ++k) {
    skip_spaces(cursor);
    take_word(cursor);
  }
  return cursor.at;
}

std::size_t lines_in(std::span<const char> text) {
  TextCursor end(text);
  end.at = end.end;
  return line_number(end) - 1;
}

}  // namespace

class PointStream::Reader {
 public:
  Reader(const std::filesystem::path& path, const ShapeReadOptions& options)
      : window_(path), options_(options) {
    const std::span<const char> begin = window_.at_least(kFirst, {});
    if (begin.empty()) source(begin).fail("the file is empty");
    if (looks_like_ply(begin)) {
      open_ply();
    } else {
      open_xyz();
    }
  }

  bool read(std::size_t n, PointCloud& cloud, const Context& context) {
    cloud = {};
    if (n == 0) return !window_.at_least(1, {}).empty();
    while (cloud.points.empty()) {
      const bool some =
          format == ShapeFormat::kPly ? read_ply(n, cloud, context) : read_xyz(n, cloud, context);
      if (!some && rows_ > 0 && done == 0) source({}).fail("has no point with finite coordinates");
      if (!some) return false;
      rows_ += cloud.points.size();
      drop(cloud);
    }
    settle(cloud);
    done += cloud.points.size();
    return true;
  }

  std::uint64_t dropped() const { return dropped_; }
  double part() const {
    if (window_.size() == 0) return 0;
    return std::min(1.0,
                    static_cast<double>(window_.passed()) / static_cast<double>(window_.size()));
  }

  ShapeFormat format = ShapeFormat::kPly;
  std::string encoding = "ascii";
  std::optional<std::uint64_t> size;
  std::uint64_t done = 0;
  bool has_faces = false;
  bool has_more = false;
  std::vector<std::string> warnings;
  TableColumns table;

 private:
  static constexpr std::size_t kFirst = std::size_t{1} << 16;  // bytes that determine the format

  // Makes the source of a block; the window reports how much of the file is read.
  ShapeSource source(std::span<const char> bytes) const {
    ShapeSource made(bytes, window_.name(), options_, silent_, 0);
    made.rows_before = rows_;
    made.lines_before = lines_;
    return made;
  }

  void drop(PointCloud& cloud) {
    const std::size_t n = drop_not_finite(cloud);
    if (n == 0) return;
    if (dropped_ == 0) {
      dropped_at_ = warnings.size();
      warnings.emplace_back();
    }
    dropped_ += n;
    warnings[dropped_at_] = dropped_warning(dropped_);
  }

  void pass(std::size_t n) {
    if (encoding == "ascii") lines_ += lines_in(window_.bytes().first(n));
    window_.pass(n);
  }

  // ---- PLY ----

  void open_ply() {
    constexpr std::string_view kEnd = "end_header";
    std::size_t asked = kFirst;
    const auto found = [&] {
      const std::span<const char> bytes = window_.at_least(asked, {});
      return std::string_view(bytes.data(), bytes.size()).find(kEnd) != std::string_view::npos;
    };
    while (!found() && asked < kMostHeader && !window_.ended()) asked *= 2;
    window_.at_least(asked + 4, {});  // the end of that line
    const ShapeSource whole = source(window_.bytes());
    header_ = parse_ply_header(whole);
    if (header_.encoding != PlyEncoding::kAscii) {
      encoding = header_.encoding == PlyEncoding::kLittleEndian ? "binary little endian"
                                                                : "binary big endian";
    }
    const PlyElement* vertex = find_element(header_, "vertex");
    if (vertex == nullptr || vertex->count == 0) whole.fail("has no vertices");
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex) break;
      if (element.count > 0) {
        refuse(window_.name(), "element " + in_quotes(element.name) +
                                   " stands before the vertices, which cannot be read a piece at a "
                                   "time then: 'rholm convert' writes them first");
      }
    }
    for (const PlyProperty& property : vertex->properties) {
      if (property.is_list) {
        refuse(window_.name(), "the vertices have a list, " + in_quotes(property.name) +
                                   ", and cannot be read a piece at a time");
      }
      const bool is_text = header_.encoding == PlyEncoding::kAscii;
      row_bytes_ += is_text ? kValueText : size_of(property.type);
    }
    const auto has_rows = [&](const char* name) {
      const PlyElement* element = find_element(header_, name);
      return element != nullptr && element->count > 0;
    };
    has_faces = has_rows("face") || has_rows("tristrips");
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex || element.count == 0) continue;
      has_more = true;
      if (!has_faces) warnings.push_back(passed_over_warning(element));
    }
    const PlyVertices read(whole, *vertex, !has_faces);  // throws without x, y, z
    warnings.insert(warnings.end(), read.warnings.begin(), read.warnings.end());
    size = left_ = vertex->count;
    const std::size_t gone = header_.body + (window_.bytes().size() - whole.bytes.size());
    // Uses division, because a header may claim any number.
    const std::uint64_t rest = window_.size() > gone ? window_.size() - gone : 0;
    has_more = has_more || rest % row_bytes_ != 0 || rest / row_bytes_ != vertex->count;
    header_.elements = {*vertex};
    header_.body = 0;
    pass(gone);
  }

  bool read_ply(std::size_t n, PointCloud& cloud, const Context& context) {
    if (left_ == 0) return false;
    PlyElement& vertex = header_.elements[0];
    n = std::min<std::uint64_t>({n, left_, std::max<std::size_t>(1, kMostPiece / row_bytes_)});
    vertex.count = n;
    std::size_t bytes = n * row_bytes_;  // approximate for text
    if (header_.encoding == PlyEncoding::kAscii) {
      bytes = text_of(n * vertex.properties.size(), context);
    } else {
      bytes = std::min(bytes, window_.at_least(bytes, context).size());
    }
    const ShapeSource piece = source(window_.bytes().first(bytes));
    PlyVertices vertices(piece, vertex, !has_faces);
    if (header_.encoding == PlyEncoding::kAscii) {
      PlyTextBody(piece, header_).read_vertices(vertex, vertices);
    } else {
      if (bytes < n * row_bytes_) {
        piece.fail("truncated: the file ends before the " + std::to_string(*size) + " vertices do");
      }
      PlyBinaryBody(piece, header_).read_vertices(vertex, vertices);
    }
    cloud.points = std::move(vertices.positions);
    cloud.normals = std::move(vertices.normals);
    cloud.attributes = std::move(vertices.attributes);
    left_ -= n;
    pass(bytes);
    return true;
  }

  // Returns the number of bytes up to the end of `words` words in the window.
  std::size_t text_of(std::uint64_t words, const Context& context) {
    for (std::size_t asked = kValueText * words;; asked *= 2) {
      const std::span<const char> bytes = window_.at_least(asked, context);
      const char* const end = behind_words(bytes, words);
      // The last word may continue beyond the window.
      if (end != bytes.data() + bytes.size() || window_.ended()) {
        return static_cast<std::size_t>(end - bytes.data());
      }
      if (asked > 4 * kMostPiece) {
        source(bytes).fail("has " + std::to_string(asked) + " bytes where " +
                           std::to_string(words) + " values should be: these are no points");
      }
    }
  }

  // ---- Lines of numbers ----

  void open_xyz() {
    format = ShapeFormat::kXyz;
    constexpr std::size_t kByteOrderMark = 3;
    window_.at_least(kTellingBytes + kByteOrderMark, {});
    const ShapeSource whole = source(window_.bytes());
    // Recognises other formats as read_shape() does.
    const bool is_other =
        std::ranges::any_of(shape_format_table(), [&](const ShapeFormatLine& line) {
          return line.looks_like != nullptr && line.looks_like(whole.bytes);
        });
    if (is_other || looks_like_plate_table(whole.bytes)) {
      refuse(window_.name(),
             "only PLY and points as lines of numbers can be read a piece at a time");
    }
    look_ = look_at_points(whole, window_.ended());
    const TableHeader& header = look_.header;
    table = look_.plan.told;
    const std::size_t columns = header.syntax.columns;
    if (header.has_count && columns == 3) {
      refuse(window_.name(),
             "after its number of points come their normals or nothing, which "
             "cannot be told a piece at a time");
    }
    if (header.has_count && columns == 4 && look_.plan.roles[0] == ColumnRole::kSkipped) {
      refuse(window_.name(),
             "behind its numbered points may come plates, which cannot be told a piece at a time");
    }
    if (header.has_count && header.count >= 0 && header.count < 1e18) {
      size = static_cast<std::uint64_t>(header.count);
    }
    pass(header.rows_at + (window_.bytes().size() - whole.bytes.size()));
  }

  // Returns the complete lines of at most n rows.
  std::span<const char> lines_of(std::size_t n, const Context& context) {
    std::size_t asked = std::min<std::size_t>(n * 8 * look_.header.syntax.columns, kMostPiece) + 1;
    for (;;) {
      const std::span<const char> bytes = window_.at_least(asked, context);
      const char* end = bytes.data();
      const char* at = end;
      const char* const last = bytes.data() + bytes.size();
      std::size_t lines = 0;
      while (lines < n) {
        at = std::find_if(at, last, is_line_end);
        if (at == last) break;
        const bool may_be_pair = *at == '\r';
        ++at;
        if (may_be_pair && at == last && !window_.ended()) break;
        if (may_be_pair && at != last && *at == '\n') ++at;
        end = at;
        ++lines;
      }
      if (lines > 0 || window_.ended()) {
        if (window_.ended() && lines < n) end = last;
        return bytes.first(static_cast<std::size_t>(end - bytes.data()));
      }
      if (bytes.size() > kMostLine) {
        source(bytes).fail("has a line of more than " + std::to_string(kMostLine) +
                           " bytes: these are no points");
      }
      asked = 2 * bytes.size();
    }
  }

  bool read_xyz(std::size_t n, PointCloud& cloud, const Context& context) {
    while (cloud.points.empty()) {
      const std::span<const char> lines = lines_of(n, context);
      if (lines.empty()) {
        if (size && *size != rows_) {
          source(lines).fail("its first line promises " + std::to_string(*size) + " points, but " +
                             std::to_string(rows_) + " follow");
        }
        return false;
      }
      std::vector<std::string> changed;
      cloud = read_xyz_rows(source(lines), look_, 0, changed);  // comments have no points
      if (done == 0) warnings.insert(warnings.end(), changed.begin(), changed.end());
      pass(lines.size());
    }
    return true;
  }

  // The first block determines the types of attributes.
  void settle(PointCloud& cloud) {
    if (encoding == "ascii") {
      std::vector<std::string> changed;
      settle_attribute_types(cloud.attributes, changed);
      if (done == 0) warnings.insert(warnings.end(), changed.begin(), changed.end());
    }
    if (done == 0) {
      for (const Attribute& attribute : cloud.attributes) types_.push_back(attribute.type);
    }
    for (std::size_t k = 0; k < types_.size(); ++k) {
      Attribute& attribute = cloud.attributes[k];
      if (attribute.type == types_[k]) continue;
      const auto fits = [&](double value) { return is_value_of(types_[k], value); };
      if (!std::all_of(attribute.values.begin(), attribute.values.end(), fits)) {
        source({}).fail("attribute " + in_quotes(attribute.name) + " has values behind point " +
                        std::to_string(done) + " that the type of those before cannot hold");
      }
      attribute.type = types_[k];
    }
  }

  ByteWindow window_;
  ShapeReadOptions options_;
  Context silent_;
  PlyHeader header_;
  std::size_t row_bytes_ = 0;                 // approximate for text
  std::uint64_t left_ = 0;                    // rows of a PLY that are left
  TableLook look_;                            // for lines of numbers
  std::size_t lines_ = 0;                     // lines before the window
  std::size_t rows_ = 0;                      // rows read
  std::size_t dropped_ = 0, dropped_at_ = 0;  // points, and the index of their warning
  std::vector<ScalarType> types_;
};

PointStream::PointStream(const std::filesystem::path& path, const ShapeReadOptions& options)
    : reader_(std::make_unique<Reader>(path, options)) {}
PointStream::~PointStream() = default;

bool PointStream::read(std::size_t n, PointCloud& cloud, const Context& context) {
  return reader_->read(n, cloud, context);
}
std::uint64_t PointStream::read_so_far() const { return reader_->done; }
std::uint64_t PointStream::dropped() const { return reader_->dropped(); }
std::optional<std::uint64_t> PointStream::size() const { return reader_->size; }
double PointStream::part_read() const { return reader_->part(); }
ShapeFormat PointStream::format() const { return reader_->format; }
const std::string& PointStream::encoding() const { return reader_->encoding; }
bool PointStream::has_faces() const { return reader_->has_faces; }
bool PointStream::is_all() const {
  return reader_->format == ShapeFormat::kPly && reader_->encoding != "ascii" && !reader_->has_more;
}
const std::vector<std::string>& PointStream::warnings() const { return reader_->warnings; }
const TableColumns& PointStream::table() const { return reader_->table; }

}  // namespace rholm
