// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/mesh/topology.h"
#include "vantage/mesh/tri_mesh.h"

/// \file
/// Keeps connectivity surgery from losing handles. Every edge of a closed surface carries its
/// values under a basis of first cohomology over Z₂ (an "annotation"), so that the homology class
/// of a loop is the sum over its edges. Pinching a tube kills the class of the loop around it. Loops
/// that cross each other an odd number of times must not both be killed: then exactly g of the 2g
/// classes of a genus-g surface die, and the graph keeps g cycles. docs/skeleton.md has the proof.

namespace vantage {

/// A vector over Z₂, 64 coordinates a word.
using Bits = std::vector<std::uint64_t>;

/// Annotations, intersection form and dead classes of the closed components of a mesh.
class HandleGuard {
 public:
  /// Annotates the edges of `table`. Components that are not closed surfaces get no coordinates
  /// and are not guarded; nor is anything when the handles are too many to keep (see kMostBits).
  HandleGuard(const TriMesh& mesh, const EdgeTable& table);

  /// Words per annotation; 0 if there is no handle to guard.
  [[nodiscard]] std::size_t words() const { return words_; }

  /// Annotation of each edge of the table, words() words each.
  [[nodiscard]] const std::vector<std::uint64_t>& annotations() const { return annotation_; }

  /// Brings a class to its normal form modulo the dead ones; zero if it is dead.
  void reduce(Bits& loop) const;

  /// Whether all these classes, each in normal form, may die together with the dead ones.
  [[nodiscard]] bool may_kill(const std::vector<Bits>& loops) const;

  /// Independent classes that are dead.
  [[nodiscard]] std::size_t dead_count() const { return dead_.size(); }

  /// Marks a class as dead.
  void kill(Bits loop);

 private:
  /// The coordinates of loops that cross this one an odd number of times.
  [[nodiscard]] Bits crossed_by(const Bits& loop) const;

  std::size_t words_ = 0;
  std::vector<std::uint64_t> annotation_{};
  std::vector<Bits> crossings_{};     ///< Row i: bit j = parity of crossings of generators i and j.
  std::vector<Bits> dead_{};          ///< Echelon basis of the dead classes.
  std::vector<std::size_t> leads_{};  ///< The highest coordinate that is set, of each of them.
  std::vector<Bits> crossed_by_dead_{};  ///< Of classes that span them: see crossed_by().
};

}  // namespace vantage
