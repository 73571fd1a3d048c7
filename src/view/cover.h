// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <vector>

#include "vantage/core/run_context.h"
#include "vantage/view/view_set.h"

/// \file
/// Greedy weighted cover: which views together see most. The significance that a set of views sees
/// is monotone and submodular, so that greedy choices reach at least 1 − 1/e of the best choice of
/// as many views (Nemhauser, Wolsey, Fisher, "An analysis of approximations for maximizing
/// submodular set functions", 1978).

namespace vantage {

/// Picks views one by one, each the one that newly sees most; of equals the lowest index.
/// Lazy (Minoux, "Accelerated greedy algorithms", 1978): a view's gain never grows, so that an old
/// gain is a bound, and only views whose bound comes out on top are looked at again. Sums run in
/// vertex order, where rounding is monotone, so the picks are exactly those of a greedy choice that
/// looks at all views every time.
class GreedyCover {
 public:
  /// No view.
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// A view and what it sees beyond what was seen.
  struct Pick {
    std::uint32_t view = kNone;  ///< Index, or kNone if no allowed view gains anything.
    double gain = 0.0;           ///< Sum of the newly seen weights.
  };

  /// Nothing is seen yet. Holds a reference to `sets`.
  /// \param weights |V| finite values ≥ 0. \throw InvalidInput, Cancelled
  GreedyCover(const VisibleSets& sets, std::span<const double> weights, const RunContext& run = {});

  /// The view of largest gain that `allowed` accepts, or none where no view adds anything. A view once
  /// refused is never asked again; one once offered is offered again as long as it would add something.
  Pick next(const std::function<bool(std::uint32_t view)>& allowed);

  /// Sum of the weights that a row of bits sees and nothing before has.
  [[nodiscard]] double gain(std::span<const std::uint64_t> row) const;

  /// Marks a row of bits as seen.
  void mark_seen(std::span<const std::uint64_t> row);

  /// gain() of every view, in parallel. \throw Cancelled
  [[nodiscard]] std::vector<double> gains(const RunContext& run = {}) const;

 private:
  struct Bound {
    double gain;
    std::uint32_t view;

    bool operator<(const Bound& other) const {  // the queue's top is the largest gain, lowest index
      return gain < other.gain || (gain == other.gain && view > other.view);
    }
  };

  const VisibleSets* sets_;
  std::vector<double> weights_;
  std::vector<std::uint64_t> unseen_;
  std::priority_queue<Bound> queue_{};
};

/// A bound on all sets of views, from one state of a greedy choice: whatever k views are added to
/// `seen`, they gain no more than the k largest gains. Minimised over states.
class CoverBound {
 public:
  /// Takes the state in which `seen` is covered and the views would gain `gains`.
  void add_state(double seen, std::vector<double> gains);

  /// No set of `count` views covers more than this; infinity before the first state.
  [[nodiscard]] double most_covered(std::size_t count) const;

  /// Every set of views that covers `wanted` has at least this many; 0 before the first state.
  [[nodiscard]] std::size_t least_views(double wanted) const;

 private:
  std::vector<std::vector<double>> covered_by_{};  ///< For each state: by 0, 1, 2, … further views.
};

}  // namespace vantage
