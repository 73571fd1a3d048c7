// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "vantage/core/vec3.h"
#include "vantage/io/model.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Models turned by quarter turns about their axes, with all else as it is.

namespace vantage {

/// A rotation that takes each coordinate axis to another, or to its opposite: exact.
struct AxisTurn {
  std::array<std::size_t, 3> from{0, 1, 2};          ///< Coordinate i of the result is this one …
  std::array<bool, 3> negated{false, false, false};  ///< … or its negative.

  /// The turn that takes the first pair of directions to the second. \pre each pair are two
  /// coordinate axes or their opposites, at right angles.
  AxisTurn(const Vec3& up, const Vec3& front, const Vec3& new_up, const Vec3& new_front);

  [[nodiscard]] bool is_none() const;                      ///< Nothing is turned.
  [[nodiscard]] Vec3 operator()(const Vec3& p) const;      ///< The turned point.
  [[nodiscard]] std::array<double, 4> quaternion() const;  ///< x, y, z, w; unit.
};

/// The bytes of an OBJ, STL, glTF or GLB with its shape turned; whatever else it holds stays. Numbers
/// of text files change their place and sign alone. A glTF gets a node above those of each scene.
/// \param format as parse_model() found it. \param name shown in messages.
/// \throw FormatError; InvalidInput for other formats.
std::string turned_bytes(std::string_view bytes, std::string_view name, ModelFormat format,
                         const AxisTurn& turn);

}  // namespace vantage
