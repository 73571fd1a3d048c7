// SPDX-License-Identifier: MIT
#pragma once

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"

namespace vantage {

/// Meshes a component anew, with fewer vertices, and contracts that by itself.
/// \param first the component, or its proxy. \param history its contraction, in the same frame.
SecondMesh contract_second_mesh(const TriMesh& first, const ComponentHistory& history,
                                const ContractionOptions& options, const RunContext& run);

/// Appends a component to `all`. Where one has fewer levels than the other, its last is repeated.
void append(SecondMesh part, SecondMesh& all);

}  // namespace vantage
