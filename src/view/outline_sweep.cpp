// SPDX-License-Identifier: MIT
#include "view/outline_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace vantage {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// An edge that is not level, from its lower end to its upper one.
struct Side {
  double low = 0.0, high = 0.0;      // y
  double x_low = 0.0, x_high = 0.0;  // x there
  double slope = 0.0;                // x for each y
  int step = 0;                      // what is added to the layers from its left to its right
  std::uint32_t next = kNone;  // the side that goes on where this one ends, and nothing else there
  bool is_first = true;        // none goes on into this one

  [[nodiscard]] double at(double y) const {
    // Near a level side rounding may reach beyond its end.
    const double x = x_low + (y - low) * slope;
    const double inside = slope > 0.0 ? std::min(x, x_high) : std::max(x, x_high);
    return y < high ? inside : x_high;
  }
};

std::vector<Side> sides_of(const std::vector<LayerEdge>& edges) {
  std::vector<Side> sides;
  sides.reserve(edges.size());
  for (const LayerEdge& edge : edges) {
    const bool falls = edge.from.y() > edge.to.y();
    const PicturePoint& low = falls ? edge.to : edge.from;
    const PicturePoint& high = falls ? edge.from : edge.to;
    // Level edges come back as the ways between what ends and what begins on their line.
    if (low.y() < high.y() && edge.layers != 0) {
      const double slope = (high.x() - low.x()) / (high.y() - low.y());
      sides.push_back({.low = low.y(),
                       .high = high.y(),
                       .x_low = low.x(),
                       .x_high = high.x(),
                       .slope = slope,
                       .step = falls ? edge.layers : -edge.layers});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.low < b.low || (a.low == b.low && a.x_low < b.x_low);
  });
  return sides;
}

/// Joins sides to chains that rise without anything else happening on them. \pre sides as sides_of()
void join_sides(std::vector<Side>& sides) {
  struct End {
    double y = 0.0, x = 0.0;
    std::uint32_t side = 0;
  };

  std::vector<End> ends;
  ends.reserve(sides.size());
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    ends.push_back({sides[i].high, sides[i].x_high, i});
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) {
    return a.y < b.y || (a.y == b.y && (a.x < b.x || (a.x == b.x && a.side < b.side)));
  });
  const auto is_at = [](const Side& side, const End& end) {
    return side.low == end.y && side.x_low == end.x;
  };
  std::size_t begin = 0;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const End& end = ends[e];
    while (begin < sides.size() && (sides[begin].low < end.y ||
                                    (sides[begin].low == end.y && sides[begin].x_low < end.x))) {
      ++begin;
    }
    const auto same = [&](std::size_t k) {
      return k < ends.size() && ends[k].y == end.y && ends[k].x == end.x;
    };
    const bool is_alone = !same(e + 1) && (e == 0 || !same(e - 1)) && begin < sides.size() &&
                          is_at(sides[begin], end) &&
                          (begin + 1 == sides.size() || !is_at(sides[begin + 1], end));
    if (is_alone && sides[begin].step == sides[end.side].step) {
      sides[end.side].next = static_cast<std::uint32_t>(begin);
      sides[begin].is_first = false;
    }
  }
}

/// A chain where it passes the slab at hand.
struct Active {
  std::uint32_t chain = 0;         // its first side
  std::uint32_t side = 0;          // the one that leaves the slab's lower line upwards
  std::uint32_t above = 0;         // the one that leaves its upper line
  double bottom = 0.0, top = 0.0;  // x
  int step = 0;
};

/// A stretch of one chain that bounds the shape: down where the shape is on its right, else up.
struct Stretch {
  PicturePoint low = PicturePoint::Zero();
  PicturePoint high = PicturePoint::Zero();
  std::uint32_t side = kNone;  // that `low` is on
  std::uint32_t next = kNone;
  bool is_left = false;  // of the shape
};

/// What bounds the shape along a line across: chains from left to right, by turns its left and its
/// right, with their open stretches.
struct Bound {
  std::uint32_t chain = 0;
  std::uint32_t side = 0;  // of the chain, at the line or below it
  std::uint32_t stretch = kNone;
};

/// Cuts the plane into slabs in which nothing begins, ends or crosses, so that the shape is a row of
/// intervals in each; then joins what bounds them. On the line between two slabs the shape may differ
/// only between the first and the second, the third and the fourth … of all ends there, which tells
/// what to join however near to each other they are.
class Sweep {
 public:
  explicit Sweep(std::vector<Side> sides) : sides_(std::move(sides)) { join_sides(sides_); }

  Outline run() {
    std::vector<double> lines;
    for (const Side& side : sides_) {
      if (side.is_first) {
        lines.push_back(side.low);
      }
      if (side.next == kNone) {
        lines.push_back(side.high);
      }
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      if (has_ends_) {
        std::erase_if(active_, [&](const Active& a) { return sides_[a.side].high <= lines[i]; });
      }
      for (; next < sides_.size() && sides_[next].low <= lines[i]; ++next) {
        if (sides_[next].is_first) {
          insert(static_cast<std::uint32_t>(next));
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
  /// The side of the chain on which `y` lies, from one below on: of two that meet there the upper.
  [[nodiscard]] std::uint32_t side_at(std::uint32_t side, double y) const {
    while (sides_[side].high <= y && sides_[side].next != kNone) {
      side = sides_[side].next;
    }
    return side;
  }

  /// Puts a chain where it begins among the others.
  void insert(std::uint32_t side) {
    const double x = sides_[side].x_low;
    const auto at =
        std::upper_bound(active_.begin(), active_.end(), x,
                         [](double place, const Active& a) { return place < a.bottom; });
    active_.insert(at, {side, side, side, x, 0.0, sides_[side].step});
  }

  /// Sorts what is active by its places half way up; it nearly is.
  void sort_active() {
    for (std::size_t i = 1; i < active_.size(); ++i) {
      const double place = active_[i].bottom + active_[i].top;
      if (active_[i - 1].bottom + active_[i - 1].top > place) {
        const Active here = active_[i];
        std::size_t k = i;
        for (; k > 0 && active_[k - 1].bottom + active_[k - 1].top > place; --k) {
          active_[k] = active_[k - 1];
        }
        active_[k] = here;
      }
    }
  }

  /// Whether `left` is right of `right` somewhere in the slab that ends at `top`.
  [[nodiscard]] bool crosses(const Active& left, const Active& right, double top) const {
    if (left.bottom > right.bottom || left.top > right.top) {
      return true;
    }
    if (left.side == left.above && right.side == right.above) {
      return false;
    }
    std::uint32_t a = left.side;
    std::uint32_t b = right.side;
    for (double y = std::min(sides_[a].high, sides_[b].high); y < top;
         y = std::min(sides_[a].high, sides_[b].high)) {
      if (sides_[a].at(y) > sides_[b].at(y)) {
        return true;
      }
      a = side_at(a, y);
      b = side_at(b, y);
    }
    return false;
  }

  void slab(double bottom, double top) {
    bool is_crossed = false;
    if (!reach(top)) {
      sort_active();
      for (std::size_t i = 1; i < active_.size() && !is_crossed; ++i) {
        is_crossed = crosses(active_[i - 1], active_[i], top);
      }
    }
    if (is_crossed) {
      slabs_between_corners(bottom, top);
    } else {
      intervals(bottom);
    }
  }

  /// Finds where the chains pass the upper line of a slab. \return whether each is on the left of the
  /// next everywhere in the slab.
  bool reach(double top) {
    bool is_ordered = true;
    has_ends_ = false;
    for (std::size_t i = 0; i < active_.size(); ++i) {
      Active& a = active_[i];
      a.above = side_at(a.side, top);
      const Side& side = sides_[a.above];
      a.top = side.at(top);
      has_ends_ = has_ends_ || side.high <= top;
      is_ordered = is_ordered && (i == 0 || !crosses(active_[i - 1], a, top));
    }
    return is_ordered;
  }

  /// A slab in which chains cross: cut at all corners of chains, and again where sides cross.
  void slabs_between_corners(double bottom, double top) {
    std::vector<double> corners;
    for (const Active& a : active_) {
      for (std::uint32_t s = a.side; sides_[s].high < top; s = sides_[s].next) {
        corners.push_back(sides_[s].high);
      }
    }
    corners.push_back(top);
    std::sort(corners.begin(), corners.end());
    for (const double corner : corners) {
      if (corner > bottom) {
        straight_slab(bottom, corner);
        bottom = corner;
      }
    }
  }

  /// A slab of straight sides.
  void straight_slab(double bottom, double top) {
    cuts_.clear();
    reach(top);
    sort_active();
    find_crossings(&Active::bottom, bottom, top);
    find_crossings(&Active::top, bottom, top);
    cuts_.push_back(top);
    std::sort(cuts_.begin(), cuts_.end());
    for (const double to : cuts_) {
      if (to > bottom) {
        reach(to);
        sort_active();
        intervals(bottom);
        bottom = to;
      }
    }
  }

  /// Where sides cross whose order half way up is not that at one end.
  void find_crossings(double Active::*place, double bottom, double top) {
    order_ = active_;
    for (std::size_t i = 1; i < order_.size(); ++i) {
      const Active here = order_[i];
      std::size_t k = i;
      for (; k > 0 && order_[k - 1].*place > here.*place; --k) {
        const Active& other = order_[k - 1];
        const double before = std::abs(other.bottom - here.bottom);
        const double after = std::abs(other.top - here.top);
        if (before + after > 0.0) {
          const double y = bottom + (top - bottom) * before / (before + after);
          if (y > bottom && y < top) {
            cuts_.push_back(y);
          }
        }
        order_[k] = other;
      }
      order_[k] = here;
    }
  }

  /// Finds what bounds the shape in the slab that begins at `y`, and what changes there; then makes the
  /// slab's upper line the lower one of the next.
  void intervals(double y) {
    above_.clear();
    int layers = 0;
    for (Active& a : active_) {
      const int after = layers + a.step;
      if ((layers > 0) != (after > 0)) {
        above_.push_back({a.chain, a.side, kNone});
      }
      layers = after;
      a.side = a.above;
      a.bottom = a.top;
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
    std::uint32_t stretch = kNone;
    bool is_below = false;
    bool is_left = false;  // of the shape

    /// Whether its stretch, followed with the shape on the left, begins here.
    [[nodiscard]] bool begins() const { return is_below == is_left; }
  };

  void join(double y, std::size_t first, std::size_t below_end, std::size_t above_end) {
    std::size_t b = first;
    std::size_t a = first;
    double least = -std::numeric_limits<double>::max();  // of x: rounding must not change the order
    const auto x_of = [&](const Bound& bound) { return sides_[side_at(bound.side, y)].at(y); };
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
    for (std::uint32_t s = stretch.side; s != kNone && sides_[s].high < stretch.high.y();
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
      for (std::uint32_t i = first; i != kNone && used[i] == 0; i = stretches_[i].next) {
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
  std::vector<Active> active_{};
  bool has_ends_ = false;  // chains that go no further than the last slab's upper line
  std::vector<Active> order_{};
  std::vector<double> cuts_{};
  std::vector<Bound> below_{};
  std::vector<Bound> above_{};
  std::vector<Stretch> stretches_{};
};

}  // namespace

Outline boundary_of_layers(const std::vector<LayerEdge>& edges) {
  return Sweep(sides_of(edges)).run();
}

}  // namespace vantage
