// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "io/model_builder.h"

namespace vantage {

/// What the header word of an OFF file announces for each vertex.
struct OffLayout {
  bool texture = false;        ///< ST: two texture coordinates, last.
  bool colour = false;         ///< C: red green blue alpha, after the normal.
  bool normal = false;         ///< N: after the coordinates.
  bool homogeneous = false;    ///< 4: a fourth coordinate that divides the others.
  bool any_dimension = false;  ///< n: the dimension follows the header word.

  bool colour_first = false;  ///< As MeshLab writes it, which says NC: the colour, then the normal.

  [[nodiscard]] std::size_t coordinates() const { return homogeneous ? 4 : 3; }

  /// Numbers between coordinates and colour.
  [[nodiscard]] std::size_t before_colour() const { return normal && !colour_first ? 3 : 0; }

  /// Numbers that are neither coordinates nor colour.
  [[nodiscard]] std::size_t beside_colour() const {
    return (normal ? 3U : 0U) + (texture ? 2U : 0U);
  }
};

/// The layout of a header word such as "OFF" or "STCN4OFF", its letters in any order; nothing if it
/// is none.
std::optional<OffLayout> off_layout(std::string_view word);

/// \throw FormatError unless it is 3.
void require_three_dimensions(std::int64_t dimension, Place place, const ModelBuilder& builder);

/// Reads the vertex x y z [w] whose numbers are given. \throw FormatError if w is 0.
void add_off_point(ModelBuilder& builder, const OffLayout& layout, const double* numbers,
                   Place place);

/// Reads what follows the header line of a binary OFF file.
/// \param start offset of the first byte after that line.
void read_binary_off(std::string_view bytes, std::size_t start, const OffLayout& layout,
                     ModelBuilder& builder);

}  // namespace vantage
