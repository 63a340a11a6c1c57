// Memory for inner loops. Layer: base.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace rholm {

// Aligned to a cache line; blocks of several MiB are placed on huge pages where the system offers
// them, for a first touch of a small page costs far more than its part of a large one. Throws
// std::bad_alloc.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* data) noexcept;

// n elements that are not set to anything.
template <typename T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t n)
      : data_(static_cast<T*>(allocate_aligned(n * sizeof(T)))), size_(n) {}

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  struct Free {
    void operator()(T* data) const noexcept { free_aligned(data); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace rholm
