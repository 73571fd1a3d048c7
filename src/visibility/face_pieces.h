// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vantage/core/vec3.h"
#include "vantage/mesh/tri_mesh.h"

#include "visibility/surface.h"

/// \file
/// The faces of a surface cut into pieces that are each judged by their centroid, and what it takes
/// to look closer at pieces that may be seen in part.

namespace vantage {

/// Pieces of all faces, face by face.
struct FacePieces {
  std::vector<std::uint32_t> first{};  ///< Of each face, and one past the last piece.
  std::vector<std::uint32_t> owner{};  ///< The face each piece is of.
  std::vector<Vec3> places{};          ///< Centroids, in the surface's frame.
  FloatPoints rounded{};               ///< The same, rounded.
  std::vector<Vec3> weights{};         ///< Centroids, barycentric in the corners of the face.
  std::vector<double> areas{};         ///< Model units squared.
  double longest = 0.0;                ///< Largest side wanted, in units of the frame.
};

/// \param longest pieces are cut until no side is longer than this, in units of the frame; those of
///                little area may stay longer.
FacePieces cut_faces(const Surface& surface, double longest);

/// How pieces meet, and how to divide them. *Nodes* are the corners of pieces: the surface's sites
/// first, then what lies on an edge of it (one node for all faces there), then what lies in a face.
struct PieceNet {
  /// Parts a side of a piece that is looked at closely, at most. [ours: docs/visibility.md]
  static constexpr int kCloser = 4;

  std::vector<std::uint8_t> parts{};     ///< A side of each piece, 1 to kCloser.
  std::vector<std::uint8_t> is_small{};  ///< 1 for each piece without a longer side than wanted.
  std::vector<std::array<Vec3, 3>> corners{};  ///< Of the pieces of faces that were cut, in order.
  std::vector<Triangle> nodes{};               ///< Of the same.
  std::size_t node_count = 0;

  /// Centroids of all pieces and then the nodes on edges, to be asked about.
  std::vector<Vec3> places{};
  FloatPoints rounded{};
  std::vector<std::uint32_t> owner{};  ///< A face that each lies on.
  std::vector<std::uint32_t> also{};   ///< Another face of each node on an edge, or the same.
};

/// \pre pieces = cut_faces(surface, …).
PieceNet piece_net(const Surface& surface, const FacePieces& pieces);

}  // namespace vantage
