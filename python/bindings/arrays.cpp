// SPDX-License-Identifier: MIT
#include "arrays.h"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "vantage/core/error.h"

#include "arguments.h"

namespace vantage::python {
namespace {

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

std::string not_numbers(const char* name) {
  return std::string(name) + " must be an array of numbers";
}

py::array array_from(const py::object& value, const char* name) {
  try {
    py::array array(value);
    if (array.ndim() == 0) {  // NumPy wraps whatever it is given
      throw py::type_error(not_numbers(name) + ", not " + Py_TYPE(value.ptr())->tp_name);
    }
    return array;
  } catch (py::error_already_set& error) {
    error.restore();
    refuse_type(not_numbers(name));
  }
}

/// \param kinds NumPy's letters for them. \throw py::type_error if it holds others
void need_numbers(const py::array& array, const char* name, std::string_view kinds,
                  const char* what) {
  if (kinds.find(array.dtype().kind()) == std::string_view::npos) {
    throw py::type_error(std::string(name) + " must hold " + what + ", not " +
                         py::str(array.dtype()).cast<std::string>());
  }
}

void need_real_numbers(const py::array& array, const char* name) {
  need_numbers(array, name, "fiu", "real numbers");
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

/// A share of full colour in 256 steps. \throw InvalidInput if it is none
std::uint8_t byte_of(double share, py::ssize_t row) {
  if (!(share >= 0.0 && share <= 1.0)) {
    throw InvalidInput("colours must be between 0 and 1 where they are floats, in row " +
                       std::to_string(row));
  }
  return static_cast<std::uint8_t>(std::lround(255.0 * share));
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
  need_real_numbers(array, name);
  need_rows_of_three(array, name);
  const char kind = array.dtype().kind();
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
  need_real_numbers(array, name);
  if (array.ndim() != 1 || array.shape(0) != 3) {
    throw InvalidInput(std::string(name) + " must be three numbers");
  }
  return points_of(array, name).front();
}

std::vector<double> numbers_of(const py::object& value, const char* name) {
  const py::array array = array_from(value, name);
  need_numbers(array, name, "fiubO", "real numbers");  // None is NaN
  if (array.ndim() != 1) {
    throw InvalidInput(std::string(name) + " must be one number a vertex");
  }
  try {
    const py::array_t<double, py::array::c_style | py::array::forcecast> numbers(array);
    return {numbers.data(), numbers.data() + numbers.size()};
  } catch (py::error_already_set& error) {
    error.restore();
    refuse_type(not_numbers(name));
  }
}

TriMesh mesh_of(const py::object& V, const py::object& F) {
  const py::array vertices = array_from(V, "V");
  need_real_numbers(vertices, "V");
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
  const bool is_empty = faces.size() == 0;  // an empty list has neither integers nor rows
  if (!is_empty) {
    need_numbers(faces, "F", "iu", "integers");
  }
  if (!is_empty || faces.ndim() != 1) {
    need_rows_of_three(faces, "F");
  }
  if (!is_empty) {
    mesh.triangles = triangles_of(native(faces), mesh.positions.size());
  }
  return mesh;
}

std::vector<std::array<std::uint8_t, 3>> colours_of(const py::object& value) {
  const py::array array = array_from(value, "colours");
  const bool is_of_shares = array.dtype().kind() == 'f';
  if (!is_of_shares && (array.dtype().kind() != 'u' || array.itemsize() != 1)) {
    throw py::type_error("colours must be uint8, or floats from 0 to 1, not " +
                         py::str(array.dtype()).cast<std::string>());
  }
  need_rows_of_three(array, "colours");
  std::vector<std::array<std::uint8_t, 3>> colours;
  colours.reserve(static_cast<std::size_t>(array.shape(0)));
  if (is_of_shares) {
    const py::array shares = array.attr("astype")("float64");
    for_each_row<double>(shares, [&](py::ssize_t i, const std::array<double, 3>& row) {
      colours.push_back({byte_of(row[0], i), byte_of(row[1], i), byte_of(row[2], i)});
    });
    return colours;
  }
  for_each_row<std::uint8_t>(
      array, [&](py::ssize_t, const std::array<std::uint8_t, 3>& row) { colours.push_back(row); });
  return colours;
}

}  // namespace vantage::python
