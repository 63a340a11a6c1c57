// Numbers and texts as the bytes of a message. Layer: cluster, private.
//
// Between ranks of one run of one program: little endian, not checked against damage, but never
// read beyond the end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rholm {

class Packer {
 public:
  Packer& number(std::uint64_t value);
  Packer& real(double value);
  Packer& text(std::string_view value);
  Packer& texts(const std::vector<std::string>& values);
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads what a Packer wrote, in its order; throws InvalidInput where it ends too early.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}
  std::uint64_t number();
  double real();
  std::string_view text();
  std::vector<std::string> texts();
  std::string_view rest() const { return left_; }

 private:
  std::string_view take(std::uint64_t size);
  std::string_view left_;
};

}  // namespace rholm
