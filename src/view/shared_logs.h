// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/view/channel.h"

/// \file
/// What divergences between sparse lists of areas are made of. A model's views and faces are
/// compared some two hundred million times, so this is done several at a time.

namespace vantage {

/// Σ a log a, to base 2. \pre areas are above 0.
double sum_of_logs(std::span<const FaceArea> list);

/// A sparse list of areas with the sums that divergences from others need.
struct SummedAreas {
  std::span<const FaceArea> list{};
  double area = 0.0;
  double logs = 0.0;   ///< Σ a log a
  double scale = 1.0;  ///< What the areas of the list count times; `area` and `logs` are scaled.
};

/// A list of areas laid out by place, to compare many others with.
class LaidOutAreas {
 public:
  /// \param places all lists name places below this.
  explicit LaidOutAreas(std::size_t places) : cells_(places) {}

  /// Lays out a list in place of the one before. \pre the list outlives its use here.
  void put(std::span<const FaceArea> list);

  /// Σ over the places of another list, which has b there and this one a or 0, of
  /// (a + b) log (a + b) − a log a. \param scale what its areas count times.
  [[nodiscard]] double logs_with(std::span<const FaceArea> other, double scale = 1.0) const;

 private:
  struct Cell {
    double area = 0.0;
    double log = 0.0;  // area log area
  };

  std::vector<Cell> cells_;
  std::span<const FaceArea> list_{};
};

/// Weighted Jensen–Shannon divergence of two distributions a/A and b/B with weights A/(A+B) and
/// B/(A+B): ((A+B) log (A+B) − A log A − B log B − Σ ((a+b) log (a+b) − a log a − b log b)) /
/// (A+B); 0 if A or B is. \param laid_out the list of `a`.
double divergence_of(const SummedAreas& a, const LaidOutAreas& laid_out, const SummedAreas& b);

}  // namespace vantage
