// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/spatial/mirror_symmetry.h"

namespace vantage {

/// A view that somebody chose to show a thing from.
struct RecordedChoice {
  ShapeProportions shape{};        ///< Of the thing.
  Vec3 direction = Vec3::UnitZ();  ///< Unit, along side, up and front.
};

/// Choices, and the constants of the model that is made of them; docs/people.md.
struct ChoiceTable {
  double habit_weight = 0.0;         ///< k, a radian.
  double significance_weight = 0.0;  ///< w
  double bandwidth = 1.0;            ///< h, of log proportions.
  double mirror_weight = 0.0;        ///< What another mirror plane adds to their squared distance.
  std::vector<RecordedChoice> choices{};
};

/// Reads the text of a table. \throw InvalidInput naming the line.
ChoiceTable parse_choice_table(std::string_view text);

/// The table that this library was built with.
const ChoiceTable& choice_table();

}  // namespace vantage
