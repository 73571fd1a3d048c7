// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/wide_registers.h"
#include "spatial/picture_cells.h"

namespace vantage {

/// What is in each cell of a picture, with its extent beside it, so that several are compared at
/// once. Made for reuse.
class CellLists {
 public:
  /// \param extents of the items. \param over_all over_all(each) calls each(item, cell) for all that is
  ///                to be listed, twice over the same.
  template <typename OverAll>
  void fill(std::size_t cells, const std::vector<PictureCells::Extent>& extents,
            const OverAll& over_all) {
    first_.assign(cells + 1, 0);
    over_all([this](std::uint32_t /*item*/, std::uint32_t cell) { ++first_[cell]; });
    std::uint32_t total = 0;
    for (std::uint32_t& count : first_) {
      total += count;
      count = total;  // for now the end of the cell: filling walks back to its begin
    }
    items_.resize(total);
    for (std::vector<float>* field : {&left_, &right_, &bottom_, &top_, &nearest_}) {
      field->resize(total + kLanes);  // so that the last cell can be read by whole lanes
    }
    over_all([this, &extents](std::uint32_t item, std::uint32_t cell) {
      const std::uint32_t slot = --first_[cell];
      const PictureCells::Extent& extent = extents[item];
      items_[slot] = item;
      left_[slot] = extent.left;
      right_[slot] = extent.right;
      bottom_[slot] = extent.bottom;
      top_[slot] = extent.top;
      nearest_[slot] = extent.nearest;
    });
  }

  /// How many items a row of cells has. \pre first <= last.
  [[nodiscard]] std::size_t count(std::uint32_t first, std::uint32_t last) const {
    return first_[last + 1] - first_[first];
  }

  /// Whether is_wanted(item) answers true of one of those in a row of cells that may have a place in
  /// common with an extent and not behind it. \pre first <= last.
  template <typename IsWanted>
  [[nodiscard]] bool is_any_before(std::uint32_t first, std::uint32_t last,
                                   const PictureCells::Extent& extent,
                                   const IsWanted& is_wanted) const {
    using Floats = Registers<kLanes>::Floats;
    const std::uint32_t end = first_[last + 1];
    for (std::uint32_t slot = first_[first]; slot < end; slot += kLanes) {
      const auto at = [slot](const std::vector<float>& field) {
        Floats values;
        std::memcpy(&values, field.data() + slot, sizeof values);
        return values;
      };
      unsigned found = bits_of((at(nearest_) < extent.farthest) & (at(left_) < extent.right) &
                               (at(right_) > extent.left) & (at(bottom_) < extent.top) &
                               (at(top_) > extent.bottom));
      if (end - slot < kLanes) {
        found &= (1U << (end - slot)) - 1U;
      }
      for (; found != 0; found &= found - 1) {
        if (is_wanted(items_[slot + static_cast<std::uint32_t>(std::countr_zero(found))])) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr unsigned kLanes = 4;

  std::vector<std::uint32_t> first_{};  // of each cell, and one past the last
  std::vector<std::uint32_t> items_{};
  std::vector<float> left_{}, right_{}, bottom_{}, top_{}, nearest_{};  // of each of them
};

}  // namespace vantage
