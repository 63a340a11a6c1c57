// Memory for inner loops. Layer: base.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace rholm {

// Aligned to a cache line; blocks of several MiB are placed on huge pages where the system offers
// them, for a first touch of a small page costs far more than its part of a large one. Throws
// std::bad_alloc. Not set to anything, but see poison.h.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* data) noexcept;

// The same, all bits zero: large blocks come so from the system, and are not touched here.
// `mapped` is what free_zeroed() has to know.
void* allocate_zeroed(std::size_t bytes, std::size_t& mapped);
void free_zeroed(void* data, std::size_t mapped) noexcept;

// n elements that are not set to anything, or to zeros.
template <typename T>
class AlignedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t n)
      : data_(static_cast<T*>(allocate_aligned(n * sizeof(T)))), size_(n) {}
  static AlignedArray zeros(std::size_t n) {
    AlignedArray array;
    std::size_t mapped = 0;
    T* const data = static_cast<T*>(allocate_zeroed(n * sizeof(T), mapped));
    array.data_ = {data, Free{mapped}};
    array.size_ = n;
    return array;
  }

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  struct Free {
    std::size_t mapped = 0;
    void operator()(T* data) const noexcept { free_zeroed(data, mapped); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace rholm
