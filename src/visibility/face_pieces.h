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
  /// Parts a side of a piece that is looked at closely: so many where a surface has kFewFaces
  /// faces, and in the inverse proportion to the root of their number, as of many faces each weighs
  /// little. At least, at most. [ours: docs/visibility.md]
  static constexpr double kCloser = 4.0, kLeastParts = 2.0, kMostParts = 5.0;
  static constexpr double kFewFaces = 1e4;
  /// Longest side of a plain face over the side wanted: 1 up to this number of faces, then as its
  /// root, at most. [ours: docs/visibility.md]
  static constexpr double kManyFaces = 2e4, kLongestPlain = 2.0;

  std::vector<std::uint8_t> parts{};           ///< A side of each piece, 1 to kMostParts.
  std::vector<std::uint8_t> is_plain{};        ///< 1 for each face without a long side.
  std::vector<std::array<Vec3, 3>> corners{};  ///< Of the pieces of faces that were cut, in order.
  std::vector<Triangle> nodes{};               ///< Of the same.
  std::vector<std::uint32_t> first_cut{};      ///< Where those of each face begin.
  std::size_t node_count = 0;

  /// Centroids of all pieces and then the nodes on edges, to be asked about.
  std::vector<Vec3> places{};
  FloatPoints rounded{};
  std::vector<std::uint32_t> owner{};  ///< A face that each lies on.
  std::vector<std::uint32_t> also{};   ///< Another face of each node on an edge, or the same.
  std::vector<std::array<std::uint32_t, 2>> ends{};  ///< Of that edge: sites.
};

/// \pre pieces = cut_faces(surface, …).
PieceNet piece_net(const Surface& surface, const FacePieces& pieces);

}  // namespace vantage
