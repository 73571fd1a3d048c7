// SPDX-License-Identifier: MIT
#include "report/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

#include "vantage/render/render.h"

#include "report/lettering.h"
#include "report/line_drawing.h"

namespace vantage {
namespace {

// Smaller pictures have none: its letters could not be read, or it would cover the model. [ours]
constexpr int kLeastWidth = 280;        // px
constexpr int kLeastHeight = 200;       // px
constexpr double kLetterShare = 0.016;  // capitals, of the picture's shorter side [ours]
constexpr double kLeastLetters = 7.0;   // px
constexpr double kBarLetters = 11.0;    // length of the bar in heights of a capital [ours]
/// Reads on white and on black pages.
constexpr Rgb8 kLegendInk{118, 120, 126};
/// Behind the legend where no corner is free.
constexpr Rgb8 kPlate{255, 255, 255};
constexpr double kPlateAlpha = 0.85;
constexpr Rgb8 kInkOnPlate{60, 62, 68};

/// A picture of ink with straight alpha.
struct Stamp {
  int width = 0;
  int height = 0;
  std::vector<std::array<double, 4>> pixels{};  // red, green, blue, alpha, each in [0, 1]

  [[nodiscard]] const std::array<double, 4>& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

std::array<double, 4> ink_of(const Rgb8& colour, double alpha) {
  return {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0, alpha};
}

/// A stamp with a plate behind it, `border` px wider all around.
Stamp on_plate(const Stamp& stamp, int border) {
  Stamp result;
  result.width = stamp.width + 2 * border;
  result.height = stamp.height + 2 * border;
  result.pixels.assign(
      static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height),
      ink_of(kPlate, kPlateAlpha));
  for (int y = 0; y < stamp.height; ++y) {
    for (int x = 0; x < stamp.width; ++x) {
      const auto& over = stamp.at(x, y);
      auto& under = result.pixels[static_cast<std::size_t>(y + border) *
                                      static_cast<std::size_t>(result.width) +
                                  static_cast<std::size_t>(x + border)];
      const double below = under[3] * (1.0 - over[3]);
      const double alpha = over[3] + below;
      for (std::size_t c = 0; c < 3; ++c) {
        under[c] = (over[c] * over[3] + under[c] * below) / alpha;
      }
      under[3] = alpha;
    }
  }
  return result;
}

Stamp legend_stamp(double letters, const Rgb8& ink) {
  constexpr std::string_view kLow = "low";
  constexpr std::string_view kHigh = "high";
  const double gap = 0.7 * letters;
  const double edge = 0.25 * letters;  // for the width of the strokes
  const double low = edge + letters * lettering_width(kLow);
  const double bar = std::round(kBarLetters * letters);
  const double bar_left = std::round(low + gap);
  const double high_left = bar_left + bar + gap;
  Stamp stamp;
  stamp.width = static_cast<int>(std::ceil(high_left + letters * lettering_width(kHigh) + edge));
  stamp.height = static_cast<int>(std::ceil(1.6 * letters));  // with descenders
  LineDrawing text(stamp.width, stamp.height);
  text.text(kLow, {edge, 1.1 * letters}, letters, {0, 0, 0});
  text.text(kHigh, {high_left, 1.1 * letters}, letters, {0, 0, 0});
  const Image letterforms = text.image();
  const int top = static_cast<int>(std::round(0.1 * letters));
  const int bottom = static_cast<int>(std::round(1.1 * letters));
  for (int y = 0; y < stamp.height; ++y) {
    for (int x = 0; x < stamp.width; ++x) {
      const double along = (x + 0.5 - bar_left) / bar;
      const bool is_bar = along > 0.0 && along < 1.0 && y >= top && y <= bottom;
      const double covered = 1.0 - letterforms.pixel(x, y)[0] / 255.0;
      stamp.pixels.push_back(is_bar ? ink_of(cool_warm(along), 1.0) : ink_of(ink, covered));
    }
  }
  return stamp;
}

template <class Picture>
struct Corner {
  Picture* picture;
  int left;
  int top;

  [[nodiscard]] auto* pixel(int x, int y) const {
    return picture->rgba.data() +
           4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture->width) +
                static_cast<std::size_t>(x));
  }

  /// Pixels of the stamp's place that are not background, which is what a row begins or ends with.
  [[nodiscard]] int covered(const Stamp& stamp) const {
    int count = 0;
    for (int y = top; y < top + stamp.height; ++y) {
      const auto* const first = pixel(0, y);
      const auto* const last = pixel(picture->width - 1, y);
      for (int x = left; x < left + stamp.width; ++x) {
        const auto* const here = pixel(x, y);
        count += std::equal(here, here + 4, first) || std::equal(here, here + 4, last) ? 0 : 1;
      }
    }
    return count;
  }

  void put(const Stamp& stamp) const {
    using Value = typename decltype(picture->rgba)::value_type;
    constexpr double kFull = std::numeric_limits<Value>::max();
    for (int y = 0; y < stamp.height; ++y) {
      for (int x = 0; x < stamp.width; ++x) {
        const auto& over = stamp.at(x, y);
        auto* const under = pixel(left + x, top + y);
        const double below = under[3] / kFull * (1.0 - over[3]);
        const double alpha = over[3] + below;
        for (std::size_t c = 0; c < 3 && alpha > 0.0; ++c) {
          const double mixed = (over[c] * over[3] + under[c] / kFull * below) / alpha;
          under[c] = static_cast<Value>(std::lround(mixed * kFull));
        }
        under[3] = static_cast<Value>(std::lround(alpha * kFull));
      }
    }
  }
};

template <class Picture>
void draw(Picture& picture) {
  if (picture.width < kLeastWidth || picture.height < kLeastHeight) {
    return;
  }
  const double letters =
      std::max(kLeastLetters, std::round(kLetterShare * std::min(picture.width, picture.height)));
  const Stamp stamp = legend_stamp(letters, kLegendInk);
  const int margin = static_cast<int>(std::round(1.5 * letters));
  const int right = picture.width - margin - stamp.width;
  const int bottom = picture.height - margin - stamp.height;
  if (right < margin || bottom < margin) {
    return;
  }
  const std::array<Corner<Picture>, 4> corners{{{&picture, right, bottom},
                                                {&picture, margin, bottom},
                                                {&picture, right, margin},
                                                {&picture, margin, margin}}};
  const auto& emptiest = *std::min_element(
      corners.begin(), corners.end(),
      [&](const auto& a, const auto& b) { return a.covered(stamp) < b.covered(stamp); });
  if (emptiest.covered(stamp) == 0) {
    emptiest.put(stamp);
    return;
  }
  const int border = margin / 2;
  const Corner<Picture> wider{&picture, emptiest.left - border, emptiest.top - border};
  wider.put(on_plate(legend_stamp(letters, kInkOnPlate), border));
}

}  // namespace

void draw_legend(Image& picture) {
  draw(picture);
}

void draw_legend(DeepImage& picture) {
  draw(picture);
}

}  // namespace vantage
