#include <algorithm>

#include "base/plain_text.h"
#include "io/ply/ply_body.h"

namespace rholm {

PlyTextBody::PlyTextBody(const ShapeSource& source, const PlyHeader& header)
    : source_(source), text_(source.bytes) {
  text_.at += header.body;
}

// Reports a word that is not `wanted`, or the end of the text.
void PlyTextBody::fail_value(const PlyElement& element, const char* wanted) const {
  if (text_.at_end()) {
    source_.fail("truncated: the file ends before the " + std::to_string(element.count) +
                 " rows of element " + in_quotes(element.name) + " do");
  }
  fail_at_line(source_.name, text_,
               quoted_word(text_) + " in element " + in_quotes(element.name) + " is not " + wanted,
               source_.lines_before);
}

// A value takes at least a digit and a space, the last value only the digit.
void PlyTextBody::require_rows(const PlyElement& element) const {
  const std::size_t values = static_cast<std::size_t>(text_.end - text_.at) / 2 + 1;
  if (element.properties.empty() || element.count <= values / element.properties.size()) return;
  source_.fail("truncated: the " + std::to_string(source_.bytes.size()) +
               " bytes of the file cannot hold the " + std::to_string(element.count) +
               " rows of element " + in_quotes(element.name));
}

double PlyTextBody::take_value(const PlyElement& element) {
  skip_spaces(text_);
  const TextCursor before = text_;
  double value = 0;
  if (!take_number(text_, value) || !at_word_end(text_)) {
    text_ = before;
    fail_value(element, "a number");
  }
  return value;
}

std::int64_t PlyTextBody::take_index(const PlyElement& element) {
  skip_spaces(text_);
  const TextCursor before = text_;
  std::int64_t value = 0;
  if (!take_integer(text_, value) || !at_word_end(text_)) {
    text_ = before;
    fail_value(element, "an integer");
  }
  return value;
}

std::uint64_t PlyTextBody::take_count(const PlyElement& element) {
  const std::int64_t count = take_index(element);
  if (count < 0) {
    fail_at_line(source_.name, text_, "a list has the length " + std::to_string(count));
  }
  return static_cast<std::uint64_t>(count);
}

// Skips values as words, because their meaning does not matter. The first missing word shows the
// end of the text, however long a list claims to be.
void PlyTextBody::skip_properties(const PlyElement& element, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const std::uint64_t n = element.properties[i].is_list ? take_count(element) : 1;
    for (std::uint64_t k = 0; k < n; ++k) {
      skip_spaces(text_);
      if (take_word(text_).empty()) fail_value(element, "a value");
    }
  }
}

void PlyTextBody::skip(const PlyElement& element) {
  if (element.properties.empty()) return;
  require_rows(element);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    skip_properties(element, 0, element.properties.size());
    source_.progress(text_.at);
  }
}

void PlyTextBody::read_vertices(const PlyElement& element, PlyVertices& vertices) {
  require_rows(element);
  vertices.reserve(element.count);
  const std::size_t n_properties = element.properties.size();
  for (std::uint64_t row = 0; row < element.count;) {
    const std::size_t n = std::min<std::uint64_t>(vertices.block_rows(), element.count - row);
    for (std::size_t r = 0; r < n; ++r) {
      for (std::size_t i = 0; i < n_properties; ++i) {
        const PlyVertices::Slot& slot = vertices.slots()[i];
        if (slot.first != nullptr) {
          slot.first[r * slot.stride] = take_value(element);
        } else {
          skip_properties(element, i, i + 1);
        }
      }
    }
    row += n;
    vertices.append_block(n);
    source_.progress(text_.at);
  }
}

void PlyTextBody::read_faces(const PlyElement& element, std::size_t list, PlyFaces& faces) {
  require_rows(element);
  // A triangle takes at least eight bytes: "3 0 1 2" and the end of its line.
  faces.list.reserve(
      std::min<std::uint64_t>(element.count, static_cast<std::size_t>(text_.end - text_.at) / 8));
  std::vector<std::uint32_t> corners;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    skip_properties(element, 0, list);
    const std::uint64_t n = take_count(element);
    corners.clear();
    for (std::uint64_t k = 0; k < n; ++k) {
      const std::int64_t index = take_index(element);
      if (static_cast<std::uint64_t>(index) >= faces.n_vertices()) faces.fail_index(row, index);
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    faces.list.add(corners);
    skip_properties(element, list + 1, element.properties.size());
    if (row % 1024 == 0) source_.progress(text_.at);
  }
}

void PlyTextBody::read_strips(const PlyElement& element, std::size_t list, PlyFaces& faces) {
  require_rows(element);
  for (std::uint64_t row = 0; row < element.count; ++row) {
    skip_properties(element, 0, list);
    const std::uint64_t n = take_count(element);
    for (std::uint64_t k = 0; k < n; ++k) faces.add_to_strip(take_index(element));
    faces.end_strip();
    skip_properties(element, list + 1, element.properties.size());
    source_.progress(text_.at);
  }
}

std::size_t PlyTextBody::left() {
  skip_spaces(text_);
  return static_cast<std::size_t>(text_.end - text_.at);
}

}  // namespace rholm
