// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

#include "contraction/component_contraction.h"
#include "contraction/proxy.h"

/// \file
/// How one surface is contracted: by which weights, and what is done where it stands still or is
/// stuck far from a curve.

namespace vantage {

/// Components of more vertices are contracted by a proxy of about this many, where they can be
/// decimated so far [ours; trials in docs/lab].
inline constexpr std::size_t kProxyFrom = 20'000;
inline constexpr std::size_t kProxySize = 10'000;
/// The skeleton of such a component starts from about so many merged vertices [ours: fewer lose
/// limbs; trials in docs/lab].
inline constexpr std::size_t kMergedSize = 40'000;
/// A proxy must be smaller than this share of its component to be worth it.
inline constexpr double kProxyShare = 0.7;

/// Contracts one component already scaled as options.scaling says, or its proxy.
ComponentHistory contract_surface(const TriMesh& scaled, const std::optional<Proxy>& proxy,
                                  const ContractionOptions& options, const RunContext& run);

}  // namespace vantage
