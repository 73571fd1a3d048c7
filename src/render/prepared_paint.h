// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vantage/render/render.h"

#include "render/drawn_surface.h"
#include "render/picture_rays.h"
#include "render/surface_materials.h"
#include "render/tubes.h"

namespace vantage {

/// What one picture of a scene shows on and in its surface.
class PreparedPaint {
 public:
  /// \param surface must outlive this.
  PreparedPaint(const Paint& paint, const DrawnSurface& surface, const PictureRays& rays,
                const RenderOptions& options);

  /// Whether any place of the surface may be seen through.
  [[nodiscard]] bool has_openings() const {
    return materials_ != nullptr && materials_->has_openings();
  }

  /// What is seen where a ray as wide as `width` hits the surface.
  [[nodiscard]] SurfaceMaterials::Shown shown(const RayHit& hit, double width) const;

  /// Curves through the surface, if there are any.
  [[nodiscard]] const std::optional<Tubes>& tubes() const { return tubes_; }

  /// Linear.
  [[nodiscard]] const Vec3& tube_colour() const { return tube_colour_; }

 private:
  const DrawnSurface* surface_;
  Vec3 colour_;
  std::vector<Vec3f> colour_of_vertex_{};  // linear; empty: colour_
  std::vector<float> share_of_vertex_{};   // of a map's range; empty: none
  const SurfaceMaterials* materials_;
  bool is_drawing_;  // lines tell its shape
  std::optional<Tubes> tubes_{};
  Vec3 tube_colour_;
};

}  // namespace vantage
