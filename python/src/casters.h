// NumPy arrays and the library's vectors, one as the other. Layer: python.
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

// Arrays as the functions of this module take them: C order, converted by the face in Python.
using Doubles = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Rows = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
// As they are handed out.
using NumpyDoubles = nb::ndarray<nb::numpy, double>;
using NumpyIndices = nb::ndarray<nb::numpy, std::uint32_t>;
using ReadOnlyDoubles = nb::ndarray<nb::numpy, const double>;

// The numbers of an array, good as long as the array, and for code that keeps the interpreter's
// lock: without it another thread might write to them. What runs unlocked takes a copy,
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

// An array that owns what was in the vector; not copied.
template <class Scalar, class T>
nb::ndarray<nb::numpy, Scalar> array_of(std::vector<T>&& values,
                                        std::initializer_list<std::size_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  auto* data = reinterpret_cast<std::remove_const_t<Scalar>*>(owned->data());
  nb::capsule owner(owned.get(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  (void)owned.release();  // it is the capsule's now
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
// The same of what users may not write to, as it would change nothing.
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

// An array over memory of `owner`, which lives as long.
template <class Scalar>
nb::ndarray<nb::numpy, Scalar> array_within(nb::handle owner, const void* data,
                                            std::initializer_list<std::size_t> shape) {
  // Nothing of the library is written through it unless its owner says that it may be.
  return {const_cast<void*>(data), shape, owner};
}

}  // namespace rholm::python

namespace nanobind::detail {

// A point: any three numbers in a row, and an array of three for Python.
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
