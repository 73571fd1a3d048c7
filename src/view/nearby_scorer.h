// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/scoring.h"
#include "vantage/view/search.h"
#include "vantage/visibility/vertex_visibility.h"

/// \file
/// Scores of directions in the midst of a few whose visible vertices are known.

namespace vantage {

/// Scores exactly and remembers what was seen. In the midst of such directions, some degrees
/// apart, only the vertices are asked about that some of them see and others do not, some
/// hundredths of all: that costs a tenth of a score and is wrong by what comes and goes between two
/// of them. In the midst of others in their midst fewer are disputed, and so on. For one thread to
/// call, as a search does. [ours, docs/search.md]
class NearbyScorer {
 public:
  /// \param visibility, significance must outlive this; as for ViewScorer.
  NearbyScorer(const VertexVisibility& visibility, std::span<const double> significance,
               const ScoringCamera& camera);
  ~NearbyScorer();

  /// ViewScorer::score_all(), to the bit.
  std::vector<double> score_all(std::span<const Vec3> directions, const RunContext& run);

  /// Scores of directions in the midst of circles, each in the midst of the one before and the
  /// first of each in its middle; of the narrowest that they are not too far out of, or exact ones.
  /// The same for whatever was scored before.
  std::vector<double> score_amid(const Circles& circles, std::span<const Vec3> directions,
                                 const RunContext& run);

  /// Makes ready what score_amid() needs for each of these, side by side.
  void expect(std::span<const Circles> all, const RunContext& run);

 private:
  using Key = std::array<std::uint64_t, 3>;  // the bits of a direction
  using Seen = std::vector<std::uint64_t>;   // one bit a vertex
  struct Midst;

  Seen look(const Vec3& direction, const RunContext& run) const;
  [[nodiscard]] double sum_of(const Seen& seen) const;
  const Seen& seen_from(const Vec3& direction);
  void forget_if_full();
  [[nodiscard]] std::shared_ptr<Midst> known_midst(const Circles& circles) const;
  void remember(std::shared_ptr<Midst> midst);
  std::shared_ptr<Midst> midst_of(const Circles& circles);
  std::vector<const Seen*> seen_from(const std::vector<Vec3>& circle);
  [[nodiscard]] std::shared_ptr<Midst> midst_of_scored(const std::vector<Vec3>& circle,
                                                       std::span<const Seen* const> seen) const;
  [[nodiscard]] std::shared_ptr<Midst> midst_within(std::shared_ptr<Midst> wider,
                                                    const std::vector<Vec3>& circle) const;

  const VertexVisibility& visibility_;
  std::span<const double> significance_;
  ScoringCamera camera_;
  std::map<Key, Seen> remembered_{};
  std::vector<std::shared_ptr<Midst>> midsts_{};
};

}  // namespace vantage
