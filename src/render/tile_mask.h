// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/tri_mesh.h"

#include "render/picture_rays.h"

namespace vantage {

/// Which parts of a picture a surface may show in: rays through the others need not be cast.
class TileMask {
 public:
  /// \param mesh in the scene's frame. \param pixel size of a pixel at the middle of the scene.
  TileMask(const TriMesh& mesh, const PictureRays& rays, double pixel, int width, int height);

  /// False only if no sample of this pixel, nor one up to two pixels beside it, meets the surface.
  [[nodiscard]] bool may_show(int x, int y) const {
    return all_ || tiles_[static_cast<std::size_t>(y / kTilePx) * columns_ +
                          static_cast<std::size_t>(x / kTilePx)] != 0;
  }

 private:
  static constexpr int kTilePx = 8;

  bool all_ = false;  ///< Nothing can be said.
  std::size_t columns_ = 1;
  std::vector<std::uint8_t> tiles_{};
};

}  // namespace vantage
