// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vantage/core/vec3.h"

namespace vantage {

/// What the middle of a pixel shows, and how much of the sky that sees.
struct SurfaceProbe {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< Unit, as shaded.
  double openness = 1.0;       ///< In [0, 1].
  bool hit = false;            ///< Whether it shows the surface at all.
};

/// Neighbours up to so many pixels away take part in a mean: 25 of them make 18 rays a pixel as good
/// as 450, and crevices stay as narrow as a line. [ours]
inline constexpr int kOpennessRadiusPx = 2;

/// Whether two places belong to one patch of the surface: alike in normal, and near each other's
/// plane. \param tolerance distance from the plane that is still near.
bool same_patch(const SurfaceProbe& a, const Vec3& position, const Vec3& normal, double tolerance);

/// Takes the grain out of the openness of probes, row by row `width` wide: each becomes the mean over
/// its neighbours on the same patch. Where all are open it stays exactly 1.
/// \param pixel size of a pixel at the surface, about.
void smooth_openness(std::vector<SurfaceProbe>& probes, int width, double pixel);

}  // namespace vantage
