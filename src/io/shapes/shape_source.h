// The input of all readers of shapes, and the readers. Layer: io.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

#include "io/file/number_text.h"
#include "rholm/shape_io.h"

namespace rholm {

class ShapeSource {
 public:
  // `progress_from` is the part of the work that is done before parsing.
  ShapeSource(std::span<const char> file_bytes, std::string file_name,
              const ShapeReadOptions& options, const Context& context, double progress_from);

  std::span<const char> bytes;  // without byte order mark
  std::string name;             // for messages
  bool attributes;              // true if they are wanted
  std::string columns;          // see ShapeReadOptions
  // Rows and lines before `bytes`, if they are a block of a file.
  std::size_t rows_before = 0, lines_before = 0;

  // To be called regularly with the position reached: reports progress about every percent, or
  // throws Cancelled.
  void progress(const char* at) const {
    if (at >= next_report_) report(at);
  }
  // Throws InvalidInput "name: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void report(const char* at) const;
  const Context& context_;
  double progress_from_;
  mutable const char* next_report_;
};

ShapeFile read_ply(const ShapeSource& source);
ShapeFile read_obj(const ShapeSource& source);
ShapeFile read_off(const ShapeSource& source);
ShapeFile read_stl(const ShapeSource& source);
ShapeFile read_xyz(const ShapeSource& source);

// Return true if the content of the bytes has the format.
bool looks_like_ply(std::span<const char> bytes);
bool looks_like_obj(std::span<const char> bytes);
bool looks_like_off(std::span<const char> bytes);
bool looks_like_stl(std::span<const char> bytes);
// Return true for bytes of unknown format that may be binary STL with data after the facets, or a
// table of points or of plates.
bool may_be_stl(std::span<const char> bytes);
bool may_be_xyz(std::span<const char> bytes);

// Throws InvalidInput "vertex 7 has a coordinate that is not a finite number" if a vector is not
// finite; `first_number` is the number of the first vector.
void check_finite(const ShapeSource& source, std::span<const Vec3> vectors,
                  std::size_t first_number, const char* owner, const char* what);

// Returns three float64 attributes with the components of `vectors`; none if there are no vectors.
std::vector<Attribute> vector_attributes(std::span<const Vec3> vectors,
                                         const std::array<const char*, 3>& names);

// Makes types of attributes read from text correct: rounds float32 values to floats. A type that
// cannot hold the values becomes float64, with a warning.
void settle_attribute_types(std::vector<Attribute>& attributes, std::vector<std::string>& warnings);
// Returns true if the type holds the value exactly; both floating types hold NaN and infinities.
bool is_value_of(ScalarType type, double value);
// Returns the warning for an attribute with n values that are not finite.
std::string not_finite_warning(const std::string& attribute, std::size_t n);

// Returns "1 face", "3 faces".
std::string counted(std::size_t n, const char* singular, const char* plural);

}  // namespace rholm
