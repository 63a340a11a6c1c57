// What every reader of shapes is given, and the readers. Layer: io.
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
  // `progress_from` is the share of the work that is done before parsing.
  ShapeSource(std::span<const char> file_bytes, std::string file_name,
              const ShapeReadOptions& options, const Context& context, double progress_from);

  std::span<const char> bytes;  // without byte order mark
  std::string name;             // for messages
  bool attributes;              // whether they are wanted
  std::string columns;          // as in ShapeReadOptions
  // Of a piece of a file: what comes before it.
  std::size_t rows_before = 0, lines_before = 0;

  // To be called now and then with the place reached: reports progress about every percent, or
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

// Whether the bytes are of that format, by their content alone.
bool looks_like_ply(std::span<const char> bytes);
bool looks_like_obj(std::span<const char> bytes);
bool looks_like_off(std::span<const char> bytes);
bool looks_like_stl(std::span<const char> bytes);
// Whether bytes that nothing else is known of are binary STL with something behind the facets, or
// a table of points or of plates.
bool may_be_stl(std::span<const char> bytes);
bool may_be_xyz(std::span<const char> bytes);

// Throws InvalidInput "vertex 7 has a coordinate that is not a finite number" if one of the first n
// vectors has; `first_number` is the number of the first.
void check_finite(const ShapeSource& source, std::span<const Vec3> vectors,
                  std::size_t first_number, const char* owner, const char* what);

// Three attributes of type float64 with the components of `vectors`; none for no vectors.
std::vector<Attribute> vector_attributes(std::span<const Vec3> vectors,
                                         const std::array<const char*, 3>& names);

// Makes the types of attributes read from text true: float32 values are rounded to floats, a type
// that cannot hold the values becomes float64, with a warning.
void settle_attribute_types(std::vector<Attribute>& attributes, std::vector<std::string>& warnings);
// Whether a value is exactly one of the type; NaN and infinities are for both floating types.
bool is_value_of(ScalarType type, double value);
// Of an attribute that has n such values.
std::string not_finite_warning(const std::string& attribute, std::size_t n);

// "1 face", "3 faces".
std::string counted(std::size_t n, const char* singular, const char* plural);

}  // namespace rholm
