#include "report/view/named_arrays.h"

#include <bit>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rholm {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are sent as they lie");

constexpr std::size_t kAligned = 8;  // pages may view doubles at these addresses
constexpr std::size_t kHead = 12;    // magic and length

std::size_t padded(std::size_t n) { return (n + kAligned - 1) / kAligned * kAligned; }

}  // namespace

void NamedArrays::add_bytes(const char* name, const char* type, std::span<const std::byte> bytes,
                            Shape shape) {
  parts_.push_back({fmt::format(R"({{"name":"{}","type":"{}","shape":[{}],"offset":)", name, type,
                                fmt::join(shape, ",")),
                    {reinterpret_cast<const char*>(bytes.data()), bytes.size()}});
}

void NamedArrays::add(const char* name, std::span<const double> values, Shape shape) {
  add_bytes(name, "f64", std::as_bytes(values), shape);
}

void NamedArrays::add(const char* name, std::span<const float> values, Shape shape) {
  add_bytes(name, "f32", std::as_bytes(values), shape);
}

void NamedArrays::add(const char* name, std::span<const std::uint32_t> values, Shape shape) {
  add_bytes(name, "u32", std::as_bytes(values), shape);
}

void NamedArrays::add(const char* name, std::span<const std::uint8_t> values, Shape shape) {
  add_bytes(name, "u8", std::as_bytes(values), shape);
}

std::string NamedArrays::bytes(std::string_view meta) const {
  // Offsets in the JSON depend on its length, and its length on their
  // digits. Lengths are tried until they agree; they only grow.
  std::string text;
  std::size_t length = padded(kHead) - kHead;
  for (std::size_t tried = 0; tried != length;) {
    tried = length;
    text = R"({"arrays":[)";
    std::size_t offset = kHead + tried;
    for (const Part& part : parts_) {
      text += fmt::format("{}{}{}}}", &part == parts_.data() ? "" : ",", part.about, offset);
      offset += padded(part.bytes.size());
    }
    text += fmt::format(R"(],"meta":{}}})", meta);
    length = std::max(tried, padded(kHead + text.size()) - kHead);
  }
  text.resize(length, ' ');
  std::string all("RHOLM1\0\0", 8);
  for (std::size_t k = 0; k < 4; ++k) all += static_cast<char>(length >> (8 * k) & 0xFF);
  all += text;
  for (const Part& part : parts_) {
    all += part.bytes;
    all.append(padded(part.bytes.size()) - part.bytes.size(), '\0');
  }
  return all;
}

std::vector<float> floats_of(std::span<const Vec3> points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) {
    for (const double x : {p.x, p.y, p.z}) values.push_back(static_cast<float>(x));
  }
  return values;
}

std::vector<std::uint32_t> indices_of(std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> values;
  values.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) values.insert(values.end(), t.begin(), t.end());
  return values;
}

}  // namespace rholm
