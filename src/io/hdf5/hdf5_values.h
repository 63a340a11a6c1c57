// Types, attributes, datasets and their values in an HDF5 file. Layer: io, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5/hdf5_objects.h"

namespace rholm::hdf5 {

enum class Kind { kInteger, kFloat, kFixedString, kVariableString };
struct Type {
  Kind kind = Kind::kInteger;
  std::size_t size = 0;  // bytes of one value
  bool big_endian = false;
  bool is_signed = false;
};
// The array of an attribute or dataset, as stored in the file.
struct Array {
  std::string path;  // for messages
  Type type = {};
  std::vector<std::uint64_t> extents = {};  // empty for a scalar
  std::string_view data = {};               // product of the extents times type.size bytes
};
std::optional<Array> find_attribute(const File& file, const Object& object, std::string_view name);
Array read_dataset(const File& file, const Object& dataset);

// Return all values of the array. Throw InvalidInput for an array of another kind.
std::string to_text(const File& file, const Array& array);  // for exactly one string
// Returns strings of one length, without the zeros at their ends.
std::vector<std::string> to_texts(const File& file, const Array& array);
std::vector<double> to_doubles(const File& file, const Array& array);
std::vector<std::int64_t> to_integers(const File& file, const Array& array);
std::int64_t to_integer(const File& file, const Array& array);  // for exactly one integer

}  // namespace rholm::hdf5
