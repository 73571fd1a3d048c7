// SPDX-License-Identifier: MIT
#include "report/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "vantage/core/error.h"
#include "vantage/report/figures.h"

#include "report/lettering.h"
#include "report/line_drawing.h"

namespace vantage {
namespace {

constexpr int kGapPx = 8;
/// Height of capitals over the panel's width, and the least, px. [ours]
constexpr double kLetterShare = 0.036;
constexpr double kLeastLetters = 6.0;
constexpr Rgb8 kInk{40, 40, 44};

void place(const Image& tile, Image& sheet, int left, int top) {
  for (int y = 0; y < tile.height; ++y) {
    const auto at = sheet.pixel(left, top + y) - sheet.rgba.data();
    std::copy_n(tile.pixel(0, y), std::size_t{4} * static_cast<std::size_t>(tile.width),
                sheet.rgba.begin() + at);
  }
}

Image white(int width, int height) {
  return {width, height,
          std::vector<std::uint8_t>(
              4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255)};
}

}  // namespace

std::string percent_text(double share) {
  const long tenths = std::lround(1000.0 * share);
  return std::to_string(tenths / 10) + "." + std::to_string(std::abs(tenths % 10)) + " %";
}

Image with_caption(const Image& panel, std::string_view text) {
  const double wanted = std::max(kLeastLetters, kLetterShare * panel.width);
  const double fitting = 0.96 * panel.width / std::max(lettering_width(text), 1e-9);
  const double letters = std::min(wanted, fitting);
  const int strip_height = static_cast<int>(std::ceil(2.0 * wanted));
  LineDrawing strip(panel.width, strip_height);
  strip.text(text, {0.5 * (panel.width - letters * lettering_width(text)), 1.5 * wanted}, letters,
             kInk);
  Image image = white(panel.width, panel.height + strip_height);
  place(panel, image, 0, 0);
  place(strip.image(), image, 0, panel.height);
  return image;
}

Image caption(std::string_view text, int width, int height) {
  constexpr double kLetters = 0.5;  // height of capitals over the strip's
  const double letters = kLetters * height;
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80U) {  // no further byte of a letter
      line += byte < 0x20 || byte > 0x7E ? '?' : c;
    }
  }
  const std::string whole = line;
  const auto is_too_long = [&] { return letters * lettering_width(line) > 0.96 * width; };
  for (std::size_t kept = whole.size(); is_too_long() && kept > 2;) {
    --kept;
    line = whole.substr(0, kept / 2) + "..." + whole.substr(whole.size() - (kept - kept / 2));
  }
  LineDrawing strip(width, height);
  strip.text(line, {0.5 * (width - letters * lettering_width(line)), 0.75 * height}, letters, kInk);
  return strip.image();
}

Image in_rows(const std::vector<Image>& panels, std::size_t columns) {
  if (panels.empty()) {
    throw InvalidInput("a figure needs a panel");
  }
  columns = std::min(columns, panels.size());
  const int width = panels.front().width;
  const int height = panels.front().height;
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  Image sheet = white(static_cast<int>(columns) * (width + kGapPx) + kGapPx,
                      static_cast<int>(rows) * (height + kGapPx) + kGapPx);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels[i].width != width || panels[i].height != height) {
      throw InvalidInput("the panels of a figure must be of one size");
    }
    place(panels[i], sheet, kGapPx + static_cast<int>(i % columns) * (width + kGapPx),
          kGapPx + static_cast<int>(i / columns) * (height + kGapPx));
  }
  return sheet;
}

}  // namespace vantage
