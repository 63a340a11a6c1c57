#include "cluster/pack.h"

#include <bit>

#include "base/refuse.h"
#include "model/batch/row_bytes.h"

namespace rholm {

Packer& Packer::number(std::uint64_t value) {
  put_u64(bytes_, value);
  return *this;
}

Packer& Packer::real(double value) { return number(std::bit_cast<std::uint64_t>(value)); }

Packer& Packer::text(std::string_view value) {
  number(value.size());
  bytes_ += value;
  return *this;
}

Packer& Packer::texts(const std::vector<std::string>& values) {
  number(values.size());
  for (const std::string& value : values) text(value);
  return *this;
}

std::string_view Unpacker::take(std::uint64_t size) {
  if (size > left_.size()) refuse("a message between ranks ends too early");
  const std::string_view taken = left_.substr(0, size);
  left_.remove_prefix(size);
  return taken;
}

std::uint64_t Unpacker::number() { return get_u64(take(8)); }

double Unpacker::real() { return std::bit_cast<double>(number()); }

std::string_view Unpacker::text() { return take(number()); }

std::vector<std::string> Unpacker::texts() {
  std::vector<std::string> values;
  for (std::uint64_t n = number(); n > 0; --n) values.emplace_back(text());
  return values;
}

}  // namespace rholm
