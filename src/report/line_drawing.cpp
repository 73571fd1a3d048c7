// SPDX-License-Identifier: MIT
#include "report/line_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "vantage/io/write.h"

#include "report/lettering.h"

namespace vantage {
namespace {

/// Strokes of letters over the height of capitals.
constexpr double kLetterWeight = 0.13;

/// Distance of a spot from the segment a b.
double distance_to(const Spot& spot, const Spot& a, const Spot& b) {
  const double along_x = b[0] - a[0];
  const double along_y = b[1] - a[1];
  const double squared = along_x * along_x + along_y * along_y;
  const double dot = (spot[0] - a[0]) * along_x + (spot[1] - a[1]) * along_y;
  const double share = squared > 0.0 ? std::clamp(dot / squared, 0.0, 1.0) : 0.0;
  return std::hypot(spot[0] - a[0] - share * along_x, spot[1] - a[1] - share * along_y);
}

/// Distance of a spot from the border of a convex polygon, below 0 inside; near corners outside it
/// is a little too small, by less than a pixel shows.
double distance_to_area(const Spot& spot, const std::vector<Spot>& corners) {
  double twice_area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Spot& a = corners[i];
    const Spot& b = corners[(i + 1) % corners.size()];
    twice_area += a[0] * b[1] - b[0] * a[1];
  }
  const double sense = twice_area < 0.0 ? -1.0 : 1.0;
  double distance = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Spot& a = corners[i];
    const Spot& b = corners[(i + 1) % corners.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (length > 0.0) {
      const double cross = (b[0] - a[0]) * (spot[1] - a[1]) - (b[1] - a[1]) * (spot[0] - a[0]);
      distance = std::max(distance, -sense * cross / length);
    }
  }
  return distance;
}

/// Two decimals are enough for a pixel.
std::string coordinate(double value) {
  return number_text(std::round(100.0 * value) / 100.0);
}

std::string hex(const Rgb8& colour) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t channel : colour) {
    text += kDigits[channel >> 4U];
    text += kDigits[channel & 15U];
  }
  return text;
}

void blend(std::uint8_t* pixel, const Rgb8& colour, double coverage) {
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] =
        static_cast<std::uint8_t>(std::lround(coverage * colour[c] + (1.0 - coverage) * pixel[c]));
  }
}

}  // namespace

void LineDrawing::fill(std::vector<Spot> corners, Rgb8 colour) {
  shapes_.push_back({std::move(corners), 0.0, colour});
}

void LineDrawing::line(std::vector<Spot> points, double width, Rgb8 colour) {
  shapes_.push_back({std::move(points), width, colour});
}

void LineDrawing::dot(const Spot& centre, double radius, Rgb8 colour) {
  shapes_.push_back({{centre}, 2.0 * radius, colour});
}

void LineDrawing::text(std::string_view text, const Spot& left, double height, Rgb8 colour) {
  for (const Stroke& stroke : letter_strokes(text)) {
    std::vector<Spot> points;
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
    for (const Spot& point : shape.points) {
      path += (path.size() > 1 ? "L" : "") + coordinate(point[0]) + " " + coordinate(point[1]);
    }
    // A line without length is a dot only if it is closed.
    path += is_area || shape.points.size() == 1 ? "Z" : "";
    text += "<path d=\"" + path + "\" ";
    text += is_area ? "fill=\"" + hex(shape.colour) + "\"/>\n"
                    : "fill=\"none\" stroke=\"" + hex(shape.colour) + "\" stroke-width=\"" +
                          coordinate(shape.width) + "\"/>\n";
  }
  return text + "</g>\n</svg>\n";
}

Image LineDrawing::image() const {
  const auto pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  Image image{width_, height_, std::vector<std::uint8_t>(4 * pixels, 255)};
  for (const Shape& shape : shapes_) {
    const bool is_area = shape.width == 0.0;
    const std::size_t pieces = is_area ? 1 : std::max<std::size_t>(1, shape.points.size() - 1);
    // A joint of two pieces is covered by both: the larger coverage counts, so the pieces of a
    // stroke are looked at together within its box.
    Spot low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Spot high{-low[0], -low[1]};
    for (const Spot& point : shape.points) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], point[axis]);
        high[axis] = std::max(high[axis], point[axis]);
      }
    }
    const double reach = 0.5 * shape.width + 1.0;
    const auto from = [&](double value) { return static_cast<int>(std::floor(value - reach)); };
    const auto to = [&](double value) { return static_cast<int>(std::ceil(value + reach)); };
    for (int y = std::max(0, from(low[1])); y < std::min(height_, to(high[1])); ++y) {
      for (int x = std::max(0, from(low[0])); x < std::min(width_, to(high[0])); ++x) {
        const Spot spot{x + 0.5, y + 0.5};
        double distance = is_area ? distance_to_area(spot, shape.points)
                                  : std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; !is_area && i < pieces; ++i) {
          const Spot& end = shape.points[std::min(i + 1, shape.points.size() - 1)];
          distance = std::min(distance, distance_to(spot, shape.points[i], end));
        }
        const double coverage = std::clamp(0.5 * shape.width - distance + 0.5, 0.0, 1.0);
        if (coverage > 0.0) {
          blend(image.rgba.data() + (image.pixel(x, y) - image.rgba.data()), shape.colour,
                std::min(1.0, coverage));
        }
      }
    }
  }
  return image;
}

}  // namespace vantage
