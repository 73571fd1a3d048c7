// SPDX-License-Identifier: MIT
#include "render/tile_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vantage {
namespace {

/// Samples lie up to 0.75 px beside their pixel; the rest is for rounding.
constexpr double kMarginPx = 2.0;
/// Where a pixel is smaller than this, in units of the frame, positions rounded to float (1e-7) may
/// leave their tile and the margin.
constexpr double kLeastPixel = 1e-5;
/// Tiles marked for a triangle on average, beyond a few times all tiles, before it costs more than
/// the rays it saves.
constexpr std::size_t kMostTilesEach = 8;
constexpr std::size_t kMostRounds = 64;

}  // namespace

TileMask::TileMask(const TriMesh& mesh, const PictureRays& rays, double pixel, int width,
                   int height) {
  const int columns = (width + kTilePx - 1) / kTilePx;
  const int rows = (height + kTilePx - 1) / kTilePx;
  columns_ = static_cast<std::size_t>(columns);
  tiles_.assign(columns_ * static_cast<std::size_t>(rows), 0);
  all_ = !(pixel >= kLeastPixel);
  std::size_t budget = kMostTilesEach * mesh.triangles.size() + kMostRounds * tiles_.size();
  std::vector<std::optional<std::array<double, 2>>> places;
  places.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    places.push_back(rays.place_of(p));
  }
  const auto tile = [](double place, int count) {
    return static_cast<int>(
        std::clamp(std::floor(place / kTilePx), -1.0, static_cast<double>(count)));
  };
  for (std::size_t t = 0; t < mesh.triangles.size() && !all_; ++t) {
    const auto& a = places[mesh.triangles[t][0]];
    const auto& b = places[mesh.triangles[t][1]];
    const auto& c = places[mesh.triangles[t][2]];
    if (!a || !b || !c) {  // beside or behind the eye: it may be seen anywhere
      all_ = true;
      break;
    }
    const auto low = [&](std::size_t axis) {
      return std::min({(*a)[axis], (*b)[axis], (*c)[axis]}) - kMarginPx;
    };
    const auto high = [&](std::size_t axis) {
      return std::max({(*a)[axis], (*b)[axis], (*c)[axis]}) + kMarginPx;
    };
    const int x0 = std::max(0, tile(low(0), columns));
    const int x1 = std::min(columns - 1, tile(high(0), columns));
    const int y0 = std::max(0, tile(low(1), rows));
    const int y1 = std::min(rows - 1, tile(high(1), rows));
    if (x0 > x1 || y0 > y1) {
      continue;
    }
    const auto marked =
        static_cast<std::size_t>(x1 - x0 + 1) * static_cast<std::size_t>(y1 - y0 + 1);
    all_ = marked > budget;
    budget -= std::min(budget, marked);
    for (int y = y0; y <= y1 && !all_; ++y) {
      const auto row =
          tiles_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * columns_);
      std::fill(row + x0, row + x1 + 1, std::uint8_t{1});
    }
  }
}

}  // namespace vantage
