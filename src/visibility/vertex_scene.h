// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "vantage/visibility/vertex_visibility.h"

#include "visibility/sight.h"

namespace vantage {

/// What VertexVisibility keeps.
struct VertexVisibility::Scene {
  explicit Scene(Surface surface) : sight(std::move(surface)) {}

  Sight sight;
};

}  // namespace vantage
