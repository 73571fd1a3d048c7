// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/scoring.h"
#include "vantage/visibility/face_visibility.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// What each of many views sees, one bit a vertex.

namespace vantage {

/// A table of bits: row i tells which vertices view i sees.
class VisibleSets {
 public:
  /// All bits clear. Takes view_count · vertex_count / 8 bytes.
  VisibleSets(std::size_t view_count, std::size_t vertex_count)
      : views_(view_count),
        vertices_(vertex_count),
        words_((vertex_count + 63) / 64),
        bits_(view_count * words_, 0) {}

  [[nodiscard]] std::size_t view_count() const { return views_; }  ///< Rows.

  [[nodiscard]] std::size_t vertex_count() const { return vertices_; }  ///< Bits in a row.

  /// Replaces the row of a view; different rows may be set on different threads.
  /// \param visible |V| values, 0 for unseen. \throw InvalidInput if that is not the size.
  void set(std::size_t view, std::span<const std::uint8_t> visible);

  /// Whether a view sees a vertex.
  [[nodiscard]] bool sees(std::size_t view, std::size_t vertex) const {
    return ((row(view)[vertex / 64] >> (vertex % 64)) & 1U) != 0;
  }

  /// Bits of a view, 64 to a word, the first vertex lowest; bits beyond |V| are 0.
  [[nodiscard]] std::span<const std::uint64_t> row(std::size_t view) const {
    return {bits_.data() + view * words_, words_};
  }

 private:
  std::size_t views_;
  std::size_t vertices_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

/// What the scoring camera sees from each direction, in parallel over directions.
/// \param vertex_count |V| of the surface that `visibility` was made of. \throw Cancelled
VisibleSets visible_sets(const VertexVisibility& visibility, const ScoringCamera& camera,
                         std::span<const Vec3> directions, std::size_t vertex_count,
                         const RunContext& run = {});

/// By area a face has so many bits: as many of the first are set as eighths of it are seen, so that
/// several views together see of it what the one does that sees most.
inline constexpr std::size_t kBitsAFace = 8;

/// The same with kBitsAFace bits a face in place of one a vertex. \throw Cancelled
VisibleSets visible_sets(const FaceVisibility& faces, const ScoringCamera& camera,
                         std::span<const Vec3> directions, const RunContext& run = {});

}  // namespace vantage
