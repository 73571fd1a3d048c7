// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// Vertices that refinement makes of all components, about, and those of components that are contracted side
/// by side: bounds time and memory [ours].
inline constexpr std::size_t kMostTogether = 60'000;

/// A surface that was split finer. The vertices that were there come first.
struct RefinedSurface {
  TriMesh mesh{};
  /// Of these, vertices that an even mesh of their component needs that splitting left with far more,
  /// as it does where thin triangles lie side by side; 0 elsewhere.
  std::vector<std::size_t> even_size{};
};

/// The surface with the components that are made of large faces for their size split finer, or
/// nothing if there is none: on those, contraction has too few vertices to move. The vertices of
/// `mesh` come first. How a component is split does not depend on the others, unless there are too
/// many vertices to make in all; each of them counts as if it were split. \throw Cancelled
std::optional<RefinedSurface> refine_coarse_components(const TriMesh& mesh, const RunContext& run);

/// One component, of a size near 1, split so too, whatever its faces. \throw Cancelled
TriMesh refine_whole(const TriMesh& scaled, const RunContext& run);

}  // namespace vantage
