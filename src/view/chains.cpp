// SPDX-License-Identifier: MIT
#include "view/chains.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "core/wide_registers.h"

namespace vantage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kLanes = 4;

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

std::vector<Side> sorted_sides(const std::vector<LayerEdge>& edges) {
  struct Key {
    double low = 0.0, x_low = 0.0;
    std::size_t side = 0;
  };

  std::vector<Side> sides;
  std::vector<Key> keys;
  sides.reserve(edges.size());
  keys.reserve(edges.size());
  for (const LayerEdge& edge : edges) {
    const bool falls = edge.from.y() > edge.to.y();
    const PicturePoint& low = falls ? edge.to : edge.from;
    const PicturePoint& high = falls ? edge.from : edge.to;
    // Level edges come back as the ways between what ends and what begins on their line.
    if (low.y() < high.y() && edge.layers != 0) {
      const double slope = (high.x() - low.x()) / (high.y() - low.y());
      keys.push_back({low.y(), low.x(), sides.size()});
      sides.push_back({.low = low.y(),
                       .high = high.y(),
                       .x_low = low.x(),
                       .x_high = high.x(),
                       .slope = slope,
                       .step = falls ? edge.layers : -edge.layers});
    }
  }
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.low < b.low ||
           (a.low == b.low && (a.x_low < b.x_low || (a.x_low == b.x_low && a.side < b.side)));
  });
  std::vector<Side> sorted;
  sorted.reserve(sides.size());
  for (const Key& key : keys) {
    sorted.push_back(sides[key.side]);
  }
  return sorted;
}

/// Joins sides to chains that rise without anything else happening on them.
/// \pre sides as sorted_sides()
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

/// x of straight sides where they meet the line at y, each between its ends.
struct StraightSides {
  const double* low;
  const double* x_low;
  const double* slope;
  const double* least;
  const double* most;
};

VANTAGE_INLINE void load(const double* from, Lanes& to) {
  std::memcpy(&to, from, sizeof(Lanes));
}

VANTAGE_INLINE void places_here(const StraightSides& sides, double y, std::size_t count,
                                double* x) {
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    Lanes low;
    Lanes x_low;
    Lanes slope;
    Lanes least;
    Lanes most;
    load(sides.low + i, low);
    load(sides.x_low + i, x_low);
    load(sides.slope + i, slope);
    load(sides.least + i, least);
    load(sides.most + i, most);
    Lanes place = x_low + (y - low) * slope;
    place = most < place ? most : place;
    place = place < least ? least : place;
    std::memcpy(x + i, &place, sizeof place);
  }
  for (; i < count; ++i) {
    const double place = sides.x_low[i] + (y - sides.low[i]) * sides.slope[i];
    x[i] = std::max(std::min(place, sides.most[i]), sides.least[i]);
  }
}

/// Whether the values ascend.
VANTAGE_INLINE bool ascend_here(const double* values, std::size_t count) {
  using Truths = decltype(Lanes{} < Lanes{});
  Truths falls{};
  std::size_t i = 1;
  for (; i + kLanes <= count; i += kLanes) {
    Lanes before;
    Lanes here;
    load(values + i - 1, before);
    load(values + i, here);
    falls |= before > here;
  }
  bool any = ((falls[0] | falls[1]) | (falls[2] | falls[3])) != 0;
  for (; i < count; ++i) {
    any = any || values[i - 1] > values[i];
  }
  return !any;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void places_wide(const StraightSides& sides, double y, std::size_t count,
                                         double* x) {
  places_here(sides, y, count, x);
}

[[gnu::target("avx2")]] bool ascend_wide(const double* values, std::size_t count) {
  return ascend_here(values, count);
}
#endif

void find_places(const StraightSides& sides, double y, std::size_t count, double* x) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    places_wide(sides, y, count, x);
    return;
  }
#endif
  places_here(sides, y, count, x);
}

bool ascend(const std::vector<double>& values) {
#if defined(__x86_64__)
  if (has_wide_registers()) {
    return ascend_wide(values.data(), values.size());
  }
#endif
  return ascend_here(values.data(), values.size());
}

}  // namespace

std::vector<Side> rising_sides(const std::vector<LayerEdge>& edges) {
  std::vector<Side> sides = sorted_sides(edges);
  join_sides(sides);
  return sides;
}

template <class Change>
void ActiveChains::for_all_fields(const Change& change) {
  change(chains_);
  for (std::vector<double>* field :
       {&bottom_, &top_, &low_, &x_low_, &slope_, &high_, &least_, &most_}) {
    change(*field);
  }
}

std::uint32_t ActiveChains::side_at(std::uint32_t side, double y) const {
  while (sides_[side].high <= y && sides_[side].next != kNoSide) {
    side = sides_[side].next;
  }
  return side;
}

void ActiveChains::take_side(std::size_t i, std::uint32_t side) {
  const Side& s = sides_[side];
  chains_[i].above = side;
  low_[i] = s.low;
  x_low_[i] = s.x_low;
  slope_[i] = s.slope;
  high_[i] = s.high;
  // Near a level side rounding may reach beyond its end.
  least_[i] = -kInfinity;
  most_[i] = kInfinity;
  (s.slope > 0.0 ? most_ : least_)[i] = s.x_high;
}

void ActiveChains::insert(std::uint32_t side) {
  const double x = sides_[side].x_low;
  const auto at = std::upper_bound(bottom_.begin(), bottom_.end(), x) - bottom_.begin();
  for_all_fields([at](auto& field) { field.emplace(field.begin() + at); });
  const auto i = static_cast<std::size_t>(at);
  chains_[i] = {side, side, side, sides_[side].step};
  bottom_[i] = x;
  take_side(i, side);
}

void ActiveChains::drop_ended(double line) {
  if (!has_ended_) {
    return;
  }
  has_ended_ = false;
  for (std::size_t i = chains_.size(); i-- > 0;) {
    if (high_[i] <= line) {
      for_all_fields(
          [i](auto& field) { field.erase(field.begin() + static_cast<std::ptrdiff_t>(i)); });
    }
  }
}

bool ActiveChains::reach(double line) {
  bent_.clear();
  for (std::size_t i = 0; i < high_.size(); ++i) {
    if (high_[i] <= line) {
      take_side(i, side_at(chains_[i].side, line));
      has_ended_ = has_ended_ || high_[i] <= line;
      bent_.push_back(i);
    }
  }
  find_places({low_.data(), x_low_.data(), slope_.data(), least_.data(), most_.data()}, line,
              top_.size(), top_.data());
  for (const std::size_t i : bent_) {
    if (high_[i] <= line) {
      top_[i] = sides_[chains_[i].above].x_high;
    }
  }
  return ascend(bottom_) && ascend(top_) &&
         std::none_of(bent_.begin(), bent_.end(), [&](std::size_t i) {
           return (i > 0 && crosses(i - 1, i, line)) ||
                  (i + 1 < top_.size() && crosses(i, i + 1, line));
         });
}

void ActiveChains::climb(const Range& range, double line) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    take_side(i, side_at(chains_[i].side, line));
    top_[i] = sides_[chains_[i].above].at(line);
  }
  sort_half_way(range);
}

void ActiveChains::pass(const Range& range) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    bottom_[i] = top_[i];
    chains_[i].side = chains_[i].above;
  }
}

void ActiveChains::rewind(const Range& range) {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    take_side(i, chains_[i].side);
  }
}

void ActiveChains::move_back(std::size_t from, std::size_t to) {
  for_all_fields([&](auto& field) {
    const auto begin = field.begin();
    std::rotate(begin + static_cast<std::ptrdiff_t>(to), begin + static_cast<std::ptrdiff_t>(from),
                begin + static_cast<std::ptrdiff_t>(from) + 1);
  });
}

void ActiveChains::sort_half_way(const Range& range) {
  for (std::size_t i = range.begin + 1; i < range.end; ++i) {
    const double place = bottom_[i] + top_[i];
    std::size_t k = i;
    while (k > range.begin && bottom_[k - 1] + top_[k - 1] > place) {
      --k;
    }
    if (k < i) {
      move_back(i, k);
    }
  }
}

void ActiveChains::sort_at_bottom() {
  for (std::size_t i = 1; i < chains_.size(); ++i) {
    std::size_t k = i;
    while (k > 0 && bottom_[k - 1] > bottom_[i]) {
      --k;
    }
    if (k < i) {
      move_back(i, k);
    }
  }
}

void ActiveChains::pass() {
  bottom_.swap(top_);
  for (Chain& chain : chains_) {
    chain.side = chain.above;
  }
}

/// Whether `left` is right of `right` somewhere in the slab that ends at the line.
bool ActiveChains::crosses(std::size_t left, std::size_t right, double line) const {
  if (bottom_[left] > bottom_[right] || top_[left] > top_[right]) {
    return true;
  }
  const Chain& l = chains_[left];
  const Chain& r = chains_[right];
  if (l.side == l.above && r.side == r.above) {
    return false;
  }
  std::uint32_t a = l.side;
  std::uint32_t b = r.side;
  for (double y = std::min(sides_[a].high, sides_[b].high); y < line;
       y = std::min(sides_[a].high, sides_[b].high)) {
    if (sides_[a].at(y) > sides_[b].at(y)) {
      return true;
    }
    a = side_at(a, y);
    b = side_at(b, y);
  }
  return false;
}

bool ActiveChains::is_crossed(double line) const {
  for (std::size_t i = 1; i < chains_.size(); ++i) {
    if (crosses(i - 1, i, line)) {
      return true;
    }
  }
  return false;
}

std::vector<ActiveChains::Range> ActiveChains::mattering(double line) const {
  std::vector<Range> ranges;
  const std::size_t count = chains_.size();
  std::vector<double> leftmost(count);
  std::vector<double> rightmost(count);
  for (std::size_t i = 0; i < count; ++i) {
    leftmost[i] = std::min(bottom_[i], top_[i]);
    rightmost[i] = std::max(bottom_[i], top_[i]);
    for (std::uint32_t s = chains_[i].side; s != chains_[i].above; s = sides_[s].next) {
      leftmost[i] = std::min(leftmost[i], sides_[s].x_high);
      rightmost[i] = std::max(rightmost[i], sides_[s].x_high);
    }
  }
  for (std::size_t i = count; i-- > 1;) {
    leftmost[i - 1] = std::min(leftmost[i - 1], leftmost[i]);  // from here on
  }
  int layers = 0;       // on the left of what follows
  std::size_t end = 0;  // of chains of which none on the left comes near one on the right
  for (std::size_t begin = 0; begin < count; begin = end) {
    double reached = rightmost[begin];
    int least = layers + std::min(0, chains_[begin].step);
    int after = layers + chains_[begin].step;
    bool is_any = false;
    for (end = begin + 1; end < count && leftmost[end] < reached; ++end) {
      reached = std::max(reached, rightmost[end]);
      least += std::min(0, chains_[end].step);
      after += chains_[end].step;
      is_any = is_any || crosses(end - 1, end, line);
    }
    if (is_any && least <= 0) {
      ranges.push_back({begin, end});
    }
    layers = after;
  }
  return ranges;
}

void ActiveChains::add_corners(const Range& range, double line,
                               std::vector<double>& corners) const {
  for (std::size_t i = range.begin; i < range.end; ++i) {
    for (std::uint32_t s = chains_[i].side; sides_[s].high < line; s = sides_[s].next) {
      corners.push_back(sides_[s].high);
    }
  }
}

void ActiveChains::add_crossings(const Range& range, double low, double high,
                                 std::vector<double>& cuts) const {
  struct Ends {
    double bottom, top;
  };

  std::vector<Ends> order(range.end - range.begin);
  for (double Ends::*const place : {&Ends::bottom, &Ends::top}) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = {bottom_[range.begin + i], top_[range.begin + i]};
    }
    for (std::size_t i = 1; i < order.size(); ++i) {
      const Ends here = order[i];
      std::size_t k = i;
      for (; k > 0 && order[k - 1].*place > here.*place; --k) {
        const Ends& other = order[k - 1];
        const double before = std::abs(other.bottom - here.bottom);
        const double after = std::abs(other.top - here.top);
        if (before + after > 0.0) {
          const double y = low + (high - low) * before / (before + after);
          if (y > low && y < high) {
            cuts.push_back(y);
          }
        }
        order[k] = other;
      }
      order[k] = here;
    }
  }
}

}  // namespace vantage
