// SPDX-License-Identifier: MIT
#include "report/line_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "vantage/io/write.h"

#include "render/hex_text.h"
#include "report/lettering.h"

namespace vantage {
namespace {

/// Strokes of letters over the height of capitals.
constexpr double kLetterWeight = 0.13;

/// Distance of a point from the segment a b.
double distance_to(const PixelPoint& point, const PixelPoint& a, const PixelPoint& b) {
  const double along_x = b[0] - a[0];
  const double along_y = b[1] - a[1];
  const double squared = along_x * along_x + along_y * along_y;
  const double dot = (point[0] - a[0]) * along_x + (point[1] - a[1]) * along_y;
  const double share = squared > 0.0 ? std::clamp(dot / squared, 0.0, 1.0) : 0.0;
  return std::hypot(point[0] - a[0] - share * along_x, point[1] - a[1] - share * along_y);
}

/// Distance of a point from the border of a convex polygon, below 0 inside; near corners outside it
/// is a little too small, by less than a pixel shows.
double distance_to_area(const PixelPoint& point, const std::vector<PixelPoint>& corners) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PixelPoint& a = corners[i];
    const PixelPoint& b = corners[(i + 1) % corners.size()];
    twice_area += a[0] * b[1] - b[0] * a[1];
  }
  const double sense = twice_area < 0.0 ? -1.0 : 1.0;
  double distance = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const PixelPoint& a = corners[i];
    const PixelPoint& b = corners[(i + 1) % corners.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 0.0) {
      const double cross = (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]);
      distance = std::max(distance, -sense * cross / length);
    }
  }
  return distance;
}

/// Two decimals are enough for a pixel.
std::string coordinate(double value) {
  return number_text(std::round(100.0 * value) / 100.0);
}

void blend(std::uint8_t* pixel, const Rgb8& colour, double coverage) {
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] =
        static_cast<std::uint8_t>(std::lround(coverage * colour[c] + (1.0 - coverage) * pixel[c]));
  }
}

}  // namespace

void LineDrawing::fill(std::vector<PixelPoint> corners, Rgb8 colour) {
  shapes_.push_back({std::move(corners), 0.0, colour});
}

void LineDrawing::line(std::vector<PixelPoint> points, double width, Rgb8 colour) {
  shapes_.push_back({std::move(points), width, colour});
}

void LineDrawing::dot(const PixelPoint& centre, double radius, Rgb8 colour) {
  shapes_.push_back({{centre}, 2.0 * radius, colour});
}

void LineDrawing::text(std::string_view text, const PixelPoint& left, double height, Rgb8 colour) {
  for (const Stroke& stroke : letter_strokes(text)) {
    std::vector<PixelPoint> points;
    for (const auto& [x, y] : stroke) {
      points.push_back({left[0] + height * x, left[1] - height * y});
    }
    line(std::move(points), kLetterWeight * height, colour);
  }
}

std::string LineDrawing::svg() const {
  const std::string size =
      "width=\"" + std::to_string(width_) + "\" height=\"" + std::to_string(height_) + "\"";
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " +
                     std::to_string(width_) + " " + std::to_string(height_) + "\">\n<rect " + size +
                     " fill=\"#fff\"/>\n<g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (const Shape& shape : shapes_) {
    const bool is_area = shape.width == 0.0;
    std::string path = "M";
    for (const PixelPoint& point : shape.points) {
      path += (path.size() > 1 ? "L" : "") + coordinate(point[0]) + " " + coordinate(point[1]);
    }
    // A line without length is a dot only if it is closed.
    path += is_area || shape.points.size() == 1 ? "Z" : "";
    text += "<path d=\"" + path + "\" ";
    text += is_area ? "fill=\"" + hex_text(shape.colour) + "\"/>\n"
                    : "fill=\"none\" stroke=\"" + hex_text(shape.colour) + "\" stroke-width=\"" +
                          coordinate(shape.width) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

double LineDrawing::distance(const PixelPoint& point, const Shape& shape) {
  if (shape.width == 0.0) {
    return distance_to_area(point, shape.points);
  }
  // A joint of two pieces is covered by both; the nearer one counts.
  double nearest = distance_to(point, shape.points.front(), shape.points.front());
  for (std::size_t i = 1; i < shape.points.size(); ++i) {
    nearest = std::min(nearest, distance_to(point, shape.points[i - 1], shape.points[i]));
  }
  return nearest;
}

void LineDrawing::draw(const Shape& shape, Image& image) const {
  const double reach = 0.5 * shape.width + 1.0;
  const auto low = [&](std::size_t axis) {
    double least = shape.points.front()[axis];
    for (const PixelPoint& point : shape.points) {
      least = std::min(least, point[axis]);
    }
    return std::max(0, static_cast<int>(std::floor(least - reach)));
  };
  const auto high = [&](std::size_t axis, int end) {
    double most = shape.points.front()[axis];
    for (const PixelPoint& point : shape.points) {
      most = std::max(most, point[axis]);
    }
    return std::min(end, static_cast<int>(std::ceil(most + reach)));
  };
  const int right = high(0, width_);
  const int bottom = high(1, height_);
  for (int y = low(1); y < bottom; ++y) {
    for (int x = low(0); x < right; ++x) {
      const double inside = 0.5 * shape.width - distance({x + 0.5, y + 0.5}, shape);
      const double coverage = std::clamp(inside + 0.5, 0.0, 1.0);
      if (coverage > 0.0) {
        blend(image.rgba.data() + (image.pixel(x, y) - image.rgba.data()), shape.colour, coverage);
      }
    }
  }
}

Image LineDrawing::image() const {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  Image image{width_, height_, std::vector<std::uint8_t>(4 * pixels, 255)};
  draw_on(image);
  return image;
}

void LineDrawing::draw_on(Image& picture) const {
  for (const Shape& shape : shapes_) {
    draw(shape, picture);
  }
}

}  // namespace vantage
