// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <nlohmann/json.hpp>

#include "vantage/core/run_context.h"
#include "vantage/io/model.h"

#include "report/page_data.h"

/// \file
/// The model as its file wants it to look, for the page report.html.

namespace vantage {

/// Whether the file says anything of colours, materials or textures.
bool has_look(const Model& model);

/// The file's own faces by material, with its colours and textures; null if it says nothing of them
/// or has more than `max_faces`. viewer/README.md describes it.
nlohmann::ordered_json asset_part(const Model& model, std::size_t max_faces, const PageFrame& frame,
                                  const RunContext& run);

}  // namespace vantage
