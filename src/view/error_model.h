// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/core/vec3.h"

/// \file
/// How wrong estimates of a score are, learnt from the few places where the score is known.

namespace vantage {

/// Gaussian process regression on the sphere (kriging): score − estimate is taken for an unknown
/// constant, plus something that changes over some degrees of direction, plus noise of its own at
/// each direction. Each score that becomes known corrects the estimates around it. Exact sequential
/// updates; O(candidates · known scores) a score.
class ErrorModel {
 public:
  /// Adds a direction whose score may be asked for. Returns its index.
  std::size_t add(const Vec3& direction, double estimate);

  /// The score of a candidate became known.
  void learn(std::size_t candidate, double score);

  [[nodiscard]] std::size_t size() const { return directions_.size(); }

  [[nodiscard]] const Vec3& direction(std::size_t candidate) const {
    return directions_[candidate];
  }

  /// What the score is now thought to be; the score itself where it is known.
  [[nodiscard]] double expected(std::size_t candidate) const;

  /// By how much the score may differ from that (one standard deviation); 0 where it is known.
  [[nodiscard]] double doubt(std::size_t candidate) const;

  /// The part of a doubt that no neighbour's score can take away: how rough scores or estimates are.
  [[nodiscard]] double noise() const;

  [[nodiscard]] bool knows(std::size_t candidate) const { return known_[candidate] != 0; }

 private:
  [[nodiscard]] double weight_of(std::size_t row, std::size_t candidate) const;

  std::vector<Vec3> directions_{};
  std::vector<double> estimates_{};
  std::vector<std::uint8_t> known_{};
  std::vector<double> scores_{};
  std::vector<double> error_{};     // expected score − estimate
  std::vector<double> variance_{};  // of that, over the scale of the process
  // One row a known score: its candidate, and the candidates' covariances with what it taught.
  std::vector<std::size_t> taught_{};
  std::vector<double> spread_{};
  std::vector<std::vector<double>> rows_{};
  std::vector<double> lessons_{};
  double surprise_ = 0.0;  // sum of squared lessons, but for the first
  double scale_ = 0.0;     // of the process: their mean, or the largest that it has been
};

}  // namespace vantage
