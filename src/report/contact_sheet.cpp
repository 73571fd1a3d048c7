// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "vantage/render/render.h"
#include "vantage/report/comparison.h"
#include "vantage/report/view_report.h"

#include "report/lettering.h"
#include "report/line_drawing.h"
#include "report/view_sphere_pictures.h"

namespace vantage {
namespace {

constexpr int kTileWidth = 240;    // px
constexpr int kTileHeight = 180;   // px
constexpr int kGapPx = 8;          // px
constexpr int kTextHeight = 22;    // px, a line with its descenders
constexpr double kLetters = 11.0;  // px, height of capitals
constexpr int kInset = 2;          // px beside a text, so that no stroke is cut
constexpr int kLabelPx = kTextHeight + kGapPx;
constexpr int kTiles = 3;       // best, worst, sphere
constexpr int kMethodRows = 9;  // methods below each other
constexpr Rgb8 kWhite{255, 255, 255};
constexpr Rgb8 kInk{40, 40, 44};

int text_width(std::string_view text) {
  return static_cast<int>(std::ceil(kLetters * lettering_width(text))) + 2 * kInset;
}

/// A white picture that others are put on.
class Sheet {
 public:
  Sheet(int width, int height) {
    image_.width = width;
    image_.height = height;
    image_.rgba.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255);
  }

  void place(const Image& tile, int left, int top) {
    for (int y = 0; y < tile.height; ++y) {
      std::copy_n(tile.pixel(0, y), 4 * static_cast<std::size_t>(tile.width), at(left, top + y));
    }
  }

  /// What does not fit before the right border is cut off.
  void write(std::string_view text, int left, int top) {
    LineDrawing strip(std::min(text_width(text), image_.width - left), kTextHeight);
    strip.text(text, {kInset, 1.5 * kLetters}, kLetters, kInk);
    place(strip.image(), left, top);
  }

  Image take() { return std::move(image_); }

 private:
  std::uint8_t* at(int x, int y) {
    return image_.rgba.data() + (image_.pixel(x, y) - image_.rgba.data());
  }

  Image image_{};
};

}  // namespace

Image comparison_sheet(const ShapeAnalysis& shape, const Comparison& comparison, UpAxis up,
                       const ViewOptions& options, const RunContext& run, const PictureLook& look) {
  const int count = static_cast<int>(comparison.methods.size());
  const int rows = std::min(count, kMethodRows);
  const int columns = (count + kMethodRows - 1) / kMethodRows;
  const int block_width = kTiles * (kTileWidth + kGapPx) + 2 * kGapPx;
  const int block_height = kLabelPx + kTileHeight + kGapPx;
  const int header = kLabelPx + kGapPx;
  Sheet sheet(columns * block_width, header + rows * block_height + kGapPx);
  constexpr std::array<std::string_view, kTiles> kTitles{"best view", "worst view", "all views"};
  const RunContext quiet = run.quiet();
  const ViewOptions small = with_size(options, {kTileWidth, kTileHeight});
  ShapePictures pictures(shape, look.on(kWhite));
  const auto picture = [&](const MeasuredView& view) {
    const Camera framed = frame_picture(shape, view.direction, up, small).camera;
    constexpr std::array kPlain{Picture::Plain};
    return std::move(pictures.take(framed, kPlain, small, {}, quiet).front());
  };
  const ViewSpherePictures spheres(shape, comparison, up, kTileWidth, kTileHeight, quiet);
  for (int m = 0; m < count; ++m) {
    run.advance("pictures", static_cast<double>(m) / count);
    const ComparedMethod& method = comparison.methods[static_cast<std::size_t>(m)];
    const int left = m / kMethodRows * block_width + kGapPx;
    const int top = header + m % kMethodRows * block_height;
    sheet.write(method.measure.name, left, top);
    const std::array<Image, kTiles> tiles{picture(method.views.best), picture(method.views.worst),
                                          spheres.of(method)};
    for (int t = 0; t < kTiles; ++t) {
      const auto tile = static_cast<std::size_t>(t);
      const int x = left + t * (kTileWidth + kGapPx);
      sheet.place(tiles[tile], x, top + kLabelPx);
      if (m % kMethodRows == 0) {
        sheet.write(kTitles[tile], x + (kTileWidth - text_width(kTitles[tile])) / 2, kGapPx);
      }
    }
  }
  return sheet.take();
}

}  // namespace vantage
