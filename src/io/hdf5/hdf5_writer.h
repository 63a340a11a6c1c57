// Writes groups, attributes and datasets of a new HDF5 file: by the HDF5 library
// (hdf5_library.cpp), or without it (hdf5_plain.cpp). Layer: io, private.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "io/hdf5/hdf5_values.h"
#include "rholm/vec3.h"

namespace rholm::hdf5 {

// Largest number of attributes of one object. All are in its header (chosen: ample).
inline constexpr unsigned kMaxAttributes = 64;

class Writer {
 public:
  using Object = std::size_t;  // a group or a dataset
  static constexpr Object kRoot = 0;

  // Creates a file at `path` that no other process uses; `name` is for messages. `members` is the
  // number of members of the root if it is large. Throws Io, and Unsupported for more than 65535.
  Writer(std::string name, const std::string& path, std::size_t members = 0);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  Object create_group(Object parent, const char* name);

  // Writes a string into the file's heap, which takes 4 KiB for any length.
  void write_attribute(Object object, const char* name, const std::string& value);
  // Writes a string with its own length.
  void write_fixed_text(Object object, const char* name, const std::string& value);
  void write_attribute(Object object, const char* name, int value);
  void write_attribute(Object object, const char* name, std::uint32_t value);
  void write_attribute(Object object, const char* name, double value);
  void write_attribute(Object object, const char* name, const Vec3& value);
  void write_attribute(Object object, const char* name, std::span<const double> numbers);

  // Writes contiguous numbers; their count is the product of the extents.
  template <typename T>
  Object write_dataset(Object group, const char* name, std::span<const std::uint64_t> extents,
                       const T* values) {
    static_assert(std::is_arithmetic_v<T>);
    const Type type = {std::is_floating_point_v<T> ? Kind::kFloat : Kind::kInteger, sizeof(T),
                       false, std::is_signed_v<T>};
    return put_dataset(group, name, type, extents, values);
  }
  // Writes texts of one length, the length of the longest; shorter texts are filled with zeros.
  void write_texts(Object group, const char* name, std::span<const std::string> texts);

  // Writes the remaining data. Without this call the file is incomplete.
  void close();

 private:
  // Writes values as they are in memory. Empty `extents` mean one value.
  void put_attribute(Object object, const char* name, const Type& type,
                     std::span<const std::uint64_t> extents, const void* values);
  void put_text(Object object, const char* name, const std::string& value);
  Object put_dataset(Object group, const char* name, const Type& type,
                     std::span<const std::uint64_t> extents, const void* values);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Throws Unsupported if a group cannot have this number of members.
void check_members(const std::string& name, std::size_t members);

}  // namespace rholm::hdf5
