// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// NumPy arrays in and out. What goes out is never copied: the array owns the vector that the
/// library made. What comes in is read once, straight from its buffer, into the mesh that the
/// library works on.

namespace vantage::python {

namespace py = pybind11;

/// Shape of an array.
using Shape = std::vector<py::ssize_t>;

static_assert(sizeof(Vec3) == 3 * sizeof(double));
static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));

/// `n` as NumPy counts.
inline py::ssize_t extent(std::size_t n) {
  return static_cast<py::ssize_t>(n);
}

/// An array over the memory of `values`, which it owns. \param shape of |values| elements of type
/// Scalar, which `values` may hold in groups: points, triangles.
template <class Scalar, class Value>
py::array_t<Scalar> owned_array(std::vector<Value>&& values, const Shape& shape) {
  auto owner = std::make_unique<std::vector<Value>>(std::move(values));
  const auto* data = reinterpret_cast<const Scalar*>(owner->data());
  const py::capsule base(owner.get(), [](void* p) { delete static_cast<std::vector<Value>*>(p); });
  owner.release();
  return py::array_t<Scalar>(shape, data, base);
}

/// One number a row.
template <class Scalar>
py::array_t<Scalar> owned_array(std::vector<Scalar>&& values) {
  const Shape shape{extent(values.size())};
  return owned_array<Scalar>(std::move(values), shape);
}

/// k numbers a row.
template <class Scalar, std::size_t k>
py::array_t<Scalar> owned_array(std::vector<std::array<Scalar, k>>&& rows) {
  const Shape shape{extent(rows.size()), extent(k)};
  return owned_array<Scalar>(std::move(rows), shape);
}

/// n × 3 coordinates.
inline py::array_t<double> owned_array(std::vector<Vec3>&& points) {
  const Shape shape{extent(points.size()), 3};
  return owned_array<double>(std::move(points), shape);
}

/// Zeros and ones as booleans.
py::array owned_flags(std::vector<std::uint8_t>&& flags, const Shape& shape);

/// A read-only array over memory that `owner` keeps alive.
template <class Scalar, class Owner>
py::array_t<Scalar> shared_array(const void* data, const Shape& shape, const Owner& owner) {
  auto kept = std::make_unique<Owner>(owner);
  const py::capsule base(kept.get(), [](void* p) { delete static_cast<Owner*>(p); });
  kept.release();
  py::array_t<Scalar> array(shape, static_cast<const Scalar*>(data), base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Three numbers as an array of their own.
py::array_t<double> array_of(const Vec3& v);

/// The mesh that V and F describe. \param V n × 3 real numbers. \param F m × 3 integers, or None: a
/// point cloud, as [] is. \throw py::type_error for what is no array, and other types of numbers.
/// \throw InvalidInput for other shapes, no points, coordinates that are not finite, indices that
/// name no vertex.
TriMesh mesh_of(const py::object& V, const py::object& F);

/// Points of a k × 3 array, or of one of three numbers. \param name shown in messages.
std::vector<Vec3> points_of(const py::object& value, const char* name);

/// Whether it is one row of numbers rather than a table of them.
bool is_single_point(const py::object& value);

/// Three finite numbers. \param name shown in messages.
Vec3 vector_of(const py::object& value, const char* name);

/// One number a row, of any kind that NumPy makes one of; those that are not finite too.
std::vector<double> numbers_of(const py::object& value, const char* name);

/// Colours of an n × 3 array of bytes.
std::vector<std::array<std::uint8_t, 3>> colours_of(const py::object& value);

}  // namespace vantage::python
