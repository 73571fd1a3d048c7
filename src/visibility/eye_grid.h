// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"

#include "spatial/eye_picture.h"
#include "visibility/face_packet.h"
#include "visibility/surface.h"

/// \file
/// Which of a surface's samples one eye sees, all at once. All segments of one query end in the same
/// eye, so the samples are sorted into a flat grid over the picture, and every face hides the
/// samples behind it: what a hierarchy in space would do, at a fraction of the cost.

namespace vantage {

/// Working memory of one eye's queries. Made for reuse: another eye allocates nothing new.
class EyeGrid {
 public:
  /// Begins with an eye in the surface's frame.
  /// \param turned to it of the surface's faces. \param back_faces FaceMeetings::occluding_back_faces; none: all
  ///              back faces are asked what they hide, to the same answers. Both must outlive the eye's queries.
  void begin(const Viewpoint& eye, const TurnedFaces& turned,
             std::span<const std::uint8_t> back_faces);

  /// Sets seen[i] to 0 for every sample that some face hides from the eye. Float arithmetic with
  /// error bounds settles clear cases, the double test of segment.h the doubtful ones.
  /// The first query of an eye chooses the cells; ask about most samples there.
  /// \param seen 0 for samples not to be asked about. \pre begin() with what is turned of this surface.
  /// \return false if the answer is not complete: the eye is too near for a flat grid, or the faces
  ///         are so long and thin that a grid is slow. What is 0 by then is hidden all the same.
  bool hide(const Surface& surface, std::vector<std::uint8_t>& seen, const RunContext& run);

  /// Of all samples and blocks of faces, since the first query; null where the eye is too near for one.
  [[nodiscard]] const EyePicture* picture() const {
    return aim_ == Aim::Taken ? &picture_ : nullptr;
  }

 private:
  using Place = EyePicture::Place;
  using CellRange = EyePicture::CellRange;

  struct Walk;

  void place_samples(const std::vector<std::uint8_t>& seen, const RunContext& run);
  void sort_samples();
  void find_deepest();
  void sort_faces(const Surface& surface);
  std::size_t mark_hidden(std::vector<std::uint8_t>& seen) const;
  [[nodiscard]] bool behind_all(float nearest, const CellRange& cells) const;

  template <unsigned Lanes>
  [[nodiscard]] static CellRange cells_of(const FacePacket<Lanes>& faces, unsigned lane) {
    return {faces.left[lane], faces.right[lane], faces.top[lane], faces.bottom[lane]};
  }

  bool walk_sides(const Surface& surface, const RunContext& run);
  bool walk_sorted(const Surface& surface, std::vector<std::uint8_t>& seen, const RunContext& run);
  bool walk(Walk& walk, std::size_t first, std::size_t count, const RunContext& run);
  void walk_wide(Walk& walk, std::size_t begin, std::size_t end);
  template <unsigned Lanes>
  void walk_blocks(Walk& walk, std::size_t begin, std::size_t end);
  template <unsigned Lanes>
  void walk_order(Walk& walk, std::size_t begin, std::size_t end);
  template <unsigned Lanes>
  std::size_t hide_behind_all(Walk& walk, FacePacket<Lanes>& h);
  template <unsigned Lanes>
  void make_ready(const Surface& surface, FacePacket<Lanes>& h) const;
  template <unsigned Lanes>
  std::size_t hide_behind(const Surface& surface, const FacePacket<Lanes>& h, unsigned lane);
  template <unsigned Lanes>
  void hide_sample(const Surface& surface, const FacePacket<Lanes>& h, unsigned lane,
                   std::size_t slot);
  [[nodiscard]] float depth_behind(const Surface& surface, std::uint32_t sample,
                                   std::uint32_t face) const;
  [[nodiscard]] bool blocks(const Surface& surface, std::uint32_t sample, std::uint32_t face) const;

  /// Whether the eye's picture has cells, or cannot have any.
  enum class Aim { None, Taken, Failed };

  Viewpoint eye_{};
  const TurnedFaces* turned_ = nullptr;
  std::span<const std::uint8_t>
      back_faces_{};  // of each face: whether its back is asked; none: all are
  Aim aim_ = Aim::None;
  EyePicture picture_{};  // of samples, and of blocks of faces
  std::uint32_t tile_columns_ = 1, tile_rows_ = 1;
  std::vector<std::uint32_t> asked_{};      // samples asked about, ascending
  std::vector<std::uint32_t> cell_{};       // of each of them
  std::vector<std::uint32_t> begin_{};      // where each cell begins in the arrays below
  std::vector<std::uint32_t> sample_of_{};  // samples, one cell after the other
  std::vector<float> x_{}, y_{};            // of each of them
  std::vector<float> depth_{};              // of each of them; minus infinity if known hidden
  std::vector<std::uint8_t> hidden_{};      // of each
  std::vector<std::uint32_t> order_{};      // of the faces, nearest first
  std::vector<float> deepest_{};            // of the samples left in each tile of cells
};

}  // namespace vantage
