// SPDX-License-Identifier: MIT
#include "render/openness_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace vantage {
namespace {

constexpr int kRadius = kOpennessRadiusPx;
/// Normals are alike up to about 26°. [ours]
constexpr double kAlike = 0.9;
/// How far from the plane neighbours may lie, px. [ours]
constexpr double kNearPx = 1.5;

double smoothed(const std::vector<SurfaceProbe>& probes, int width, int rows, int x, int y,
                double pixel) {
  const auto at = [&](int i, int j) -> const SurfaceProbe& {
    return probes[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(i)];
  };
  const SurfaceProbe& centre = at(x, y);
  double closed = 0.0;
  double weights = 0.0;
  for (int j = std::max(0, y - kRadius); j <= std::min(rows - 1, y + kRadius); ++j) {
    for (int i = std::max(0, x - kRadius); i <= std::min(width - 1, x + kRadius); ++i) {
      const SurfaceProbe& other = at(i, j);
      if (other.hit && same_patch(centre, other.position, other.normal, kNearPx * pixel)) {
        const double weight = (kRadius + 1.0 - std::abs(i - x)) * (kRadius + 1.0 - std::abs(j - y));
        closed += weight * (1.0 - other.openness);
        weights += weight;
      }
    }
  }
  return weights > 0.0 ? 1.0 - closed / weights : centre.openness;
}

}  // namespace

bool same_patch(const SurfaceProbe& a, const Vec3& position, const Vec3& normal, double tolerance) {
  return a.normal.dot(normal) > kAlike &&
         std::abs(a.normal.dot(position - a.position)) <= tolerance;
}

void smooth_openness(std::vector<SurfaceProbe>& probes, int width, double pixel) {
  const int rows = static_cast<int>(probes.size() / static_cast<std::size_t>(width));
  std::vector<double> values(probes.size(), 1.0);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x);
      values[at] = probes[at].hit ? smoothed(probes, width, rows, x, y, pixel) : 1.0;
    }
  }
  for (std::size_t i = 0; i < probes.size(); ++i) {
    probes[i].openness = values[i];
  }
}

}  // namespace vantage
