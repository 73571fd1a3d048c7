// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "vantage/orientation/orientation.h"

#include "orientation/axis_direction.h"
#include "orientation/height_fields.h"
#include "orientation/side_relief.h"
#include "orientation/surface_traits.h"

namespace vantage {

/// Everything that evidence is made of, measured once.
struct MeasuredSides {
  MeasuredSides(const TriMesh& surface, const TextureFlow& flow);

  [[nodiscard]] const SideRelief& relief_of(AxisDirection side) const {
    return reliefs[side.index()];
  }

  [[nodiscard]] const SideTraits& traits_of(AxisDirection side) const {
    return traits.side[side.index()];
  }

  /// How much the surface changes when it is turned about `up` so that `front` comes to lie on
  /// `other`, or mirrored so; in [0, 1]. \pre both have another axis than `up`.
  [[nodiscard]] double difference(AxisDirection up, AxisDirection front, AxisDirection other) const;

  /// An origin this far from the box's centre says nothing, over the box's side.
  static constexpr double kFar = 0.6;

  HeightFields fields;
  SurfaceTraits traits;
  TextureFlow flow;
  bool knows_origin = false;             ///< The coordinates' origin is in the box, or near it.
  std::array<SideRelief, 6> reliefs{};   ///< +x, −x, +y, −y, +z, −z.
  std::array<double, 3> mirror{};        ///< mirror_error() across each axis …
  std::array<double, 3> half_turn{};     ///< … half_turn_error() about it …
  std::array<double, 3> quarter_turn{};  ///< … and quarter_turn_error().
};

}  // namespace vantage
