// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/wide_registers.h"
#include "spatial/picture_cells.h"

namespace vantage {

/// What is in each cell of a picture, with its extent beside it, so that several are compared at
/// once. Made for reuse.
class CellLists {
 public:
  /// \param extents of the items. \param over_all over_all(each) calls each(item, cell) for all that is
  ///                to be listed, twice over the same. \pre That is less than 2^32.
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
    packs_.resize(total / kLanes + 1);
    over_all([this, &extents](std::uint32_t item, std::uint32_t cell) {
      const std::uint32_t slot = --first_[cell];
      const PictureCells::Extent& extent = extents[item];
      Pack& pack = packs_[slot / kLanes];
      const std::uint32_t lane = slot % kLanes;
      pack.items[lane] = item;
      pack.left[lane] = extent.left;
      pack.right[lane] = extent.right;
      pack.bottom[lane] = extent.bottom;
      pack.top[lane] = extent.top;
      pack.nearest[lane] = extent.nearest;
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
    const std::uint32_t begin = first_[first];
    const std::uint32_t end = first_[last + 1];
    for (std::uint32_t start = begin - begin % kLanes; start < end; start += kLanes) {
      const Pack& pack = packs_[start / kLanes];
      unsigned found = bits_of((pack.nearest < extent.farthest) & (pack.left < extent.right) &
                               (pack.right > extent.left) & (pack.bottom < extent.top) &
                               (pack.top > extent.bottom));
      found &= start < begin ? ~0U << (begin - start) : ~0U;
      found &= end - start < kLanes ? (1U << (end - start)) - 1U : ~0U;
      for (; found != 0; found &= found - 1) {
        if (is_wanted(pack.items[static_cast<std::uint32_t>(std::countr_zero(found))])) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr unsigned kLanes = 4;

  /// Some items, one after the other in the order of their cells.
  struct Pack {
    std::array<std::uint32_t, kLanes> items;
    Registers<kLanes>::Floats left, right, bottom, top, nearest;
  };

  std::vector<std::uint32_t> first_{};  // of each cell, and one past the last
  std::vector<Pack> packs_{};
};

}  // namespace vantage
