// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/core/error.h"
#include "vantage/io/write.h"
#include "vantage/mesh/measures.h"

#include "io/byte_cursor.h"

namespace vantage {
namespace {

constexpr double kLargestFloat = static_cast<double>(std::numeric_limits<float>::max());

/// Whether rounding to float moves a vertex by more than a two-millionth of the size, as it does far from the
/// origin, or overflows.
bool loses_shape_as_float(const TriMesh& mesh) {
  constexpr double kMostMoved = 0x1p-21;
  const double most = kMostMoved * bounding_box(mesh.positions).longest_side();
  return std::any_of(mesh.positions.begin(), mesh.positions.end(), [&](const Vec3& p) {
    return !((p.cast<float>().cast<double>() - p).cwiseAbs().maxCoeff() <= most);
  });
}

void check_sizes(const TriMesh& mesh, std::span<const double> quality,
                 std::span<const Rgb8> colours) {
  const std::size_t n = mesh.positions.size();
  if ((!quality.empty() && quality.size() != n) || (!colours.empty() && colours.size() != n)) {
    throw InvalidInput("a map must have one value and one colour for each of the " +
                       std::to_string(n) + " vertices");
  }
  if (!std::all_of(quality.begin(), quality.end(), [](double q) { return std::isfinite(q); })) {
    throw InvalidInput("a map must not hold values that are not finite");
  }
}

std::string header(const TriMesh& mesh, bool has_quality, bool has_colours, const char* scalar) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by vantage\n";
  text += "element vertex " + std::to_string(mesh.positions.size()) + "\n";
  for (const char* const axis : {"x", "y", "z"}) {
    text += std::string("property ") + scalar + " " + axis + "\n";
  }
  text += has_quality ? "property float quality\n" : "";
  if (has_colours) {
    text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  text += "element face " + std::to_string(mesh.triangles.size()) + "\n";
  return text + "property list uchar int vertex_indices\nend_header\n";
}

}  // namespace

std::string ply_bytes(const TriMesh& mesh, std::span<const double> quality,
                      std::span<const Rgb8> colours, bool double_precision) {
  check_sizes(mesh, quality, colours);
  const bool as_double = double_precision || loses_shape_as_float(mesh);
  std::string bytes =
      header(mesh, !quality.empty(), !colours.empty(), as_double ? "double" : "float");
  bytes.reserve(bytes.size() + mesh.positions.size() * (as_double ? 31 : 19) +
                mesh.triangles.size() * 13);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = mesh.positions[v][axis];
      as_double ? append_little_endian(bytes, x)
                : append_little_endian(bytes, static_cast<float>(x));
    }
    if (!quality.empty()) {
      append_little_endian(
          bytes, static_cast<float>(std::clamp(quality[v], -kLargestFloat, kLargestFloat)));
    }
    if (!colours.empty()) {
      bytes.append(reinterpret_cast<const char*>(colours[v].data()), 3);
    }
  }
  for (const Triangle& triangle : mesh.triangles) {
    append_little_endian(bytes, std::uint8_t{3});
    for (const std::uint32_t v : triangle) {
      append_little_endian(bytes, v);
    }
  }
  return bytes;
}

}  // namespace vantage
