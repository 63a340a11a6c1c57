// Memory for inner loops. Layer: base.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace rholm {

// Returns memory aligned to a cache line. Blocks of 4 MiB and more are placed on huge pages where
// the system offers them. The first touch of small pages costs far more per byte. Throws
// std::bad_alloc. The memory is not initialised, but see poison.h.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* data) noexcept;

// Returns memory whose bits are all zero. Large blocks come zeroed from the system and are not
// touched here. free_zeroed() needs the value of `mapped`.
void* allocate_zeroed(std::size_t bytes, std::size_t& mapped);
void free_zeroed(void* data, std::size_t mapped) noexcept;

// Array of n elements, which are not initialised or, if made by zeros(), are zero.
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
