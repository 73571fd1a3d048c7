// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "visibility/face_packet.h"
#include "visibility/surface.h"

/// \file
/// Which of a surface's sites one eye sees, all at once. All segments of one query end in the same
/// eye, so the sites are sorted into a flat grid over the picture, and every face strikes out the
/// sites behind it: what a hierarchy in space would do, at a fraction of the cost.

namespace vantage {

/// Working memory of one eye's queries. Made for reuse: another eye allocates nothing new.
class EyeGrid {
 public:
  /// Begins with an eye in the surface's frame: fills turned().
  /// \param backs FaceMeetings::hiding_backs of the surface, which must outlive the eye's queries;
  ///              none: all backs are asked what they hide, to the same answers.
  void begin(const Surface& surface, const Viewpoint& eye, std::span<const std::uint8_t> backs,
             const RunContext& run);

  /// Sets seen[i] to 0 for every site that some face hides from the eye. Float arithmetic with
  /// error bounds settles clear cases, the double test of segment.h the doubtful ones.
  /// The first query of an eye chooses the cells; ask about most sites there.
  /// \param seen 0 for sites not to be asked about. \pre begin() with this surface.
  /// \return false if the answer is not complete: the eye is too near for a flat grid, or the faces
  ///         are so long and thin that a grid is slow. What is 0 by then is hidden all the same.
  bool hide(const Surface& surface, std::vector<std::uint8_t>& seen, const RunContext& run);

  /// Which side each face turns to the eye: 1 its front, 2 its back, 0 neither.
  [[nodiscard]] const std::vector<std::uint8_t>& turned() const { return turned_; }

 private:
  // A float coordinate of a UnitFrame (below 1 in size) projected to an axis is wrong by less than
  // this: twelve roundings of 2^-24.
  static constexpr float kAxisError = 0x1p-20F;

  /// A place in the picture: x, y in cells, depth along the view axis in frame units; the fourth is
  /// 0.
  using Spot = float __attribute__((vector_size(4 * sizeof(float))));

  using Cells = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));

  /// What something spans in the picture, rounded outwards: its least x, y and depth, and its
  /// largest.
  struct Extent {
    Spot low, high;
  };

  /// The cells that an extent touches: columns and rows, from first to last.
  struct CellRange {
    std::uint32_t left, right, top, bottom;
  };

  struct Walk;

  void face_sides(const Surface& surface, const RunContext& run);
  void block_sides(const FaceBlocks& blocks, float error_bound);
  bool aim(const Surface& surface, const RunContext& run);
  bool set_axes();
  void project(const FloatPoints& points, std::vector<Spot>& spots, const RunContext& run) const;
  void lay_out(const Surface& surface, std::size_t active, const RunContext& run);
  void choose_cells(std::size_t active);
  void to_cells(std::vector<Spot>& spots, const RunContext& run) const;
  void place_sites(const std::vector<std::uint8_t>& seen, const RunContext& run);
  void sort_sites();

  VANTAGE_INLINE static Spot lower(const Spot& a, const Spot& b) { return b < a ? b : a; }

  VANTAGE_INLINE static Spot higher(const Spot& a, const Spot& b) { return a < b ? b : a; }

  [[nodiscard]] Spot in_picture(const FloatPoints& points, std::size_t at) const {
    const Spot spot = points.x[at] * along_x_ + points.y[at] * along_y_ + points.z[at] * along_z_;
    const float shrink = 1.0F / (slope_ * (spot[2] + shift_) + (1.0F - slope_));
    return spot * Spot{shrink, shrink, 1.0F, 0.0F};
  }

  [[nodiscard]] Spot in_cells(const Spot& spot) const { return (spot - origin_) * scale_; }

  template <unsigned Lanes>
  [[nodiscard]] static CellRange cells_of(const FacePacket<Lanes>& faces, unsigned lane) {
    return {faces.left[lane], faces.right[lane], faces.top[lane], faces.bottom[lane]};
  }

  [[nodiscard]] VANTAGE_INLINE CellRange cells_of(const Extent& extent) const {
    const Cells low = __builtin_convertvector(lower(higher(extent.low, Spot{}), last_), Cells);
    const Cells high = __builtin_convertvector(lower(higher(extent.high, Spot{}), last_), Cells);
    return {static_cast<std::uint32_t>(low[0]), static_cast<std::uint32_t>(high[0]),
            static_cast<std::uint32_t>(low[1]), static_cast<std::uint32_t>(high[1])};
  }

  void find_deepest();

  void outline_blocks(const FaceBlocks& blocks, const RunContext& run);
  [[nodiscard]] bool behind_all(float nearest, const CellRange& cells) const;
  template <unsigned Lanes>
  void walk_blocks(Walk& walk, std::size_t begin, std::size_t end);
  template <unsigned Lanes>
  void walk_order(Walk& walk, std::size_t begin, std::size_t end);
  void walk_wide(Walk& walk, std::size_t begin, std::size_t end);
  bool walk(Walk& walk, std::size_t first, std::size_t count, const RunContext& run);
  bool walk_sides(const Surface& surface, const RunContext& run);
  void sort_faces(const Surface& surface);
  std::size_t mark_hidden(std::vector<std::uint8_t>& seen) const;
  bool walk_sorted(const Surface& surface, std::vector<std::uint8_t>& seen, const RunContext& run);
  template <unsigned Lanes>
  std::size_t strike_all(Walk& walk, FacePacket<Lanes>& h);
  template <unsigned Lanes>
  void make_ready(const Surface& surface, FacePacket<Lanes>& h) const;
  template <unsigned Lanes>
  std::size_t strike(const Surface& surface, const FacePacket<Lanes>& h, unsigned lane);
  [[nodiscard]] float depth_behind(const Surface& surface, std::uint32_t site,
                                   std::uint32_t face) const;
  template <unsigned Lanes>
  void strike_site(const Surface& surface, const FacePacket<Lanes>& h, unsigned lane,
                   std::size_t slot);
  [[nodiscard]] bool blocks(const Surface& surface, std::uint32_t site, std::uint32_t face) const;

  /// Whether the eye's picture has cells, or cannot have any.
  enum class Aim { None, Taken, Failed };

  Viewpoint eye_{};
  std::span<const std::uint8_t> backs_{};  // of each face: whether its back is asked; none: all are
  Aim aim_ = Aim::None;
  Spot along_x_{}, along_y_{}, along_z_{};  // what each coordinate adds to a spot
  float distance_ = 0.0F;                   // of the eye from the frame's origin
  float shift_ = 0.0F, slope_ = 0.0F;  // a spot shrinks by 1 / (slope (depth + shift) + 1 − slope)
  Extent spanned_{};                   // by all corners
  Spot origin_{};                      // corner of the picture
  float cells_per_unit_ = 1.0F;
  Spot scale_{};         // cells a unit, of depth 1
  Spot last_{};          // cell of each row and column
  float margin_ = 0.0F;  // bound of the error of a spot's x and y, in cells
  std::uint32_t columns_ = 1, rows_ = 1;
  std::uint32_t tile_columns_ = 1, tile_rows_ = 1;
  std::vector<Spot> corners_{};             // of each site
  std::vector<Spot> centres_{};             // of each block of faces
  std::vector<Extent> blocks_{};            // of each block
  std::vector<std::uint32_t> asked_{};      // sites asked about, ascending
  std::vector<std::uint32_t> cell_{};       // of each of them
  std::vector<std::uint8_t> turned_{};      // of each face
  std::vector<std::uint8_t> block_side_{};  // of each block: that of all its faces, or 0
  std::vector<std::uint32_t> begin_{};      // where each cell begins in the arrays below
  std::vector<std::uint32_t> site_of_{};    // sites, one cell after the other
  std::vector<float> x_{}, y_{};            // of each of them
  std::vector<float> depth_{};              // of each of them; minus infinity if known hidden
  std::vector<std::uint8_t> hidden_{};      // of each
  std::vector<std::uint32_t> order_{};      // of the faces, nearest first
  std::vector<float> deepest_{};            // of the sites left in each tile of cells
};

}  // namespace vantage
