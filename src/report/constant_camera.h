// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "vantage/report/evaluation.h"

/// \file
/// The null hypothesis of an evaluation: one camera for all models.

namespace vantage {

/// Name of its row.
inline constexpr std::string_view kConstantCamera = "best constant camera, model left out";

/// Adds a row to each evaluated model: the direction, of 642 along side, up and front of each model
/// (upright_frame()), of which the mean error, folded, is least on all other models where somebody
/// moved. So no model's views choose the camera that it is compared with. Nothing is added if there
/// is no other such model.
/// \param results one a record, in their order; those without rows of views are left as they are.
void add_constant_camera(const std::vector<RecordedModel>& records,
                         std::vector<EvaluatedModel>& results);

}  // namespace vantage
