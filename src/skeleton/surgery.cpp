// SPDX-License-Identifier: MIT
#include "skeleton/surgery.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

namespace vantage {
namespace {

/// Collapses between two looks at the stop token.
constexpr std::size_t kPoll = 4096;
/// Entries of the queue for each edge; of more, those that newer ones replaced are dropped.
constexpr std::size_t kMostQueued = 8;
/// A cluster of more than kLargestRing neighbours queues its edges anew only after it has taken in one
/// kRingShare-th of that many vertices: until then they keep the costs they had, which are looked at again
/// when their turn comes. At every collapse, thousands of neighbours would take hours.
constexpr std::size_t kLargestRing = 1000;
constexpr std::size_t kRingShare = 16;
/// Where this many local refinements do not free the way, more will not (on real models a few
/// does, or none).
constexpr std::size_t kMostRefinements = 256;

struct Candidate {
  std::uint32_t cost;  ///< In steps of PlaceOrder, as are places.
  std::uint32_t place;
  std::uint32_t edge;
  std::uint32_t version;

  /// Order of a min-heap: by cost, then by place, then by edge.
  bool operator<(const Candidate& other) const {
    return std::tie(other.cost, other.place, other.edge) < std::tie(cost, place, edge);
  }
};

/// Length of the edge, or half the longest loop that its collapse would pinch if that is more.
double collapse_cost(const ClusterComplex& complex, std::uint32_t edge) {
  const double length = complex.length(edge);
  const auto [a, b] = complex.ends(edge);
  double cost = length;
  for (const std::uint32_t c : complex.pinched_by(edge)) {
    const double around = length + (complex.position(c) - complex.position(a)).norm() +
                          (complex.position(c) - complex.position(b)).norm();
    cost = std::max(cost, 0.5 * around);
  }
  return cost;
}

/// What is to be collapsed next.
struct NextEdge {
  std::uint32_t edge;
  bool is_refused;  ///< By the guard, as all that are left.
};

/// The queue of edges that still belong to triangles.
class CollapseQueue {
 public:
  explicit CollapseQueue(ClusterComplex& complex)
      : complex_(complex), version_(complex.edge_count(), 0), moves_(complex.cluster_count(), 0) {
    refill();
  }

  /// The cheapest edge that the guard allows; where it refuses all, the cheapest of those.
  /// \pre there are triangles. \throw Cancelled
  NextEdge next(const RunContext& run) {
    for (;;) {
      while (const std::optional<Candidate> top = pop()) {
        if (complex_.keeps_handles(top->edge)) {
          return {top->edge, false};
        }
        set_aside(*top);
      }
      run.check();
      if (complex_.dead_loops() == dead_loops_) {
        if (const std::optional<Candidate> top = pop_aside()) {
          return {top->edge, !complex_.keeps_handles(top->edge)};
        }
      }
      // Look again at what the loops that died allow.
      dead_loops_ = complex_.dead_loops();
      refill();
    }
  }

  /// Queues edges that splitting made, and what was set aside next to them.
  void push_new_edges() {
    const std::size_t first = known_;
    known_ = complex_.edge_count();
    version_.resize(known_, 0);
    is_aside_.resize(known_, false);
    for (std::size_t e = first; e < known_; ++e) {
      is_aside_[e] = false;
      push(static_cast<std::uint32_t>(e));
    }
    if (!aside_.empty()) {
      for (std::size_t e = first; e < known_; ++e) {
        for (const std::uint32_t end : complex_.ends(static_cast<std::uint32_t>(e))) {
          look_again_around(end);
        }
      }
    }
  }

  /// Queues the edges of a cluster anew after it moved.
  void refresh(std::uint32_t cluster) {
    if (!aside_.empty()) {
      look_again_around(cluster);
    }
    moves_.resize(complex_.cluster_count(), 0);
    const auto& links = complex_.links(cluster);
    if (links.size() > kLargestRing && kRingShare * ++moves_[cluster] < links.size()) {
      return;
    }
    moves_[cluster] = 0;
    for (const auto& link : links) {
      ++version_[link.edge];
      push(link.edge);
    }
  }

 private:
  void refill() {
    heap_.clear();
    aside_.clear();
    known_ = 0;
    push_new_edges();
  }

  /// Cheapest edge to collapse, if any is left.
  std::optional<Candidate> pop() {
    while (!heap_.empty()) {
      const Candidate top = heap_.front();
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
      if (top.version != version_[top.edge] || !collapsible(top.edge)) {
        continue;
      }
      // Collapses next door may have created a loop to pinch since this was queued.
      const std::uint32_t cost = complex_.order().steps(collapse_cost(complex_, top.edge));
      if (cost <= top.cost) {
        return top;
      }
      add({cost, top.place, top.edge, top.version});
    }
    return std::nullopt;
  }

  /// Keeps an edge until something around it changes.
  void set_aside(const Candidate& candidate) {
    is_aside_[candidate.edge] = true;
    aside_.push_back(candidate);
    std::push_heap(aside_.begin(), aside_.end());
  }

  /// The cheapest edge that was set aside, if there is one.
  std::optional<Candidate> pop_aside() {
    while (!aside_.empty()) {
      const Candidate top = aside_.front();
      std::pop_heap(aside_.begin(), aside_.end());
      aside_.pop_back();
      if (is_aside_[top.edge] && top.version == version_[top.edge] && collapsible(top.edge)) {
        is_aside_[top.edge] = false;
        return top;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool collapsible(std::uint32_t edge) const {
    return complex_.edge_is_live(edge) && complex_.faces_at(edge) > 0;
  }

  /// Queues what was set aside of the edges at a cluster and between its neighbours.
  void look_again_around(std::uint32_t cluster) {
    next_to_.clear();
    for (const auto& link : complex_.links(cluster)) {
      next_to_.push_back(link.cluster);  // ascending
      look_again(link.edge);
    }
    for (const std::uint32_t neighbour : next_to_) {
      for (const auto& link : complex_.links(neighbour)) {
        if (is_aside_[link.edge] &&
            std::binary_search(next_to_.begin(), next_to_.end(), link.cluster)) {
          look_again(link.edge);
        }
      }
    }
  }

  void look_again(std::uint32_t edge) {
    if (is_aside_[edge]) {
      is_aside_[edge] = false;
      ++version_[edge];
      push(edge);
    }
  }

  void push(std::uint32_t edge) {
    if (collapsible(edge)) {
      const auto [a, b] = complex_.ends(edge);
      add({complex_.order().steps(collapse_cost(complex_, edge)),
           complex_.order().place(complex_.position(a), complex_.position(b)), edge,
           version_[edge]});
    }
  }

  void add(const Candidate& candidate) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
    // A cluster of thousands of neighbours queues them all anew whenever it takes one in.
    if (heap_.size() > kMostQueued * version_.size()) {
      std::erase_if(heap_, [this](const Candidate& c) { return c.version != version_[c.edge]; });
      std::make_heap(heap_.begin(), heap_.end());
    }
  }

  ClusterComplex& complex_;
  std::vector<std::uint32_t> version_;
  std::vector<std::uint32_t> moves_;  ///< Of each cluster since its edges were queued.
  std::vector<Candidate> heap_{};
  std::size_t known_ = 0;           ///< Edges that were queued once.
  std::size_t dead_loops_ = 0;      ///< When all edges were looked at.
  std::vector<Candidate> aside_{};  ///< A heap of what the guard refused.
  std::vector<bool> is_aside_{};    ///< Of each edge.
  std::vector<std::uint32_t> next_to_{};
};

}  // namespace

std::size_t collapse_to_graph(ClusterComplex& complex, const RunContext& run,
                              std::size_t given_up_at) {
  CollapseQueue queue(complex);
  const auto all_faces = static_cast<double>(std::max<std::size_t>(1, complex.face_count()));
  std::size_t refined = 0;
  std::size_t forced = 0;
  std::size_t collapsed = 0;
  double done = 0.0;
  while (complex.face_count() > 0) {
    const auto [edge, is_refused] = queue.next(run);
    if (is_refused && refined < kMostRefinements) {
      complex.make_room(edge);
      queue.push_new_edges();
      ++refined;
    } else if (is_refused && ++forced == given_up_at) {
      return forced;
    }
    queue.refresh(complex.collapse(edge));
    if (++collapsed % kPoll == 0) {
      done = std::max(done, 1.0 - static_cast<double>(complex.face_count()) / all_faces);
      run.advance("skeleton", done);  // make_room() adds faces
    }
  }
  return forced;
}

}  // namespace vantage
