// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <cmath>
#include <limits>
#include <string>

#include "vantage/core/error.h"

namespace vantage::python {
namespace {

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

py::array array_from(const py::object& value, const char* name) {
  py::array array = py::array::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + " must be an array of numbers");
  }
  return array;
}

void need_rows_of_three(const py::array& array, const char* name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw InvalidInput(std::string(name) + " must have the shape (n, 3), not " + shape_text(array));
  }
}

/// `array` as numbers of the processor's own byte order and alignment; itself if it is already.
py::array native(const py::array& array) {
  if (array.dtype().attr("isnative").cast<bool>() &&
      array.attr("flags").attr("aligned").cast<bool>()) {
    return array;
  }
  return array.attr("astype")(array.dtype().attr("newbyteorder")("="));
}

/// Calls take(i, numbers) for each row of three, wherever its numbers lie in memory.
template <class Scalar, class Take>
void for_each_row(const py::array& array, const Take& take) {
  const auto rows = array.unchecked<Scalar, 2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    take(i, std::array<Scalar, 3>{rows(i, 0), rows(i, 1), rows(i, 2)});
  }
}

template <class Scalar>
std::vector<Vec3> read_points(const py::array& array, const char* name) {
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(array.shape(0)));
  for_each_row<Scalar>(array, [&](py::ssize_t i, const std::array<Scalar, 3>& row) {
    const Vec3 point(static_cast<double>(row[0]), static_cast<double>(row[1]),
                     static_cast<double>(row[2]));
    if (!point.allFinite()) {
      throw InvalidInput(std::string(name) + " holds a value that is not finite in row " +
                         std::to_string(i));
    }
    points.push_back(point);
  });
  return points;
}

template <class Index>
std::vector<Triangle> read_triangles(const py::array& array, std::size_t vertex_count) {
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(array.shape(0)));
  for_each_row<Index>(array, [&](py::ssize_t i, const std::array<Index, 3>& row) {
    Triangle triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (row[c] < 0 || static_cast<std::uint64_t>(row[c]) >= vertex_count) {
        throw InvalidInput("F names vertex " + std::to_string(row[c]) + " in row " +
                           std::to_string(i) + ", but there are " + std::to_string(vertex_count) +
                           " vertices, counted from 0");
      }
      triangle[c] = static_cast<std::uint32_t>(row[c]);
    }
    triangles.push_back(triangle);
  });
  return triangles;
}

/// Integers of any width; what is narrower than 32 bits is widened first.
std::vector<Triangle> triangles_of(const py::array& array, std::size_t vertex_count) {
  const bool is_signed = array.dtype().kind() == 'i';
  const bool is_wide = array.itemsize() == 8;
  if (array.itemsize() < 4) {
    return triangles_of(array.attr("astype")("int32"), vertex_count);
  }
  if (is_signed) {
    return is_wide ? read_triangles<std::int64_t>(array, vertex_count)
                   : read_triangles<std::int32_t>(array, vertex_count);
  }
  return is_wide ? read_triangles<std::uint64_t>(array, vertex_count)
                 : read_triangles<std::uint32_t>(array, vertex_count);
}

}  // namespace

py::array owned_flags(std::vector<std::uint8_t>&& flags, const Shape& shape) {
  static_assert(sizeof(bool) == sizeof(std::uint8_t));
  return owned_array<bool>(std::move(flags), shape);
}

py::array_t<double> array_of(const Vec3& v) {
  return py::array_t<double>(3, v.data());
}

bool is_single_point(const py::object& value) {
  return array_from(value, "array").ndim() == 1;
}

std::vector<Vec3> points_of(const py::object& value, const char* name) {
  py::array array = array_from(value, name);
  if (array.ndim() == 1 && array.shape(0) == 3) {
    array = array.reshape({1, 3});
  }
  need_rows_of_three(array, name);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::type_error(std::string(name) + " must hold real numbers, not " +
                         py::str(array.dtype()).cast<std::string>());
  }
  array = native(array);
  if (kind == 'f' && array.itemsize() == sizeof(float)) {
    return read_points<float>(array, name);
  }
  if (kind == 'f' && array.itemsize() == sizeof(double)) {
    return read_points<double>(array, name);
  }
  return read_points<double>(array.attr("astype")("float64"), name);
}

Vec3 vector_of(const py::object& value, const char* name) {
  const py::array array = array_from(value, name);
  if (array.ndim() != 1 || array.shape(0) != 3) {
    throw InvalidInput(std::string(name) + " must be three numbers");
  }
  return points_of(array, name).front();
}

TriMesh mesh_of(const py::object& V, const py::object& F) {
  const py::array vertices = array_from(V, "V");
  need_rows_of_three(vertices, "V");
  if (vertices.shape(0) == 0) {
    throw InvalidInput("V holds no vertices");
  }
  if (static_cast<std::uint64_t>(vertices.shape(0)) > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidInput("V holds more than 4294967295 vertices");
  }
  TriMesh mesh;
  mesh.positions = points_of(vertices, "V");
  if (F.is_none()) {
    return mesh;
  }
  const py::array faces = array_from(F, "F");
  if (faces.size() == 0 && faces.ndim() <= 2) {  // an empty list has neither shape nor integers
    return mesh;
  }
  need_rows_of_three(faces, "F");
  const char kind = faces.dtype().kind();
  if (kind != 'i' && kind != 'u') {
    throw py::type_error("F must hold integers, not " + py::str(faces.dtype()).cast<std::string>());
  }
  mesh.triangles = triangles_of(native(faces), mesh.positions.size());
  return mesh;
}

std::vector<std::array<std::uint8_t, 3>> colours_of(const py::object& value) {
  const py::array array = array_from(value, "colours");
  need_rows_of_three(array, "colours");
  if (array.dtype().kind() != 'u' || array.itemsize() != 1) {
    throw py::type_error("colours must be uint8, not " +
                         py::str(array.dtype()).cast<std::string>());
  }
  std::vector<std::array<std::uint8_t, 3>> colours;
  colours.reserve(static_cast<std::size_t>(array.shape(0)));
  for_each_row<std::uint8_t>(
      array, [&](py::ssize_t, const std::array<std::uint8_t, 3>& row) { colours.push_back(row); });
  return colours;
}

double number_of(const py::object& value, const char* name) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    throw py::type_error(std::string(name) + " must be a number");
  }
}

std::int64_t whole_number_of(const py::object& value, const char* name, std::int64_t low,
                             std::int64_t high) {
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + " must be a whole number");
  }
  int overflow = 0;
  const long long whole = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0 || whole < low || whole > high) {
    throw InvalidInput(name + (overflow == 0 ? " is " + std::to_string(whole) + " but" : "") +
                       " must be between " + std::to_string(low) + " and " + std::to_string(high));
  }
  return whole;
}

}  // namespace vantage::python
