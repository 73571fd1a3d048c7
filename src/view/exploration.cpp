// SPDX-License-Identifier: MIT
#include <algorithm>

#include "vantage/core/error.h"
#include "vantage/view/channel.h"

#include "view/channel_check.h"
#include "view/entropy_of_new.h"

namespace vantage {
namespace {

constexpr std::uint32_t kUnreached = ~std::uint32_t{0};

/// Where an exploration stands and what it has seen.
class Explorer {
 public:
  Explorer(const ViewChannel& channel, const IndexLists& next)
      : channel_(&channel), next_(&next), dropped_(channel.face_count, 0) {
    weight_.assign(channel.face_count, 0.0);
    for (const auto& view : channel.views) {
      double sum = 0.0;
      for (const FaceArea& a : view) {
        sum += a.area;
        weight_[a.face] += a.area;
      }
      seen_.push_back(sum);
      total_ += sum;
    }
  }

  [[nodiscard]] double coverage() const { return total_ > 0.0 ? covered_ / total_ : 1.0; }

  /// Drops what a view sees.
  void visit(std::uint32_t view) {
    for (const FaceArea& a : channel_->views[view]) {
      covered_ += dropped_[a.face] == 0 ? weight_[a.face] : 0.0;
      dropped_[a.face] = 1;
    }
  }

  /// The way to the nearest views that show something new, to that of greatest entropy among them;
  /// empty if there is none.
  [[nodiscard]] std::vector<std::uint32_t> way_from(std::uint32_t here) const {
    std::vector<std::uint32_t> from(channel_->views.size(), kUnreached);
    from[here] = here;
    std::vector<std::uint32_t> ring{here};
    while (!ring.empty()) {
      std::vector<std::uint32_t> farther;
      std::uint32_t best = kUnreached;
      double most = 0.0;
      for (const std::uint32_t view : ring) {
        for (const std::uint32_t beside : (*next_)[view]) {
          if (from[beside] == kUnreached) {
            from[beside] = view;
            farther.push_back(beside);
            const double entropy = entropy_of_new(channel_->views[beside], seen_[beside], dropped_);
            const bool is_better = entropy > most || (entropy == most && beside < best);
            best = entropy > 0.0 && is_better ? beside : best;
            most = std::max(most, entropy);
          }
        }
      }
      if (best != kUnreached) {
        std::vector<std::uint32_t> way;
        for (std::uint32_t at = best; at != here; at = from[at]) {
          way.push_back(at);
        }
        std::reverse(way.begin(), way.end());
        return way;
      }
      ring = std::move(farther);
    }
    return {};
  }

 private:
  const ViewChannel* channel_;
  const IndexLists* next_;
  std::vector<std::uint8_t> dropped_;  // faces that were seen
  std::vector<double> weight_{};       // of each face, its areas in all views
  std::vector<double> seen_{};         // by each view
  double total_ = 0.0;
  double covered_ = 0.0;
};

void check(const ViewChannel& channel, const IndexLists& next, std::uint32_t start,
           double coverage) {
  if (next.size() != channel.views.size() || start >= channel.views.size()) {
    throw InvalidInput(
        "an exploration needs the neighbours of each view, and a view to start from");
  }
  if (!(coverage >= 0.0 && coverage <= 1.0)) {
    throw InvalidInput("an exploration's coverage must be in [0, 1]");
  }
  check_channel(channel);
}

}  // namespace

Exploration explore_by_entropy(const ViewChannel& channel, const IndexLists& next,
                               std::uint32_t start, double coverage, const RunContext& run) {
  check(channel, next, start, coverage);
  Explorer explorer(channel, next);
  Exploration way{{start}, 0.0};
  explorer.visit(start);
  while (explorer.coverage() < coverage) {
    run.check();
    const std::vector<std::uint32_t> onwards = explorer.way_from(way.views.back());
    if (onwards.empty()) {
      break;
    }
    for (const std::uint32_t view : onwards) {
      explorer.visit(view);
      way.views.push_back(view);
    }
  }
  way.coverage = std::min(1.0, explorer.coverage());
  return way;
}

}  // namespace vantage
