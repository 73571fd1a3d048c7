// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

namespace vantage {

/// The surface with the components that are made of few huge faces split finer, or nothing if there
/// is none: on those, contraction has too few vertices to move. The vertices of `mesh` come first.
/// \throw Cancelled
std::optional<TriMesh> refine_coarse_components(const TriMesh& mesh, const RunContext& run);

/// One component, of diameter about 2, split so too, whatever its faces. \throw Cancelled
TriMesh refine_whole(const TriMesh& scaled, const RunContext& run);

}  // namespace vantage
