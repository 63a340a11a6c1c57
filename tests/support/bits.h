// Collects the bits of results one after the other, so that they can be compared.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/mesh.h"

namespace rholm::test {

class Bits {
 public:
  Bits& add(double value) { return add(std::span(&value, 1)); }
  Bits& add(const std::vector<double>& values) { return add(std::span(values)); }
  Bits& add(const std::vector<Vec3>& values) { return add(std::span(values)); }
  Bits& add(const std::vector<Triangle>& values) { return add(std::span(values)); }
  Bits& add(const Coefficients& f) { return add(f.values()); }
  Bits& add(const Mesh& mesh) {
    add(mesh.vertices).add(mesh.faces);
    for (const Attribute& attribute : mesh.attributes) add(attribute.values);
    return *this;
  }

  // T has no padding bytes.
  template <typename T>
  Bits& add(std::span<T> values) {
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + values.size_bytes());
    if (!values.empty()) std::memcpy(&bytes_[begin], values.data(), values.size_bytes());
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace rholm::test
