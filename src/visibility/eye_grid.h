// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "visibility/surface.h"

/// \file
/// Which of many points one eye sees, all at once. All segments of one query end in the same eye, so
/// the points are sorted into a flat grid over the picture, and every face strikes out the points
/// behind it: what a hierarchy in space would do, at a fraction of the cost.

namespace vantage {

/// Points on a surface whose sight is asked for. Refers to data that must outlive it. They are
/// numbered: the surface's sites first, if they are asked for, then points on faces.
struct SurfacePoints {
  std::span<const Vec3> sites{};           ///< All of the surface's, or none.
  std::span<const Vec3> exact{};           ///< Points on faces, in the surface's frame.
  const FloatPoints* rounded = nullptr;    ///< The same, rounded.
  std::span<const std::uint32_t> owner{};  ///< The face each of these lies on.
  std::span<const std::uint32_t> also{};   ///< Another face of the last of them, on its edge.

  [[nodiscard]] std::size_t size() const { return sites.size() + exact.size(); }

  [[nodiscard]] const Vec3& place(std::uint32_t point) const {
    return point < sites.size() ? sites[point] : exact[point - sites.size()];
  }

  /// Another face that a point on faces lies on; the same if none is known.
  [[nodiscard]] std::uint32_t also_of(std::size_t on_faces) const {
    const std::size_t before = exact.size() - also.size();
    return on_faces < before ? owner[on_faces] : also[on_faces - before];
  }

  /// Whether the face holds the point and therefore never blocks it.
  [[nodiscard]] bool held(std::uint32_t point, std::uint32_t face, const Triangle& corners) const {
    if (point < sites.size()) {
      return corners[0] == point || corners[1] == point || corners[2] == point;
    }
    const std::size_t at = point - sites.size();
    return owner[at] == face || also_of(at) == face;
  }
};

/// Working memory of one eye's queries. Made for reuse: another eye allocates nothing new.
class EyeGrid {
 public:
  /// Begins with an eye in the surface's frame: fills turned().
  void begin(const Surface& surface, const Viewpoint& eye, const RunContext& run);

  /// Sets seen[i] to 0 for every point that some face hides from the eye. Float arithmetic with
  /// error bounds settles clear cases, the double test of segment.h the doubtful ones.
  /// The first query of an eye chooses the cells; ask about most points there.
  /// \param seen 0 for points not to be asked about. \pre begin() with this surface.
  /// \return false if the answer is not complete: the eye is too near for a flat grid, or the faces
  ///         are so long and thin that a grid is slow. What is 0 by then is hidden all the same.
  bool hide(const Surface& surface, const SurfacePoints& points, std::vector<std::uint8_t>& seen,
            const RunContext& run);

  /// Which side each face turns to the eye: 1 its front, 2 its back, 0 neither.
  [[nodiscard]] const std::vector<std::uint8_t>& turned() const { return turned_; }

 private:
  /// A place in the picture: x, y in cells, depth along the view axis in frame units.
  struct Spot {
    float x, y, depth;
  };

  /// A face in the picture: corners, and its extent rounded outwards.
  struct Outline {
    Spot a, b, c;
    float x_low, x_high, y_low, y_high, nearest, farthest;
  };

  struct Probe;

  void face_sides(const Surface& surface, const RunContext& run);
  bool aim(const Surface& surface, const RunContext& run);
  bool set_axes();
  void project(const FloatPoints& points, std::vector<Spot>& spots, const RunContext& run) const;
  void choose_cells(const std::vector<Spot>& corners, std::size_t active);
  void to_cells(std::vector<Spot>& spots, const RunContext& run) const;
  void sort_points(const SurfacePoints& points, const std::vector<std::uint8_t>& seen);
  void find_deepest();
  [[nodiscard]] Outline outline(const Triangle& face) const;
  void outline_blocks(const FaceBlocks& blocks, const RunContext& run);
  [[nodiscard]] bool behind_all(const Outline& outline) const;
  bool walk(const Surface& surface, const SurfacePoints& points, std::uint8_t side,
            const RunContext& run);
  [[nodiscard]] Probe probe(std::uint32_t face, const Triangle& corners,
                            const Outline& outline) const;
  [[nodiscard]] unsigned near(const Outline& outline, const Probe& probe, std::size_t slot) const;
  [[nodiscard]] float depth_behind(const Surface& surface, const SurfacePoints& points,
                                   std::uint32_t point, std::uint32_t face) const;
  void strike_point(const Surface& surface, const SurfacePoints& points, std::uint32_t face,
                    const Outline& outline, const Probe& probe, std::size_t slot);
  std::size_t strike(const Surface& surface, const SurfacePoints& points, std::uint32_t face,
                     const Outline& outline);
  [[nodiscard]] bool blocks(const Surface& surface, const SurfacePoints& points,
                            std::uint32_t point, std::uint32_t face) const;

  /// Whether the eye's picture has cells, or cannot have any.
  enum class Aim { None, Taken, Failed };

  Viewpoint eye_{};
  Aim aim_ = Aim::None;
  float right_[3]{}, up_[3]{}, towards_[3]{};  // axes of the picture
  float distance_ = 0.0F;                      // of the eye from the frame's origin
  float x_low_ = 0.0F, y_low_ = 0.0F;          // corner of the picture
  float cells_per_unit_ = 1.0F;
  float margin_ = 0.0F;  // bound of the error of a spot's x and y, in cells
  std::uint32_t columns_ = 1, rows_ = 1;
  std::uint32_t tile_columns_ = 1, tile_rows_ = 1;
  std::vector<Spot> corners_{};            // of each site
  std::vector<Spot> centres_{};            // of each block of faces
  std::vector<Outline> blocks_{};          // extents of each block; no corners
  std::vector<Spot> spots_{};              // of each point on a face
  std::vector<std::uint8_t> turned_{};     // of each face
  std::vector<std::uint8_t> steep_{};      // of each face: far from edge on
  std::vector<std::uint32_t> begin_{};     // where each cell begins in the arrays below
  std::vector<std::uint32_t> point_of_{};  // points, one cell after the other
  std::vector<float> x_{}, y_{};           // of each of them
  std::vector<float> depth_{};             // of each of them; minus infinity if known hidden
  std::vector<std::uint32_t> key_{};       // of each: the site, or past them the face it lies on
  std::vector<std::uint8_t> hidden_{};     // of each
  std::vector<float> deepest_{};           // of the points left in each tile of cells
};

}  // namespace vantage
