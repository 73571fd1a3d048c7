// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "vantage/orientation/orientation.h"

#include "orientation/height_fields.h"
#include "orientation/side_look.h"
#include "orientation/surface_traits.h"

namespace vantage {

/// One of the six directions along the box's axes.
struct AxisDirection {
  std::size_t axis = 2;
  bool is_positive = true;

  [[nodiscard]] AxisDirection opposite() const { return {axis, !is_positive}; }

  friend bool operator==(const AxisDirection&, const AxisDirection&) = default;
};

/// +x, −x, +y, −y, +z, −z.
std::array<AxisDirection, 6> axis_directions();

using Evidence = std::vector<OrientationFeature>;

/// \pre there is one of that name
double value_of(std::string_view name, const Evidence& evidence);

/// Everything that evidence is made of, measured once.
class SideLooks {
 public:
  SideLooks(const TriMesh& surface, const TextureFlow& flow);

  /// Evidence for a direction being up.
  [[nodiscard]] Evidence upright_evidence(AxisDirection up) const;
  /// Evidence for a direction being the front, if `up` is up. \pre they have different axes.
  [[nodiscard]] Evidence front_evidence(AxisDirection up, AxisDirection front) const;
  /// How much the surface changes when it is turned about `up` so that `front` comes to lie on
  /// `other`, or mirrored so; in [0, 1]. \pre both have another axis than `up`.
  [[nodiscard]] double difference(AxisDirection up, AxisDirection front, AxisDirection other) const;

 private:
  [[nodiscard]] const SideLook& look_from(AxisDirection side) const {
    return looks_[2 * side.axis + (side.is_positive ? 0 : 1)];
  }

  [[nodiscard]] const SideTraits& traits_of(AxisDirection side) const {
    return traits_.side[2 * side.axis + (side.is_positive ? 0 : 1)];
  }

  HeightFields fields_;
  SurfaceTraits traits_;
  TextureFlow flow_;
  bool knows_origin_ = false;  ///< The coordinates' origin is in the box, or near it.
  std::array<SideLook, 6> looks_{};
  std::array<double, 3> mirror_{};
  std::array<double, 3> half_turn_{};
  std::array<double, 3> quarter_turn_{};
};

}  // namespace vantage
