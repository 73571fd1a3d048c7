// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// Small regression trees that add up to the log of a candidate's odds: gradient boosting
/// (Friedman 2001) of the softmax over the candidates (as in ListNet, Cao et al. 2007).
class CandidateModel {
 public:
  /// Reads the lines of `table` that begin with `subject`: "up witness X", "up threshold X", "up share X",
  /// "up tree NAME LIMIT BELOW ABOVE", where BELOW and ABOVE are numbers or trees again, and NAME is
  /// a feature, or FEATURE-opposite (less the opposite candidate's) or FEATURE-mean (less the mean).
  /// \throw InvalidInput naming the line.
  CandidateModel(std::string_view table, std::string_view subject,
                 std::span<const std::string_view> features);

  /// Log odds of each candidate, up to a constant.
  /// \param values of each candidate, one a feature; candidates 2 i and 2 i + 1 are opposite.
  [[nodiscard]] std::vector<double> scores(const std::vector<std::vector<double>>& values) const;

  double witness = 0.0;    ///< Added to the score of the convention's candidate. [fitted]
  double threshold = 1.0;  ///< Probability from which another candidate is taken. [fitted]
  double share = 0.25;     ///< Of files upright by their convention, those that face as it says.

 private:
  struct Node {
    std::size_t column = 0;  ///< Into the features, then those less the opposite, less the mean.
    double limit = 0.0;      ///< Below: next node; else node `above`.
    std::size_t above = 0;   ///< 0: a leaf, worth `limit`.
  };

  std::vector<Node> nodes_{};         ///< In preorder.
  std::vector<std::size_t> roots_{};  ///< One a tree.

  friend class TreeReader;
};

}  // namespace vantage
