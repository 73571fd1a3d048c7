// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/core/camera.h"
#include "vantage/core/run_context.h"
#include "vantage/visibility/face_visibility.h"

#include "visibility/closer_look.h"
#include "visibility/face_clip.h"
#include "visibility/face_samples.h"
#include "visibility/seen_tally.h"
#include "visibility/sight.h"
#include "visibility/site_picture.h"
#include "visibility/slivers.h"

/// \file
/// One look of an eye at a surface's areas: a first query about all samples, a second about what
/// that leaves open, and the sums.

namespace vantage {

/// For one thread to call.
class FaceLook {
 public:
  /// \param local the eye in the surface's frame. \param samples, run must outlive this.
  FaceLook(FaceSamples& samples, const Viewpoint& local, const RunContext& run);

  /// All that is seen, once.
  [[nodiscard]] SeenSurface seen();

 private:
  /// What tells how much of a face is seen.
  enum class Counted : std::uint8_t { ByPieces, Clipped, Whole };

  void look_at_samples();
  void list_contours();
  bool is_seen_past(std::uint32_t edge);
  [[nodiscard]] std::uint8_t findings_of(std::uint32_t face,
                                         std::span<const std::uint8_t> found) const;
  [[nodiscard]] std::vector<std::uint8_t> node_findings() const;
  void choose_clipped(std::span<const std::uint8_t> found);
  void choose_parts(std::span<const std::uint8_t> found);
  void choose_parts_of(std::uint32_t face, std::span<const std::uint8_t> found);
  [[nodiscard]] Tip tip(std::uint32_t face, std::uint32_t node) const;
  void choose_edges();
  void look_closer();
  void add_pieces(std::uint32_t face, std::size_t& next, Tally& tally) const;
  void add_clipped(std::uint32_t face, std::size_t& next, Tally& tally) const;
  void add_slivers(Tally& tally);
  void add_past_contours(Tally& tally);

  /// What was seen of each piece's centroid, and then of nodes on edges.
  [[nodiscard]] std::span<const std::uint8_t> of_points() const {
    return std::span(seen_).subspan(surface_.sites.size());
  }

  /// Model units squared.
  [[nodiscard]] double area_of(std::uint32_t face) const {
    return 0.5 * surface_.twice_areas[face] / (surface_.frame.scale * surface_.frame.scale);
  }

  FaceSamples& samples_;
  const RunContext& run_;
  const FaceSamples::Neighbourhood& known_;
  const Surface& surface_;
  const FacePieces& pieces_;
  const PieceNet& net_;
  Viewpoint local_;
  Look look_;
  Depths depths_;
  SitePicture picture_;
  std::optional<FaceClip> clip_{};         // where faces seen in part are clipped
  std::vector<std::uint32_t> contours_{};  // edges
  std::vector<std::uint32_t> past_{};      // faces seen past them
  // First look: sites, the pieces' centroids and the nodes on edges.
  std::vector<std::uint8_t> at_sites_;  // Look::faces_at_sites()
  std::vector<std::uint8_t> seen_{};
  std::vector<double> site_depths_{};
  double deepest_ = 0.0;  // site that is seen
  // Second look.
  std::vector<Counted> counted_;  // of each face
  CloserLook parts_{};
  EdgePlaces edges_{};
  SeenParts clipped_{};  // of these faces, one after the other
};

}  // namespace vantage
