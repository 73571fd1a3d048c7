// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/visibility/vertex_visibility.h"

#include "visibility/sight.h"

/// \file
/// What eyes close to one another see of a few vertices, for many such eyes.

namespace vantage {

/// The faces that may hide a vertex from an eye near some others all lie in a thin cone: those are
/// found once and made a small surface of, which each eye then looks at. The answers are those of
/// visible_vertices() for vertices of shells that are closed and do not meet themselves, with all
/// eyes outside; a back that hides for itself is not asked.
class NearbySight {
 public:
  /// \param vertices asked about.
  /// \param eyes the first of them in the middle; at least two.
  NearbySight(const VertexVisibility& visibility, std::span<const std::uint32_t> vertices,
              std::span<const Viewpoint> eyes);

  /// The same for some of the vertices that a wider one was asked about, with eyes it covers.
  /// \param chosen which of them, by their places in its list.
  NearbySight(const NearbySight& wider, std::span<const std::uint32_t> chosen,
              std::span<const Viewpoint> eyes);

  /// Whether the eye is as near to the middle as this was made for.
  [[nodiscard]] bool covers(const Viewpoint& eye) const;

  /// 1 for each vertex asked about that the eye sees. \pre covers(eye)
  [[nodiscard]] std::vector<std::uint8_t> seen(const Viewpoint& eye) const;

 private:
  void make_part(const Surface& surface, std::span<const Viewpoint> eyes);

  Viewpoint middle_;                             // in the surface's frame, as all
  double reach_ = 0.0;                           // of the eyes around it
  std::unique_ptr<Sight> part_{};                // what they may have to look at
  std::vector<std::uint8_t> is_asked_{};         // of each site of that part
  std::vector<std::uint32_t> site_of_vertex_{};  // of the vertices asked about
};

}  // namespace vantage
