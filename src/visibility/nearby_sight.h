// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/visibility/vertex_visibility.h"

#include "visibility/surface.h"

/// \file
/// What eyes close to one another see of a few vertices, for many such eyes.

namespace vantage {

/// The faces that may hide a vertex from an eye near some others all lie in a thin cone: they are
/// listed once, and each eye then asks those alone. The answers are those of visible_vertices()
/// for vertices of shells that are closed and do not meet themselves, with all eyes outside; a back
/// that hides for itself is not asked.
class NearbySight {
 public:
  /// \param vertices asked about. \param visibility outlives this.
  /// \param eyes the first of them in the middle; at least two.
  NearbySight(const VertexVisibility& visibility, std::span<const std::uint32_t> vertices,
              std::span<const Viewpoint> eyes);

  /// Whether the eye is as near to the middle as this was made for.
  [[nodiscard]] bool covers(const Viewpoint& eye) const;

  /// 1 for each vertex asked about that the eye sees. \pre covers(eye)
  [[nodiscard]] std::vector<std::uint8_t> seen(const Viewpoint& eye) const;

 private:
  /// A picture from the middle eye. What is nearer to the eye than a point of another nearness is
  /// displaced, as another eye sees it, by the difference times how far that eye is away.
  struct Picture {
    std::vector<float> x{}, y{}, nearness{};
  };

  /// The sites asked about by the picture's cells.
  struct Cells;

  void list_sites(std::span<const std::uint32_t> vertices);
  bool take_picture();
  [[nodiscard]] Cells sort_sites() const;
  void list_faces(const Cells& cells);
  [[nodiscard]] bool may_hide(std::uint32_t face) const;
  template <class Visit>
  void visit_behind(std::uint32_t face, const Cells& cells, const Visit& visit) const;
  [[nodiscard]] bool is_seen(std::size_t slot, const Viewpoint& eye) const;

  const Surface& surface_;
  Viewpoint middle_;                             // in the surface's frame, as all
  double reach_ = 0.0;                           // of the eyes around it
  std::vector<std::uint32_t> sites_{};           // asked about, each once
  std::vector<std::uint32_t> slot_of_site_{};    // where in these
  std::vector<std::uint32_t> slot_of_vertex_{};  // of the vertices asked about
  Picture picture_{};
  std::vector<std::uint32_t> first_holding_{}, holding_{};  // of each slot, the faces at it …
  std::vector<std::uint32_t> first_before_{}, before_{};    // … and those that may hide it
};

}  // namespace vantage
