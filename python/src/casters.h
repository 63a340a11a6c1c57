// Converts between NumPy arrays and the library's vectors. Layer: python.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "rholm/vec3.h"

namespace rholm::python {

namespace nb = nanobind;

// Arrays that functions of this module take: C order, converted by the Python code.
using Doubles = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Rows = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
// Arrays that functions return.
using NumpyDoubles = nb::ndarray<nb::numpy, double>;
using NumpyIndices = nb::ndarray<nb::numpy, std::uint32_t>;
using ReadOnlyDoubles = nb::ndarray<nb::numpy, const double>;

// Returns the numbers of an array; valid as long as the array. Only for code that holds the
// interpreter's lock, because another thread could write to the array. Code without the lock uses
// vector_of().
inline std::span<const double> span_of(const Doubles& values) {
  return {values.data(), values.size()};
}
inline std::span<const Vec3> span_of(const Rows& rows) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return {reinterpret_cast<const Vec3*>(rows.data()), rows.shape(0)};
}
inline std::vector<double> vector_of(const Doubles& values) {
  return {values.data(), values.data() + values.size()};
}
inline std::vector<Vec3> vector_of(const Rows& rows) {
  const std::span<const Vec3> points = span_of(rows);
  return {points.begin(), points.end()};
}

// Returns an array that takes over the vector's memory without a copy.
template <class Scalar, class T>
nb::ndarray<nb::numpy, Scalar> array_of(std::vector<T>&& values,
                                        std::initializer_list<std::size_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  auto* data = reinterpret_cast<std::remove_const_t<Scalar>*>(owned->data());
  nb::capsule owner(owned.get(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  (void)owned.release();  // the capsule owns it now
  return {data, shape, owner};
}
inline NumpyDoubles array_of(std::vector<double>&& values) {
  const std::size_t n = values.size();
  return array_of<double>(std::move(values), {n});
}
inline NumpyDoubles array_of(std::vector<Vec3>&& rows) {
  const std::size_t n = rows.size();
  return array_of<double>(std::move(rows), {n, 3});
}
inline NumpyIndices array_of(std::vector<std::uint32_t>&& values) {
  const std::size_t n = values.size();
  return array_of<std::uint32_t>(std::move(values), {n});
}
inline NumpyDoubles array_of(const std::vector<double>& values) {
  return array_of(std::vector<double>(values));
}
// Returns a read-only array: writing to it would change no object.
inline ReadOnlyDoubles read_only(std::vector<double>&& values) {
  const std::size_t n = values.size();
  return array_of<const double>(std::move(values), {n});
}
inline ReadOnlyDoubles read_only(std::vector<Vec3>&& rows) {
  const std::size_t n = rows.size();
  return array_of<const double>(std::move(rows), {n, 3});
}

inline ReadOnlyDoubles read_only(const Vec3& row) {
  return read_only(std::vector<double>{row.x, row.y, row.z});
}

// Returns an array over memory of `owner`, which is kept alive by the array.
template <class Scalar>
nb::ndarray<nb::numpy, Scalar> array_within(nb::handle owner, const void* data,
                                            std::initializer_list<std::size_t> shape) {
  // The array is read-only if Scalar is const, although its constructor takes a plain pointer.
  return {const_cast<void*>(data), shape, owner};
}

}  // namespace rholm::python

namespace nanobind::detail {

// A point: taken from any sequence of three numbers, returned as an array of three.
template <>
struct type_caster<rholm::Vec3> {
  NB_TYPE_CASTER(rholm::Vec3,
                 io_name("collections.abc.Sequence[float] | numpy.typing.NDArray[numpy.float64]",
                         "numpy.typing.NDArray[numpy.float64]"))

  bool from_python(handle source, std::uint8_t flags, cleanup_list* cleanup) noexcept {
    make_caster<std::array<double, 3>> numbers;
    if (!numbers.from_python(source, flags, cleanup)) return false;
    const std::array<double, 3>& xyz = numbers.value;
    value = {xyz[0], xyz[1], xyz[2]};
    return true;
  }

  static handle from_cpp(const rholm::Vec3& x, rv_policy, cleanup_list* cleanup) noexcept {
    ndarray<numpy, const double, shape<3>> row(const_cast<rholm::Vec3*>(&x), {3}, handle());
    return make_caster<ndarray<numpy, const double, shape<3>>>::from_cpp(row, rv_policy::copy,
                                                                         cleanup);
  }
};

}  // namespace nanobind::detail
