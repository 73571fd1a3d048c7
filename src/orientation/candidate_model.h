// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orientation/evidence.h"

namespace vantage {

/// Small regression trees that add up to the log of a candidate's odds: gradient boosting
/// (Friedman 2001) of the softmax over the candidates (as in ListNet, Cao et al. 2007).
class CandidateModel {
 public:
  /// Reads the lines of `table` that begin with `subject`: "up convention_log_odds X", "up threshold X", "up share X",
  /// "up tree NAME LIMIT BELOW ABOVE", where BELOW and ABOVE are numbers or trees again, and NAME is
  /// a feature, or FEATURE-opposite (less the opposite candidate's) or FEATURE-mean (less the mean).
  /// \throw InvalidInput naming the line.
  CandidateModel(std::string_view table, std::string_view subject);

  /// Log odds of each candidate, up to a constant.
  /// \param candidates one or more; 2 i and 2 i + 1 are opposite.
  /// \throw InvalidInput naming a feature of the table that a candidate does not have.
  [[nodiscard]] std::vector<double> scores(const std::vector<Evidence>& candidates) const;

  double convention_log_odds = 0.0;  ///< Added to the score of the convention's candidate. [fitted]
  double threshold = 1.0;  ///< Probability from which another candidate is taken. [fitted]
  double share = 0.25;     ///< Of files upright by their convention, those that face as it says.

 private:
  enum class Less : std::uint8_t { Nothing, Opposite, Mean };

  /// What a node looks at.
  struct Term {
    std::string feature{};
    Less less = Less::Nothing;

    friend bool operator==(const Term&, const Term&) = default;
  };

  struct Node {
    std::size_t term = 0;
    double limit = 0.0;     ///< Below: next node; else node `above`.
    std::size_t above = 0;  ///< 0: a leaf, worth `limit`.
  };

  [[nodiscard]] std::size_t place_of(Term term);
  /// Its value for each candidate.
  static std::vector<double> values_of(const Term& term, const std::vector<Evidence>& candidates);

  std::vector<Term> terms_{};         ///< Each once.
  std::vector<Node> nodes_{};         ///< In preorder.
  std::vector<std::size_t> roots_{};  ///< One a tree.

  friend class TreeReader;
};

}  // namespace vantage
