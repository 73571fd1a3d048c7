// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vantage/io/model.h"
#include "vantage/pipeline/view_options.h"

namespace vantage {

/// The up axis of a model in coordinates of a map, as geographic programs write terrain and cities: two are a place
/// in a grid such as UTM or a country's own, the third is a height above the sea. [ours]
/// \return y or z; nothing where the coordinates are not of a map, or the file says itself what is up.
std::optional<UpAxis> up_of_map(const Model& model);

}  // namespace vantage
