// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/core/vec3.h"

/// \file
/// Gaussian-weighted means of a field on points at the scales of mesh saliency (Lee, Varshney, Jacobs
/// 2005).

namespace vantage {

/// Scales σ, in ε, ascending: the five of Lee 2005 and their doubles.
inline constexpr std::array<int, 8> kGaussianScales{2, 3, 4, 5, 6, 8, 10, 12};

/// A mean over scale σ reaches this many σ far (Lee 2005).
inline constexpr double kGaussianReach = 2.0;

/// Points with a field, in units of ε, so that squares neither overflow nor vanish.
struct FieldPoints {
  std::vector<Vec3> position{};  ///< None below 0.
  std::vector<double> value{};
  std::vector<double> weight{};
};

/// G(value, σ) at a point for each scale: the mean over the points within kGaussianReach σ, weighted
/// by weight · exp(−d² / 2σ²); 0 where no weight is.
using GaussianMeans = std::array<double, kGaussianScales.size()>;

/// Means at each point. Within a few 1e-15 of exact sums; the same bits for any thread count.
/// \throw Cancelled
/// \complexity The number of pairs of points within the reach of the largest scale.
std::vector<GaussianMeans> gaussian_means(const FieldPoints& points, const RunContext& run);

}  // namespace vantage
