// HDF5 behind handles that close themselves. The only place that includes the library's header;
// used by the model file alone. Layer: io, private.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>

#include "rholm/error.h"

namespace rholm::hdf5 {

// An identifier of the library with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept { swap(other); }
  Handle& operator=(Handle&& other) noexcept {
    Handle(std::move(other)).swap(*this);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  // Closes now and tells whether that succeeded (what is buffered may fail to be written).
  bool close() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }
  // NOLINTNEXTLINE(misc-explicit-constructor): it stands wherever the library takes an identifier
  operator hid_t() const { return id_; }

 private:
  void swap(Handle& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
  }
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

// While it lives, HDF5 is this thread's alone, and does not print its errors: some builds of the
// library are not made for several threads, and keep state of their own between calls.
class QuietErrors {
 public:
  QuietErrors() : alone_(mutex) {
    // At the end of the process HDF5 would close again what could not be closed (a full disk), and
    // crash. Nothing is left to it: handles close themselves.
    H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietErrors() {
    H5Eclear2(H5E_DEFAULT);
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  static inline std::mutex mutex;
  std::lock_guard<std::mutex> alone_;
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace rholm::hdf5
