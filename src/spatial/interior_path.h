// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

#include "spatial/shell.h"

namespace vantage {

/// Finds ways inside a shell. Below each vertex, along its normal, stand three points: in the middle
/// of the wall, nearer to the surface and just below it. A way steps between points of neighbouring
/// vertices: it can follow the surface wherever that goes, and prefers to do so in the middle.
class InteriorPaths {
 public:
  /// Both must outlive the finder.
  InteriorPaths(const TriMesh& mesh, const Shell& shell);

  /// Points to go through on a short way from a to b, without a and b; every step is inside.
  /// \param vertices below which the way may go, all of one component.
  /// \return nothing if there is no such way, or it would take more looks or vertices than are left.
  [[nodiscard]] std::optional<std::vector<Vec3>> find(std::uint32_t component, const Vec3& a,
                                                      const Vec3& b,
                                                      std::span<const std::uint32_t> vertices);

  /// Whether no look is left: nothing will be found.
  [[nodiscard]] bool is_spent() const { return looks_left_ == 0; }

 private:
  /// Steps that may be looked at for one way, and for all ways of a surface [ours]: on parts like
  /// the insides of a car, where hardly any point sees another, each search would look at millions.
  static constexpr std::size_t kMostLooks = 20'000;
  static constexpr std::size_t kMostLooksInAll = 100'000;
  /// Vertices below which ways may be looked for, in all: at a hub each would begin with the whole surface [ours].
  static constexpr std::size_t kMostVerticesInAll = 10'000'000;

  const TriMesh& mesh_;
  const Shell& shell_;
  const IndexLists& neighbours_;
  std::size_t looks_left_ = kMostLooksInAll;
  std::size_t vertices_left_ = kMostVerticesInAll;
  enum class Wall : std::uint8_t { Unknown, None, Known };
  std::vector<Wall> wall_is_{};  ///< Of each vertex: many ways ask for the same walls.
  std::vector<Vec3> wall_{};     ///< Across it, where known.

  [[nodiscard]] const Vec3* wall_at(std::uint32_t vertex);
};

}  // namespace vantage
