// SPDX-License-Identifier: MIT
#include "report/label_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace vantage {
namespace {

using Point = Eigen::Vector2d;

// Strokes of our own on a grid with the baseline at 2, small letters up to 6, tall ones up to 9: two
// digits a point, x and y; a blank lifts the pen.
constexpr std::array<std::string_view, 26> kLetters{"4642 4536160503123243",        // a
                                                    "0902 0516364543321203",        // b
                                                    "4536160503123243",             // c
                                                    "4942 4536160503123243",        // d
                                                    "04444536160503123243",         // e
                                                    "39291812 0636",                // f
                                                    "4641301001 4536160503123243",  // g
                                                    "0902 0516364542",              // h
                                                    "0602 0808",                    // i
                                                    "161100 1818",                  // j
                                                    "0902 0436 1532",               // k
                                                    "0902",                         // l
                                                    "0602 0516263532 3546566562",   // m
                                                    "0602 0516364542",              // n
                                                    "163645433212030516",           // o
                                                    "0600 0516364543321203",        // p
                                                    "4640 4536160503123243",        // q
                                                    "0602 051636",                  // r
                                                    "45361605143443321203",         // s
                                                    "18132232 0636",                // t
                                                    "0603123243 4642",              // u
                                                    "062246",                       // v
                                                    "0612355266",                   // w
                                                    "0642 0246",                    // x
                                                    "0622 4610",                    // y
                                                    "06460242"};                    // z
constexpr std::array<std::string_view, 10> kDigits{
    "193948433212030819",       "081912",   "08193948470242",
    "0949263645433212 1203",    "32390444", "490906364543 433202",
    "4839190803123243453606",   "094912",   "16070819394847361605031232434536",
    "03123243483919080716 1646"};
constexpr double kUnitPx = 2.0;  // of the grid
constexpr double kPenPx = 1.0;   // half the width of a stroke
constexpr int kDescent = 2;      // units below the baseline
constexpr int kTall = 9;         // units of the grid
constexpr int kGapUnits = 2;     // between letters
constexpr int kSpaceUnits = 3;   // a blank
constexpr double kInk = 30.0;    // grey level
static_assert(kTextHeight >= static_cast<int>(kTall * kUnitPx) + kDescent);

std::string_view strokes_of(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (std::isdigit(byte) != 0) {
    return kDigits[static_cast<std::size_t>(c - '0')];
  }
  if (std::isalpha(byte) != 0) {
    return kLetters[static_cast<std::size_t>(std::tolower(byte) - 'a')];
  }
  return c == '-' ? "0434" : c == '.' ? "0202" : "";
}

int width_units(char c) {
  int width = -1;
  const std::string_view strokes = strokes_of(c);
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    if (strokes[i] != ' ') {
      width = std::max(width, strokes[i] - '0');
      ++i;  // over y
    }
  }
  return width < 0 ? kSpaceUnits : width + kGapUnits;
}

struct Stroke {
  Point from = Point::Zero();
  Point to = Point::Zero();
};

/// Strokes of a text in px from its left top corner.
std::vector<Stroke> strokes_of_text(std::string_view text) {
  std::vector<Stroke> strokes;
  int left = 1;
  for (const char c : text) {
    const std::string_view code = strokes_of(c);
    bool is_down = false;
    Point last = Point::Zero();
    for (std::size_t i = 0; i < code.size(); ++i) {
      if (code[i] == ' ') {
        is_down = false;
        continue;
      }
      const Point here(kUnitPx * (left + code[i] - '0'),
                       kUnitPx * (kTall - (code[i + 1] - '0')) + 2);
      if (is_down) {
        strokes.push_back({last, here});
      }
      last = here;
      is_down = true;
      ++i;
    }
    left += width_units(c);
  }
  return strokes;
}

double distance_to(const Stroke& stroke, const Point& p) {
  const Point way = stroke.to - stroke.from;
  const double square = way.squaredNorm();
  const double t = square > 0.0 ? std::clamp((p - stroke.from).dot(way) / square, 0.0, 1.0) : 0.0;
  return (p - stroke.from - t * way).norm();
}

}  // namespace

int text_width(std::string_view text) {
  int units = 2;
  for (const char c : text) {
    units += width_units(c);
  }
  return static_cast<int>(std::ceil(kUnitPx * units));
}

void write_text(Image& image, std::string_view text, int left, int top) {
  const int width = text_width(text);
  std::vector<double> ink(static_cast<std::size_t>(width) * kTextHeight, 0.0);
  for (const Stroke& stroke : strokes_of_text(text)) {
    const double reach = kPenPx + 1.0;
    const Point low = stroke.from.cwiseMin(stroke.to).array() - reach;
    const Point high = stroke.from.cwiseMax(stroke.to).array() + reach;
    for (int y = std::max(0, static_cast<int>(low.y()));
         y < std::min<double>(kTextHeight, high.y()); ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x < std::min<double>(width, high.x());
           ++x) {
        double& here = ink[static_cast<std::size_t>(y * width + x)];
        here = std::max(here, kPenPx + 0.5 - distance_to(stroke, Point(x, y)));
      }
    }
  }
  for (int y = 0; y < kTextHeight && top + y < image.height; ++y) {
    for (int x = 0; x < width && left + x < image.width; ++x) {
      const double cover = std::clamp(ink[static_cast<std::size_t>(y * width + x)], 0.0, 1.0);
      const auto at = static_cast<std::size_t>(image.pixel(left + x, top + y) - image.rgba.data());
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const double old = image.rgba[at + channel];
        image.rgba[at + channel] =
            static_cast<std::uint8_t>(std::lround(old + cover * (kInk - old)));
      }
    }
  }
}

}  // namespace vantage
