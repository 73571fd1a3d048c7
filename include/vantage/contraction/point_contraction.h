// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/contraction/contraction.h"
#include "vantage/core/run_context.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Contraction of a point cloud: Cao, Tagliasacchi, Olson, Zhang, Su, "Point Cloud Skeletons via
/// Laplacian-Based Contraction", SMI 2010, doi:10.1109/SMI.2010.25. docs/contraction.md has the
/// choices.

namespace vantage {

/// A cloud's history, and the samples that were contracted in its place.
struct PointContraction {
  ContractionHistory history{};  ///< Of every point; outliers stay and are kIsolated.
  TriMesh samples{};             ///< What was contracted; the triangles their rings agree on.
  ContractionHistory sample_history{};           ///< Of the samples.
  std::vector<std::uint32_t> sample_of_point{};  ///< Nearest sample; kIsolated for outliers.
};

/// Marks statistical outliers: points whose mean distance to their k nearest exceeds 4 × the median
/// of what those have. Of a few points none is one.
/// \return one entry per point, 1 for outliers. \pre points pairwise different.
std::vector<std::uint8_t> find_outliers(std::span<const Vec3> points, const RunContext& run = {});

/// Contracts each component of the cloud's ring graph by itself.
/// \param points    pairwise different, finite.
/// \param left_out  one entry per point; 1 leaves it out (outliers).
/// \throw InvalidInput if an option is outside its range. \throw Cancelled
PointContraction contract_points(std::span<const Vec3> points,
                                 std::span<const std::uint8_t> left_out,
                                 const ContractionOptions& options = {},
                                 const RunContext& run = {});

}  // namespace vantage
