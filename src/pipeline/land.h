// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vantage/io/model.h"
#include "vantage/pipeline/view_options.h"

/// \file
/// Models of land have their height up, whatever axis their format has up: programs that make terrain and
/// cities have z up, and hardly any turns them as it writes OBJ or PLY.

namespace vantage {

/// The up axis of land, and what tells that it is land.
struct LandUp {
  UpAxis axis = UpAxis::Z;  ///< y or z.
  UpHabit habit = UpHabit::MapCoordinates;
};

/// The up axis of a model in coordinates of a map, as geographic programs write them (two are a place in a grid
/// such as UTM or a country's own, the third is a height above the sea), or of a height field: an open sheet of
/// many faces over a rectangle, of one height at each place and hilly both ways. [ours]
/// \return nothing where the model is neither, or the file says itself what is up.
std::optional<LandUp> up_of_land(const Model& model);

}  // namespace vantage
