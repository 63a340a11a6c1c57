#include "io/ply/ply_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <unordered_set>

#include "base/plain_text.h"
#include "io/file/number_text.h"

namespace rholm {
namespace {

struct TypeName {
  std::string_view old_name;
  std::string_view new_name;
  ScalarType type;
  std::size_t size;
};
constexpr std::array<TypeName, 8> kTypes = {{{"char", "int8", ScalarType::kInt8, 1},
                                             {"uchar", "uint8", ScalarType::kUint8, 1},
                                             {"short", "int16", ScalarType::kInt16, 2},
                                             {"ushort", "uint16", ScalarType::kUint16, 2},
                                             {"int", "int32", ScalarType::kInt32, 4},
                                             {"uint", "uint32", ScalarType::kUint32, 4},
                                             {"float", "float32", ScalarType::kFloat32, 4},
                                             {"double", "float64", ScalarType::kFloat64, 8}}};

const TypeName& entry(ScalarType type) {
  return *std::find_if(kTypes.begin(), kTypes.end(),
                       [type](const TypeName& t) { return t.type == type; });
}

// Reads the header line by line and each line word by word.
class HeaderReader {
 public:
  explicit HeaderReader(const ShapeSource& source) : source_(source), text_(source.bytes) {}

  PlyHeader read() {
    if (word() != "ply") fail("does not begin with 'ply'");
    next_line();
    for (;;) {
      const std::string_view keyword = word();
      if (keyword == "end_header") break;
      read_line(keyword);
      next_line();
    }
    end_of_header();
    if (!has_format_) fail("the header has no format line");
    return std::move(header_);
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "format") {
      read_format();
    } else if (keyword == "element") {
      read_element();
    } else if (keyword == "property") {
      read_property();
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      fail(in_quotes(keyword) + " is not a line of a PLY header");
    }
  }

  void read_format() {
    const std::string_view format = word();
    if (format == "ascii") {
      header_.encoding = PlyEncoding::kAscii;
    } else if (format == "binary_little_endian") {
      header_.encoding = PlyEncoding::kLittleEndian;
    } else if (format == "binary_big_endian") {
      header_.encoding = PlyEncoding::kBigEndian;
    } else {
      fail("the format is neither ascii nor binary_little_endian nor binary_big_endian");
    }
    has_format_ = true;
  }

  void read_element() {
    PlyElement element;
    element.name = word();
    skip_blanks(text_);
    if (element.name.empty() || !take_integer(text_, element.count) || !at_word_end(text_)) {
      fail("an element needs a name and a count: element vertex 8");
    }
    if (!element_names_.insert(element.name).second) {
      fail("element " + in_quotes(element.name) + " appears twice");
    }
    header_.elements.push_back(std::move(element));
    property_names_.clear();
  }

  void read_property() {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view type = word();
    if (type == "list") {
      property.is_list = true;
      property.count_type = scalar_type(word());
      if (property.count_type == ScalarType::kFloat32 ||
          property.count_type == ScalarType::kFloat64) {
        fail("the length of a list must be of an integer type");
      }
      type = word();
    }
    property.type = scalar_type(type);
    property.name = word();
    if (property.name.empty()) fail("a property without a name");
    if (!property_names_.insert(property.name).second) {
      fail("property " + in_quotes(property.name) + " appears twice in element " +
           in_quotes(header_.elements.back().name));
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType scalar_type(std::string_view name) const {
    for (const TypeName& t : kTypes) {
      if (name == t.old_name || name == t.new_name) return t.type;
    }
    fail(in_quotes(name) +
         " is not a type (char, uchar, short, ushort, int, uint, float, double, or int8 ... "
         "float64)");
  }

  // Returns the next word of this line, or nothing at its end.
  std::string_view word() {
    skip_blanks(text_);
    if (text_.at_end() || is_line_end(*text_.at)) return {};
    return take_word(text_);
  }

  void next_line() {
    skip_to_line_end(text_);
    if (text_.at_end()) fail("the header has no end_header: truncated");
    const bool return_first = *text_.at == '\r';
    ++text_.at;
    const bool pair = return_first && !text_.at_end() && *text_.at == '\n';
    // Old Macintosh files end their lines with \r alone.
    if (lines_read_++ == 0) only_return_ = return_first && !pair;
    if (pair) ++text_.at;
  }

  // The data begin right after the line end. If lines end with \r alone, a \n belongs to the data.
  void end_of_header() {
    skip_blanks(text_);
    if (!text_.at_end() && *text_.at == '\r') {
      ++text_.at;
      if (!only_return_ && !text_.at_end() && *text_.at == '\n') ++text_.at;
    } else if (!text_.at_end() && *text_.at == '\n') {
      ++text_.at;
    } else if (!text_.at_end()) {
      fail("something follows end_header on its line");
    }
    header_.body = static_cast<std::size_t>(text_.at - text_.begin);
  }

  [[noreturn]] void fail(const std::string& what) const { fail_at_line(source_.name, text_, what); }

  const ShapeSource& source_;
  TextCursor text_;
  PlyHeader header_;
  bool has_format_ = false;
  bool only_return_ = false;
  std::size_t lines_read_ = 0;
  std::unordered_set<std::string> element_names_;
  std::unordered_set<std::string> property_names_;  // names in the last element
};

}  // namespace

PlyHeader parse_ply_header(const ShapeSource& source) { return HeaderReader(source).read(); }

const PlyElement* find_element(const PlyHeader& header, const char* name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

std::size_t find_property(const PlyElement& element, const std::string& name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) return i;
  }
  return kNoProperty;
}

std::string passed_over_warning(const PlyElement& element) {
  return "element " + in_quotes(element.name) + " with " + counted(element.count, "row", "rows") +
         " passed over";
}

std::size_t size_of(ScalarType type) { return entry(type).size; }
const char* ply_type_name(ScalarType type) { return entry(type).old_name.data(); }

bool looks_like_ply(std::span<const char> bytes) {
  const std::string_view text(bytes.data(), bytes.size());
  return text.starts_with("ply") && (text.size() == 3 || is_space(text[3]));
}

}  // namespace rholm
