// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
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

  /// Annotation of each edge of the table, words() words each. \pre not taken before.
  [[nodiscard]] std::vector<std::uint64_t> take_annotations() { return std::move(annotation_); }

  /// Whether a class may die together with the dead ones and with others.
  /// \param crossed_by_others of each of the others: see crossed_by().
  [[nodiscard]] bool may_kill(const Bits& loop, const std::vector<Bits>& crossed_by_others) const;

  /// The first dead class that a class crosses; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> dead_crossed_by(const Bits& loop) const;

  /// Whether a class crosses the dead one of this index.
  [[nodiscard]] bool crosses_dead(const Bits& loop, std::size_t dead) const;

  /// The coordinates of loops that cross this one an odd number of times.
  [[nodiscard]] Bits crossed_by(const Bits& loop) const;

  /// Independent classes that are dead.
  [[nodiscard]] std::size_t dead_count() const { return crossed_by_dead_.size(); }

  /// Marks a class as dead, and brings annotations to their normal form modulo the dead ones: sums of them are
  /// in normal form, too, and zero where they are dead. \pre `loop` and the annotations are in the normal form
  /// of before.
  void kill(const Bits& loop, std::vector<std::uint64_t>& annotations);

 private:
  std::size_t words_ = 0;
  std::vector<std::uint64_t> annotation_{};
  std::vector<Bits> crossings_{};  ///< Row i: bit j = parity of crossings of generators i and j.
  std::vector<Bits> crossed_by_dead_{};  ///< Of classes that span the dead ones: see crossed_by().
};

/// Whether no coordinate is set.
bool is_zero(const Bits& bits);

}  // namespace vantage
