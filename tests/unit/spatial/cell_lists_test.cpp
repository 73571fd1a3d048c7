// SPDX-License-Identifier: MIT
#include "spatial/cell_lists.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace vantage {
namespace {

constexpr std::uint32_t kCells = 12;

/// By the definition: what has a place in common and is not behind.
bool is_before(const PictureCells::Extent& one, const PictureCells::Extent& other) {
  return one.nearest < other.farthest && one.left < other.right && other.left < one.right &&
         one.bottom < other.top && other.bottom < one.top;
}

std::vector<PictureCells::Extent> random_extents(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<float> place(0.0F, 1.0F);
  std::vector<PictureCells::Extent> extents;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [left, right] = std::minmax({place(random), place(random)});
    const auto [bottom, top] = std::minmax({place(random), place(random)});
    const auto [nearest, farthest] = std::minmax({place(random), place(random)});
    extents.push_back({left, right, bottom, top, nearest, farthest, {}});
  }
  return extents;
}

TEST(CellLists, FindWhatIsBeforeInEveryRowOfCells) {
  std::mt19937 random(4);
  CellLists lists;
  for (const std::size_t count : {3U, 40U, 17U, 0U}) {  // fewer than before: nothing of those stays
    const std::vector<PictureCells::Extent> extents = random_extents(count, random);
    const auto in_cell = [](std::uint32_t item, std::uint32_t cell) {
      return item % 3 == cell % 3 && item % kCells <= cell;
    };
    lists.fill(kCells, extents, [&](const auto& each) {
      for (std::uint32_t item = 0; item < count; ++item) {
        for (std::uint32_t cell = 0; cell < kCells; ++cell) {
          if (in_cell(item, cell)) {
            each(item, cell);
          }
        }
      }
    });
    for (const PictureCells::Extent& extent : random_extents(5, random)) {
      for (std::uint32_t first = 0; first < kCells; ++first) {
        for (std::uint32_t last = first; last < kCells; ++last) {
          std::vector<std::uint32_t> expected;
          for (std::uint32_t cell = first; cell <= last; ++cell) {
            for (std::uint32_t item = 0; item < count; ++item) {
              if (in_cell(item, cell) && is_before(extents[item], extent)) {
                expected.push_back(item);
              }
            }
          }
          std::vector<std::uint32_t> found;
          EXPECT_FALSE(lists.is_any_before(first, last, extent, [&](std::uint32_t item) {
            found.push_back(item);
            return false;
          }));
          std::sort(expected.begin(), expected.end());
          std::sort(found.begin(), found.end());
          ASSERT_EQ(found, expected);
          EXPECT_EQ(lists.is_any_before(first, last, extent, [](std::uint32_t) { return true; }),
                    !expected.empty());
        }
      }
    }
  }
}

}  // namespace
}  // namespace vantage
