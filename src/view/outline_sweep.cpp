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
      sides.push_back(
          {low.y(), high.y(), low.x(), high.x(), slope, falls ? edge.layers : -edge.layers});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.low < b.low || (a.low == b.low && a.x_low < b.x_low);
  });
  return sides;
}

/// A side where it passes the slab at hand.
struct Active {
  Side side{};
  std::uint32_t index = 0;         // of the side
  double bottom = 0.0, top = 0.0;  // x
};

/// A stretch of one side that bounds the shape: down where the shape is on its right, else up.
struct Stretch {
  PicturePoint begin = PicturePoint::Zero();  // in the outline's direction
  PicturePoint end = PicturePoint::Zero();
  std::uint32_t next = kNone;
};

/// What bounds the shape along a line across: sides from left to right, by turns its left and its
/// right, with their open stretches.
struct Bound {
  std::uint32_t side = 0;
  std::uint32_t stretch = kNone;
};

/// Cuts the plane into slabs between which nothing begins, ends or crosses, so that the shape is a row
/// of intervals in each; then joins what bounds them. On the line between two slabs the shape may
/// differ only between the first and the second, the third and the fourth … of all ends there, which
/// tells what to join however near to each other they are.
class Sweep {
 public:
  explicit Sweep(std::vector<Side> sides) : sides_(std::move(sides)) {}

  Outline run() {
    std::vector<double> lines;
    lines.reserve(2 * sides_.size());
    for (const Side& side : sides_) {
      lines.push_back(side.low);
      lines.push_back(side.high);
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    std::size_t next = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      std::erase_if(active_, [&](const Active& a) { return a.side.high <= lines[i]; });
      for (; next < sides_.size() && sides_[next].low <= lines[i]; ++next) {
        insert({sides_[next], static_cast<std::uint32_t>(next), sides_[next].x_low, 0.0});
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
  /// Puts a side where it begins among the others.
  void insert(const Active& side) {
    const auto at =
        std::upper_bound(active_.begin(), active_.end(), side,
                         [](const Active& a, const Active& b) { return a.bottom < b.bottom; });
    active_.insert(at, side);
  }

  /// Sorts the active sides by their places half way up; they nearly are.
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

  void slab(double bottom, double top) {
    bool crosses = false;
    for (Active& a : active_) {
      a.top = a.side.at(top);
    }
    sort_active();
    for (std::size_t i = 1; i < active_.size() && !crosses; ++i) {
      crosses = active_[i - 1].bottom > active_[i].bottom || active_[i - 1].top > active_[i].top;
    }
    if (crosses) {
      cut_slab(bottom, top);
    } else {
      intervals(bottom);
    }
    for (Active& a : active_) {
      a.bottom = a.top;
    }
  }

  /// A slab in which sides cross: cut again where they do.
  void cut_slab(double bottom, double top) {
    cuts_.clear();
    find_crossings(&Active::bottom, bottom, top);
    find_crossings(&Active::top, bottom, top);
    cuts_.push_back(top);
    std::sort(cuts_.begin(), cuts_.end());
    for (Active& a : active_) {
      a.bottom = a.side.at(bottom);
    }
    double from = bottom;
    for (const double to : cuts_) {
      if (to > from) {
        for (Active& a : active_) {
          a.top = a.side.at(to);
        }
        sort_active();
        intervals(from);
        for (Active& a : active_) {
          a.bottom = a.top;
        }
        from = to;
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

  /// Finds what bounds the shape in the slab that begins at `y`, and what changes there.
  void intervals(double y) {
    above_.clear();
    int layers = 0;
    for (const Active& a : active_) {
      const int after = layers + a.side.step;
      if ((layers > 0) != (after > 0)) {
        above_.push_back({a.index, kNone});
      }
      layers = after;
    }
    if (above_.size() % 2 != 0) {
      above_.pop_back();  // the chain was not closed
    }
    change(y);
  }

  /// Ends the stretches that go no further than the line at `y`, begins those that start there, and
  /// joins them.
  void change(double y) {
    const auto is_same = [](const Bound& a, const Bound& b) { return a.side == b.side; };
    const auto ahead =
        std::mismatch(below_.begin(), below_.end(), above_.begin(), above_.end(), is_same);
    const auto first = static_cast<std::size_t>(ahead.first - below_.begin());
    std::size_t kept = 0;  // behind
    while (kept + first < std::min(below_.size(), above_.size()) &&
           is_same(below_[below_.size() - 1 - kept], above_[above_.size() - 1 - kept])) {
      ++kept;
    }
    for (std::size_t i = 0; i < first; ++i) {
      above_[i].stretch = below_[i].stretch;
    }
    for (std::size_t i = 0; i < kept; ++i) {
      above_[above_.size() - 1 - i].stretch = below_[below_.size() - 1 - i].stretch;
    }
    join(y, first, below_.size() - kept, above_.size() - kept);
    below_.swap(above_);
  }

  /// The end of a stretch on the line at hand.
  struct End {
    std::uint32_t stretch = kNone;
    bool is_below = false;
    bool is_left = false;  // of the shape
  };

  void join(double y, std::size_t first, std::size_t below_end, std::size_t above_end) {
    std::size_t b = first;
    std::size_t a = first;
    double least = -std::numeric_limits<double>::max();  // of x: rounding must not change the order
    const auto x_of = [&](const Bound& bound) { return sides_[bound.side].at(y); };
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
        link(open, end);
      }
      open = end;
      is_open = !is_open;
    }
  }

  /// Ends or begins the stretch of a side.
  End touch(Bound& bound, const PicturePoint& place, bool is_below, bool is_left) {
    if (!is_below) {
      bound.stretch = static_cast<std::uint32_t>(stretches_.size());
      stretches_.emplace_back();
    }
    Stretch& stretch = stretches_[bound.stretch];
    // The left of the shape is gone down, its right up.
    (is_below == is_left ? stretch.begin : stretch.end) = place;
    return {bound.stretch, is_below, is_left};
  }

  /// Of two joined ends one is the end of its stretch and the other the beginning of its own.
  void link(const End& a, const End& b) {
    const bool a_begins = a.is_below == a.is_left;
    if (a_begins) {
      stretches_[b.stretch].next = a.stretch;
    } else {
      stretches_[a.stretch].next = b.stretch;
    }
  }

  Outline loops() const {
    std::vector<std::uint8_t> used(stretches_.size(), 0);
    Outline outline;
    for (std::uint32_t first = 0; first < stretches_.size(); ++first) {
      std::vector<PicturePoint> loop;
      for (std::uint32_t i = first; i != kNone && used[i] == 0; i = stretches_[i].next) {
        used[i] = 1;
        for (const PicturePoint& p : {stretches_[i].begin, stretches_[i].end}) {
          if (loop.empty() || loop.back() != p) {
            loop.push_back(p);
          }
        }
      }
      if (loop.size() > 2) {
        outline.push_back(std::move(loop));
      }
    }
    return outline;
  }

  std::vector<Side> sides_;
  std::vector<Active> active_{};
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
