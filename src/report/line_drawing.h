// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/core/image.h"

/// \file
/// Drawings of lines, dots and areas that may be had as SVG or as pixels.

namespace vantage {

/// A place on a drawing, px from its top left corner.
using PixelPoint = std::array<double, 2>;

/// Collects shapes, the later over the earlier, on white.
class LineDrawing {
 public:
  /// \param width px, ≥ 1. \param height px, ≥ 1.
  LineDrawing(int width, int height) : width_(width), height_(height) {}

  /// A convex area. \pre at least three corners.
  void fill(std::vector<PixelPoint> corners, Rgb8 colour);

  /// A line with round ends. \param width px. \pre at least one point.
  void line(std::vector<PixelPoint> points, double width, Rgb8 colour);

  /// A disc. \param radius px.
  void dot(const PixelPoint& centre, double radius, Rgb8 colour);

  /// ASCII text. \param left where its baseline begins. \param height of its capitals, px.
  void text(std::string_view text, const PixelPoint& left, double height, Rgb8 colour);

  /// As a standalone document.
  [[nodiscard]] std::string svg() const;

  /// As pixels, with soft edges.
  [[nodiscard]] Image image() const;

  /// The same on a picture instead of white. \pre it is as large as the drawing, and opaque.
  void draw_on(Image& picture) const;

 private:
  struct Shape {
    std::vector<PixelPoint> points{};
    double width = 0.0;  ///< Of a line; 0: an area.
    Rgb8 colour{};
  };

  /// Distance of a point from a line's middle or an area's border, below 0 inside the latter.
  [[nodiscard]] static double distance(const PixelPoint& point, const Shape& shape);
  void draw(const Shape& shape, Image& image) const;

  int width_;
  int height_;
  std::vector<Shape> shapes_{};
};

}  // namespace vantage
