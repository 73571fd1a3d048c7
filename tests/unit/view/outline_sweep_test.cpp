// SPDX-License-Identifier: MIT
#include "view/outline_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/cross.h"
#include "core/random.h"

namespace vantage {
namespace {

using Polygon = std::vector<PicturePoint>;

/// Adds a counter-clockwise polygon as one more layer.
void add(std::vector<LayerEdge>& edges, const Polygon& polygon, int layers = 1) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()], layers});
  }
}

Polygon square(double left, double low, double size) {
  return {{left, low}, {left + size, low}, {left + size, low + size}, {left, low + size}};
}

/// Positive to the left of the loops.
double area(const Outline& outline) {
  double twice = 0.0;
  for (const auto& loop : outline) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      twice += cross(loop[i], loop[(i + 1) % loop.size()]);
    }
  }
  return 0.5 * twice;
}

double length(const Outline& outline) {
  return measure_outline(outline).length;
}

TEST(OutlineSweep, GivesASquareBack) {
  std::vector<LayerEdge> edges;
  add(edges, square(0.1, 0.2, 0.5));
  const Outline outline = boundary_of_layers(edges);
  ASSERT_EQ(outline.size(), 1U);
  EXPECT_NEAR(area(outline), 0.25, 1e-15);
  EXPECT_NEAR(length(outline), 2.0, 1e-15);
}

TEST(OutlineSweep, JoinsWhatOverlaps) {
  std::vector<LayerEdge> edges;
  add(edges, square(0.0, 0.0, 0.5));
  add(edges, square(0.3, 0.2, 0.5));
  // The overlap is 0.2 wide and 0.3 high.
  EXPECT_NEAR(area(boundary_of_layers(edges)), 2.0 * 0.25 - 0.06, 1e-15);
  EXPECT_NEAR(length(boundary_of_layers(edges)), 2.0 * 2.0 - 2.0 * (0.2 + 0.3), 1e-15);
}

TEST(OutlineSweep, FindsCrossingsBetweenCorners) {
  // A square and the same turned by 45°: the union is a star of eight tips.
  std::vector<LayerEdge> edges;
  add(edges, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const double reach = std::numbers::sqrt2;
  add(edges, {{0, -reach}, {reach, 0}, {0, reach}, {-reach, 0}});
  // Each of four tips of the turned one stands out by √2 − 1 with a right angle.
  const double tip = (reach - 1.0) * (reach - 1.0);
  EXPECT_NEAR(area(boundary_of_layers(edges)), 4.0 + 4.0 * tip, 1e-14);
}

TEST(OutlineSweep, KeepsAHoleWithTheShapeOnItsLeft) {
  std::vector<LayerEdge> edges;
  add(edges, square(0.0, 0.0, 1.0));
  add(edges, square(0.25, 0.25, 0.5), -1);
  const Outline outline = boundary_of_layers(edges);
  ASSERT_EQ(outline.size(), 2U);
  EXPECT_NEAR(area(outline), 0.75, 1e-15);
  EXPECT_NEAR(length(outline), 6.0, 1e-15);
}

TEST(OutlineSweep, CountsWhatLiesTwiceOnTheSamePlaceOnce) {
  std::vector<LayerEdge> once;
  add(once, square(0.0, 0.0, 1.0));
  std::vector<LayerEdge> thrice = once;
  add(thrice, square(0.0, 0.0, 1.0), 2);
  EXPECT_NEAR(length(boundary_of_layers(thrice)), 4.0, 1e-15);
  EXPECT_EQ(boundary_of_layers(thrice).size(), 1U);
}

TEST(OutlineSweep, ClosesLoopsWhereSquaresTouchInACorner) {
  std::vector<LayerEdge> edges;
  add(edges, square(0.0, 0.0, 0.5));
  add(edges, square(0.5, 0.5, 0.5));
  EXPECT_NEAR(area(boundary_of_layers(edges)), 0.5, 1e-15);
  EXPECT_NEAR(length(boundary_of_layers(edges)), 4.0, 1e-15);
}

TEST(OutlineSweep, TakesNoNoticeOfWhatCrossesOverAnotherLayer) {
  // A star of crossing sides over the middle of a square, and a bar that reaches out of it.
  std::vector<LayerEdge> edges;
  add(edges, square(-2.0, -2.0, 4.0));
  add(edges, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  add(edges, {{0, -1.4}, {1.4, 0}, {0, 1.4}, {-1.4, 0}});
  add(edges, {{0.5, -0.25}, {3.0, -0.25}, {3.0, 0.25}, {0.5, 0.25}});
  const Outline outline = boundary_of_layers(edges);
  ASSERT_EQ(outline.size(), 1U);
  EXPECT_NEAR(area(outline), 16.0 + 1.0 * 0.5, 1e-14);
  EXPECT_NEAR(length(outline), 16.0 + 2.0, 1e-14);
}

TEST(OutlineSweep, FindsAHoleThatCrossingsLeaveOpen) {
  // Two holes turned by 45° to each other, one in each of two sheets: both see through where both
  // are.
  std::vector<LayerEdge> edges;
  add(edges, square(-2.0, -2.0, 4.0), 2);
  add(edges, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, -1);
  const double reach = std::numbers::sqrt2;
  add(edges, {{0, -reach}, {reach, 0}, {0, reach}, {-reach, 0}}, -1);
  // What both share is an octagon: either square less four tips of (√2 − 1)².
  const Outline outline = boundary_of_layers(edges);
  ASSERT_EQ(outline.size(), 2U);
  EXPECT_NEAR(area(outline), 16.0 - (4.0 - 4.0 * (reach - 1.0) * (reach - 1.0)), 1e-14);
}

TEST(OutlineSweep, HasNoOutlineOfNothing) {
  EXPECT_TRUE(boundary_of_layers({}).empty());
}

/// Where a horizontal line enters a triangle and where it leaves it; nothing where it passes it by.
std::optional<std::pair<double, double>> within(const Polygon& triangle, double y) {
  std::vector<double> crossings;
  for (std::size_t k = 0; k < 3; ++k) {
    const PicturePoint& a = triangle[k];
    const PicturePoint& b = triangle[(k + 1) % 3];
    if ((a.y() < y) != (b.y() < y)) {
      crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  if (crossings.size() != 2) {
    return std::nullopt;
  }
  return std::minmax(crossings[0], crossings[1]);
}

/// How much of a horizontal line triangles cover.
double covered_at(const std::vector<Polygon>& triangles, double y) {
  std::vector<std::pair<double, double>> spans;
  for (const Polygon& triangle : triangles) {
    if (const auto span = within(triangle, y)) {
      spans.push_back(*span);
    }
  }
  std::sort(spans.begin(), spans.end());
  double sum = 0.0;
  double end = -1.0;  // left of all
  for (const auto& [from, to] : spans) {
    sum += std::max(0.0, to - std::max(from, end));
    end = std::max(end, to);
  }
  return sum;
}

TEST(OutlineSweep, OfRandomTrianglesCoversWhatTheyCover) {
  // The area that 40 triangles cover.
  Pcg32 random(7);
  std::vector<LayerEdge> edges;
  std::vector<Polygon> triangles;
  for (int i = 0; i < 40; ++i) {
    Polygon t;
    const PicturePoint middle{random.uniform(), random.uniform()};
    for (int k = 0; k < 3; ++k) {
      t.emplace_back(middle + 0.2 * PicturePoint{random.uniform() - 0.5, random.uniform() - 0.5});
    }
    if (cross(t[1] - t[0], t[2] - t[0]) < 0.0) {
      std::swap(t[1], t[2]);
    }
    add(edges, t);
    triangles.push_back(t);
  }
  // What a line covers is linear between the heights of corners and crossings.
  std::vector<double> heights;
  for (const LayerEdge& one : edges) {
    heights.push_back(one.from.y());
    for (const LayerEdge& other : edges) {
      const PicturePoint along = one.to - one.from;
      const PicturePoint across = other.to - other.from;
      const PicturePoint apart = other.from - one.from;
      const double share = cross(apart, across) / cross(along, across);
      if (share > 0.0 && share < 1.0) {
        heights.push_back(one.from.y() + share * along.y());
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  double covered = 0.0;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    covered +=
        (heights[k] - heights[k - 1]) * covered_at(triangles, 0.5 * (heights[k] + heights[k - 1]));
  }
  EXPECT_NEAR(area(boundary_of_layers(edges)), covered, 1e-12);
}

}  // namespace
}  // namespace vantage
