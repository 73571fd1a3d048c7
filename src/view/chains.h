// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "view/outline_sweep.h"

/// \file
/// Edges of layers as chains that rise, and those of them that a line across the picture
/// meets, from left to right.

namespace vantage {

inline constexpr std::uint32_t kNoSide = ~std::uint32_t{0};

/// An edge that is not level, from its lower end to its upper one.
struct Side {
  double low = 0.0, high = 0.0;      // y
  double x_low = 0.0, x_high = 0.0;  // x there
  double slope = 0.0;                // x for each y
  int step = 0;                      // what is added to the layers from its left to its right
  std::uint32_t next =
      kNoSide;           // the side that goes on where this one ends, and nothing else there
  bool is_first = true;  // none goes on into this one

  [[nodiscard]] double at(double y) const {
    // Near a level side rounding may reach beyond its end.
    const double x = x_low + (y - low) * slope;
    const double inside = slope > 0.0 ? std::min(x, x_high) : std::max(x, x_high);
    return y < high ? inside : x_high;
  }
};

/// The edges that are not level, by their lower ends, joined to chains that rise without anything
/// else happening on them.
std::vector<Side> rising_sides(const std::vector<LayerEdge>& edges);

/// The chains that pass the slab at hand between two level lines, from left to right.
class ActiveChains {
 public:
  /// A chain by its sides.
  struct Chain {
    std::uint32_t first = 0;  ///< Its lowest side.
    std::uint32_t side = 0;   ///< The one that leaves the slab's lower line upwards.
    std::uint32_t above = 0;  ///< The one that leaves its upper line.
    int step = 0;             ///< What it adds to the layers from its left to its right.
  };

  /// \param sides must outlive this.
  explicit ActiveChains(const std::vector<Side>& sides) : sides_(sides) {}

  [[nodiscard]] const std::vector<Chain>& chains() const { return chains_; }

  /// The side of the chain on which `y` lies, from one below on: of two that meet there the upper.
  [[nodiscard]] std::uint32_t side_at(std::uint32_t side, double y) const;

  /// Puts a chain where it begins among the others. \param side its first.
  void insert(std::uint32_t side);

  /// Takes out the chains that go no further than `line`, if reach() met any.
  void drop_ended(double line);

  /// Finds where the chains pass the upper line of a slab. \return whether each is on the left of
  /// the next everywhere in the slab.
  bool reach(double line);

  /// Sorts the chains by their places half way up; they nearly are.
  void sort_half_way() { sort_half_way({0, chains_.size()}); }

  /// Makes the slab's upper line the lower one of the next.
  void pass();

  /// Sorts the chains by their places on the lower line.
  void sort_at_bottom();

  /// Whether some chain is right of the next somewhere in the slab that ends at `line`. \pre
  /// reach()
  [[nodiscard]] bool is_crossed(double line) const;

  /// Chains next to each other: none of them crosses any other in the slab at hand.
  struct Range {
    std::size_t begin, end;
  };

  /// Where chains cross so that it could change what the shape is: where, of those that come near
  /// to each other, so many end layers that none might be left. \pre is_crossed(), sort_half_way()
  [[nodiscard]] std::vector<Range> mattering(double line) const;

  /// The corners of these chains inside the slab that ends at `line`, in no order. \pre reach()
  void add_corners(const Range& range, double line, std::vector<double>& corners) const;

  /// Goes up to a line inside the slab with these chains alone: finds where they pass it, and sorts
  /// them by their places half way from where they were.
  void climb(const Range& range, double line);

  /// Goes on from there.
  void pass(const Range& range);

  /// Goes back to where these chains came from.
  void rewind(const Range& range);

  /// Adds where sides cross whose order half way up is not that at one end of a slab of straight
  /// sides.
  void add_crossings(const Range& range, double low, double high, std::vector<double>& cuts) const;

 private:
  [[nodiscard]] bool crosses(std::size_t left, std::size_t right, double line) const;
  void take_side(std::size_t i, std::uint32_t side);
  void sort_half_way(const Range& range);
  void move_back(std::size_t from, std::size_t to);

  template <class Change>
  void for_all_fields(const Change& change);

  const std::vector<Side>& sides_;
  std::vector<Chain> chains_{};
  std::vector<double> bottom_{}, top_{};
  // Of the sides `above`: where they begin, their slopes, ends, and between what x they stay.
  std::vector<double> low_{}, x_low_{}, slope_{}, high_{}, least_{}, most_{};
  std::vector<std::size_t> bent_{};  // those that change sides in the slab
  bool has_ended_ = false;           // some go no further than the last upper line
};

}  // namespace vantage
