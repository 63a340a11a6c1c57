// Converts C++ values to HDF5 values, for both ways of writing.
#include "io/hdf5/hdf5_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "rholm/error.h"

namespace rholm::hdf5 {

static_assert(std::endian::native == std::endian::little, "values are written as they are");

void check_members(const std::string& name, std::size_t members) {
  constexpr std::size_t kMostMembers = 65535;  // HDF5 counts them in 16 bits
  if (members > kMostMembers) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("{} would have {} datasets, more than {}: write .csv", name, members,
                            kMostMembers));
  }
}

void Writer::write_attribute(Object object, const char* name, const std::string& value) {
  put_text(object, name, value);
}

void Writer::write_fixed_text(Object object, const char* name, const std::string& value) {
  const std::string stored = value.empty() ? std::string(1, '\0') : value;
  put_attribute(object, name, {Kind::kFixedString, stored.size()}, {}, stored.data());
}

void Writer::write_attribute(Object object, const char* name, int value) {
  put_attribute(object, name, {Kind::kInteger, sizeof value, false, true}, {}, &value);
}

void Writer::write_attribute(Object object, const char* name, std::uint32_t value) {
  put_attribute(object, name, {Kind::kInteger, sizeof value, false, false}, {}, &value);
}

void Writer::write_attribute(Object object, const char* name, double value) {
  put_attribute(object, name, {Kind::kFloat, sizeof value, false, true}, {}, &value);
}

void Writer::write_attribute(Object object, const char* name, const Vec3& value) {
  const std::array<double, 3> numbers = {value.x, value.y, value.z};
  write_attribute(object, name, std::span<const double>(numbers));
}

void Writer::write_attribute(Object object, const char* name, std::span<const double> numbers) {
  const std::uint64_t extent = numbers.size();
  put_attribute(object, name, {Kind::kFloat, sizeof(double), false, true}, {&extent, 1},
                numbers.data());
}

void Writer::write_texts(Object group, const char* name, std::span<const std::string> texts) {
  std::size_t length = 1;
  for (const std::string& text : texts) length = std::max(length, text.size());
  std::string bytes(length * texts.size(), '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&bytes[i * length], length);
  const std::uint64_t extent = texts.size();
  put_dataset(group, name, {Kind::kFixedString, length}, {&extent, 1}, bytes.data());
}

}  // namespace rholm::hdf5
