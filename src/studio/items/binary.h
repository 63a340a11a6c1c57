// Arrays as a page reads them: "RHOLM1\0\0", a length, JSON that says what follows, the arrays.
// Layer: studio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "studio/items/fields.h"
#include "studio/items/message.h"

namespace rholm::studio {

class Binary {
 public:
  using Shape = std::initializer_list<std::size_t>;
  // An array of that shape, row by row.
  void add(const char* name, std::span<const float> values, Shape shape);
  void add(const char* name, std::span<const std::uint32_t> values, Shape shape);
  void add(const char* name, std::span<const std::uint8_t> values, Shape shape);

  Json meta = Json::object();  // what else is to be said

  std::string bytes() const;
  Response response() const { return {.type = "application/octet-stream", .body = bytes()}; }

 private:
  void add_bytes(const char* name, const char* type, std::span<const std::byte> bytes, Shape shape);

  struct Part {
    Json about;
    std::string bytes;
  };
  std::vector<Part> parts_;
};

}  // namespace rholm::studio
