// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/vec3.h"

#include "visibility/polygon_rest.h"
#include "visibility/site_picture.h"
#include "visibility/surface.h"

/// \file
/// What is seen of single faces, as polygons: the face less the shadows that the faces before it
/// cast on it from the eye (Weiler and Atherton, "Hidden surface removal using polygon area
/// sorting", 1977, for one face at a time).

namespace vantage {

/// Convex parts of faces that are in view.
struct SeenParts {
  struct Part {
    std::uint32_t face = 0;
    double share = 0.0;   ///< Of the face's area.
    std::size_t end = 0;  ///< Of its corners, which begin where those of the part before end.
  };

  std::vector<Part> parts{};
  std::vector<Vec3> corners{};  ///< In the surface's frame.

  [[nodiscard]] std::span<const Vec3> corners_of(std::size_t part) const {
    const std::size_t begin = part == 0 ? 0 : parts[part - 1].end;
    return std::span(corners).subspan(begin, parts[part].end - begin);
  }
};

/// For one eye.
class FaceClip {
 public:
  /// \param turned   the side each face turns to the eye: 1 front, 2 back, 0 neither.
  /// \param backs    hiding_backs().
  /// \param surface, picture must outlive this.
  FaceClip(const Surface& surface, const SitePicture& picture, const Viewpoint& eye,
           const std::vector<std::uint8_t>& turned, const std::vector<std::uint8_t>& backs);

  /// Adds what is seen of a face. \pre picture.is_whole.
  /// \return false if so many faces lie in its place of the picture that samples are worth more.
  [[nodiscard]] bool add_parts(std::uint32_t face, SeenParts& parts);

  /// Lists faces that are seen just past an edge, away from a site beside it: what is next behind some
  /// places of it that nothing lies before. May hold a face more than once.
  /// \return whether there is such a place.
  bool list_past(const std::array<std::uint32_t, 2>& edge, std::uint32_t beside,
                 std::vector<std::uint32_t>& faces);

  /// Lists those of the wanted faces that an edge lies before. \param wanted 1 for each, else 0.
  void list_behind(const std::array<std::uint32_t, 2>& edge, std::span<const std::uint8_t> wanted,
                   std::vector<std::uint32_t>& faces);

 private:
  /// Where a face is in the picture.
  struct Seat {
    SitePicture::Box box{};
    double nearest = 0.0;     // nearness of a corner
    std::uint32_t round = 0;  // in which it was last listed
  };

  using CellRange = std::array<std::array<std::size_t, 2>, 2>;  // columns and rows, first and last

  /// What is seen at a place of the picture.
  struct Found {
    std::uint32_t face = Surface::kNoSite;
    double nearness = 0.0;
  };

  [[nodiscard]] bool list_near(std::uint32_t face);
  [[nodiscard]] bool spend(std::size_t steps);
  void set_cells(std::size_t side);
  [[nodiscard]] Found first_at(const Eigen::Vector2d& place, double nearness);
  void lay_grid(const std::vector<std::uint8_t>& turned, const std::vector<std::uint8_t>& backs);
  [[nodiscard]] CellRange cells(const SitePicture::Box& box) const;

  const Surface& surface_;
  const SitePicture& picture_;
  Viewpoint eye_;
  SitePicture::Box box_{};  // of the picture
  std::size_t side_ = 1;    // cells
  Eigen::Vector2d per_cell_ = Eigen::Vector2d::Zero();
  std::vector<std::uint32_t> first_{}, in_cells_{};  // hiding faces of each cell; one past the last
  std::vector<Seat> seats_{};                        // of each face
  std::uint32_t round_ = 0;
  std::size_t steps_ = 0;  // of all work so far
  std::vector<std::uint32_t> near_{};
  Polygons shadows_{};
  std::vector<std::pair<double, std::size_t>> by_size_{};  // less the area of each shadow
  PolygonRest rest_{};
};

}  // namespace vantage
