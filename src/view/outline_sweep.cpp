// SPDX-License-Identifier: MIT
#include "view/outline_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "view/chains.h"

namespace vantage {
namespace {

constexpr std::uint32_t kNoNeighbour = kNoSide;

/// A stretch of one chain that bounds the shape: down where the shape is on its right, else up.
struct Stretch {
  PicturePoint low = PicturePoint::Zero();
  PicturePoint high = PicturePoint::Zero();
  std::uint32_t side = kNoNeighbour;  // that `low` is on
  std::uint32_t next = kNoNeighbour;
  bool is_left = false;  // of the shape
};

/// What bounds the shape along a line across: chains from left to right, by turns its left and its
/// right, with their open stretches.
struct Bound {
  std::uint32_t chain = 0;
  std::uint32_t side = 0;  // of the chain, at the line or below it
  std::uint32_t stretch = kNoNeighbour;
};

/// Cuts the plane into slabs in which nothing begins, ends or crosses, so that the shape is a row
/// of intervals in each; then joins what bounds them. On the line between two slabs the shape may
/// differ only between the first and the second, the third and the fourth … of all ends there,
/// which tells what to join however near to each other they are.
class Sweep {
 public:
  explicit Sweep(const std::vector<LayerEdge>& edges) : sides_(rising_sides(edges)) {}

  Outline run() {
    std::vector<double> lines;
    for (const Side& side : sides_) {
      if (side.is_first) {
        lines.push_back(side.low);
      }
      if (side.next == kNoNeighbour) {
        lines.push_back(side.high);
      }
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      active_.drop_ended(lines[i]);
      for (; next < sides_.size() && sides_[next].low <= lines[i]; ++next) {
        if (sides_[next].is_first) {
          active_.insert(static_cast<std::uint32_t>(next));
        }
      }
      slab(lines[i], lines[i + 1]);
    }
    if (!lines.empty()) {
      above_.clear();
      change(lines.back());
    }
    return loops();
  }

 private:
  void slab(double bottom, double top) {
    if (!active_.reach(top)) {
      active_.sort_half_way();
      if (active_.is_crossed(top)) {
        crossed_slab(bottom, top);
        return;
      }
    }
    find_bounds(bottom);
    active_.pass();
  }

  /// A slab in which chains cross. Where that can change the shape it is cut at all corners of
  /// those chains, and again where their sides cross.
  void crossed_slab(double bottom, double top) {
    ranges_ = active_.mattering(top);
    if (ranges_.empty()) {
      find_bounds(bottom);
    } else {
      corners_.assign(1, top);
      for (const ActiveChains::Range& range : ranges_) {
        active_.add_corners(range, top, corners_);
        active_.rewind(range);
      }
      std::sort(corners_.begin(), corners_.end());
      for (const double corner : corners_) {
        if (corner > bottom) {
          straight_slab(bottom, corner);
          bottom = corner;
        }
      }
      active_.reach(top);
    }
    active_.pass();
    active_.sort_at_bottom();
  }

  /// Processes a slab in which every chain whose crossings matter is one straight segment.
  void straight_slab(double bottom, double top) {
    cuts_.assign(1, top);
    for (const ActiveChains::Range& range : ranges_) {
      active_.climb(range, top);
      active_.add_crossings(range, bottom, top, cuts_);
      active_.rewind(range);
    }
    std::sort(cuts_.begin(), cuts_.end());
    for (const double to : cuts_) {
      if (to > bottom) {
        for (const ActiveChains::Range& range : ranges_) {
          active_.climb(range, to);
        }
        find_bounds(bottom);
        for (const ActiveChains::Range& range : ranges_) {
          active_.pass(range);
        }
        bottom = to;
      }
    }
  }

  /// Finds what bounds the shape in the slab that begins at `y`, and what changes there.
  void find_bounds(double y) {
    above_.clear();
    int layers = 0;
    for (const ActiveChains::Chain& chain : active_.chains()) {
      const int after = layers + chain.step;
      if ((layers > 0) != (after > 0)) {
        above_.push_back({chain.first, chain.side, kNoNeighbour});
      }
      layers = after;
    }
    if (above_.size() % 2 != 0) {
      above_.pop_back();  // the chain of edges was not closed
    }
    change(y);
  }

  /// Ends the stretches that go no further than the line at `y`, begins those that start there, and
  /// joins them.
  void change(double y) {
    const auto is_same = [](const Bound& a, const Bound& b) { return a.chain == b.chain; };
    std::size_t first = 0;  // the same ahead
    const std::size_t most = std::min(below_.size(), above_.size());
    while (first < most && is_same(below_[first], above_[first])) {
      above_[first].stretch = below_[first].stretch;
      ++first;
    }
    std::size_t kept = 0;  // and behind
    while (kept + first < most &&
           is_same(below_[below_.size() - 1 - kept], above_[above_.size() - 1 - kept])) {
      above_[above_.size() - 1 - kept].stretch = below_[below_.size() - 1 - kept].stretch;
      ++kept;
    }
    join(y, first, below_.size() - kept, above_.size() - kept);
    below_.swap(above_);
  }

  /// The end of a stretch on the line at hand.
  struct End {
    std::uint32_t stretch = kNoNeighbour;
    bool is_below = false;
    bool is_left = false;  // of the shape

    /// Whether its stretch, followed with the shape on the left, begins here.
    [[nodiscard]] bool begins() const { return is_below == is_left; }
  };

  void join(double y, std::size_t first, std::size_t below_end, std::size_t above_end) {
    std::size_t b = first;
    std::size_t a = first;
    double least = -std::numeric_limits<double>::max();  // of x: rounding must not change the order
    const auto x_of = [&](const Bound& bound) {
      return sides_[active_.side_at(bound.side, y)].at(y);
    };
    End open{};
    bool is_open = false;
    while (b < below_end || a < above_end) {
      bool take_below = a >= above_end;
      if (b < below_end && a < above_end) {
        const double gap = x_of(below_[b]) - x_of(above_[a]);
        take_below = gap != 0.0 ? gap < 0.0 : !(is_open && open.is_below);
      }
      Bound& bound = take_below ? below_[b] : above_[a];
      const bool is_left = (take_below ? b : a) % 2 == 0;
      least = std::max(least, x_of(bound));
      const End end = touch(bound, {least, y}, take_below, is_left);
      ++(take_below ? b : a);
      if (is_open) {
        const End& tail = open.begins() ? end : open;
        stretches_[tail.stretch].next = open.begins() ? open.stretch : end.stretch;
      }
      open = end;
      is_open = !is_open;
    }
  }

  /// Ends or begins the stretch of a chain.
  End touch(Bound& bound, const PicturePoint& place, bool is_below, bool is_left) {
    if (is_below) {
      stretches_[bound.stretch].high = place;
    } else {
      bound.stretch = static_cast<std::uint32_t>(stretches_.size());
      stretches_.push_back({.low = place, .side = bound.side, .is_left = is_left});
    }
    return {bound.stretch, is_below, is_left};
  }

  /// Adds the points of a stretch, with the shape on the left.
  void add_points(const Stretch& stretch, std::vector<PicturePoint>& loop) const {
    const std::size_t begin = loop.size();
    loop.push_back(stretch.low);
    for (std::uint32_t s = stretch.side; s != kNoNeighbour && sides_[s].high < stretch.high.y();
         s = sides_[s].next) {
      loop.emplace_back(sides_[s].x_high, sides_[s].high);
    }
    loop.push_back(stretch.high);
    if (stretch.is_left) {
      std::reverse(loop.begin() + static_cast<std::ptrdiff_t>(begin), loop.end());
    }
  }

  [[nodiscard]] Outline loops() const {
    std::vector<std::uint8_t> used(stretches_.size(), 0);
    Outline outline;
    for (std::uint32_t first = 0; first < stretches_.size(); ++first) {
      std::vector<PicturePoint> loop;
      for (std::uint32_t i = first; i != kNoNeighbour && used[i] == 0; i = stretches_[i].next) {
        used[i] = 1;
        add_points(stretches_[i], loop);
      }
      loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
      if (loop.size() > 2) {
        outline.push_back(std::move(loop));
      }
    }
    return outline;
  }

  std::vector<Side> sides_;
  ActiveChains active_{sides_};
  std::vector<ActiveChains::Range> ranges_{};  // of chains whose crossings matter
  std::vector<double> corners_{};
  std::vector<double> cuts_{};
  std::vector<Bound> below_{};
  std::vector<Bound> above_{};
  std::vector<Stretch> stretches_{};
};

}  // namespace

Outline boundary_of_layers(const std::vector<LayerEdge>& edges) {
  return Sweep(edges).run();
}

}  // namespace vantage
