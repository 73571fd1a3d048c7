// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"

/// \file
/// Pieces of faces that may be seen in part, divided into parts that are each judged by one place.

namespace vantage {

/// What is known of the tip of a piece, next to a corner of its face.
enum class Tip : std::uint8_t {
  Plain,  ///< Nothing: it is judged with the part that it is of.
  Seen,   ///< It is seen: so is the corner, where all faces turn to the eye.
  Asked,  ///< The corner is seen, but other faces at it may hide the tip.
  Hidden  ///< As the corner is.
};

/// The parts of such pieces, and what is seen of each.
struct CloserLook {
  std::vector<std::uint32_t> pieces{};  ///< Ascending, and after end() one beyond all.
  std::vector<std::uint32_t> first{};   ///< Part of each, and after end() one past the last part.
  std::vector<Vec3> places{};           ///< Where each part is judged.
  std::vector<double> shares{};         ///< Of each part in its piece's area; hidden tips are none.
  std::vector<std::uint32_t> owner{};   ///< The face each part is of.
  std::vector<std::uint8_t> asked{};    ///< 0 for parts that are known to be seen.
  std::vector<std::uint8_t> seen{};     ///< Of each part; for others to fill in.

  /// Divides a piece into squared `parts` alike, and takes tips apart: what is seen of a face often
  /// ends at a corner. \param tips of each corner.
  void add(std::uint32_t piece, std::uint32_t face, const std::array<Vec3, 3>& corners,
           const std::array<Tip, 3>& tips, int parts);

  /// Ends the list.
  void end();

 private:
  void add_part(const Vec3& place, double share, bool is_asked);
};

}  // namespace vantage
