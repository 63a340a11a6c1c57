#include "studio/items/binary.h"

#include <bit>
#include <cstring>

namespace rholm::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are sent as they lie");

constexpr std::size_t kAligned =
    8;                             // every array begins at a multiple of this: doubles may be seen
constexpr std::size_t kHead = 12;  // magic and length

std::size_t padded(std::size_t n) { return (n + kAligned - 1) / kAligned * kAligned; }

}  // namespace

void Binary::add_bytes(const char* name, const char* type, std::span<const std::byte> bytes,
                       Shape shape) {
  Part part;
  part.about = {{"name", name}, {"type", type}, {"shape", std::vector<std::size_t>(shape)}};
  part.bytes.resize(bytes.size());
  if (!bytes.empty()) std::memcpy(part.bytes.data(), bytes.data(), bytes.size());
  parts_.push_back(std::move(part));
}

void Binary::add(const char* name, std::span<const float> values, Shape shape) {
  add_bytes(name, "f32", std::as_bytes(values), shape);
}

void Binary::add(const char* name, std::span<const std::uint32_t> values, Shape shape) {
  add_bytes(name, "u32", std::as_bytes(values), shape);
}

void Binary::add(const char* name, std::span<const std::uint8_t> values, Shape shape) {
  add_bytes(name, "u8", std::as_bytes(values), shape);
}

std::string Binary::bytes() const {
  // Offsets have as many digits as they have, and the JSON is as long as that makes it: lengths are
  // tried until they agree, and only grow.
  std::string text;
  std::size_t length = padded(kHead) - kHead;
  for (std::size_t tried = 0; tried != length;) {
    tried = length;
    Json about = {{"arrays", Json::array()}, {"meta", meta}};
    std::size_t offset = kHead + tried;
    for (const Part& part : parts_) {
      Json array = part.about;
      array["offset"] = offset;
      about["arrays"].push_back(std::move(array));
      offset += padded(part.bytes.size());
    }
    text = text_of(about);
    length = std::max(tried, padded(kHead + text.size()) - kHead);
  }
  text.resize(length, ' ');
  std::string all("RHOLM1\0\0", 8);
  const auto n = static_cast<std::uint32_t>(length);
  all.append(reinterpret_cast<const char*>(&n), sizeof n);
  all += text;
  for (const Part& part : parts_) {
    all += part.bytes;
    all.append(padded(part.bytes.size()) - part.bytes.size(), '\0');
  }
  return all;
}

}  // namespace rholm::studio
