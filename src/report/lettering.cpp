// SPDX-License-Identifier: MIT
#include "report/lettering.h"

#include <algorithm>
#include <cstddef>

namespace vantage {
namespace {

/// Letters stand on a grid of 5 × 9: columns 0–4; rows 0–1 below the baseline, 2 the baseline, 6 the
/// height of small letters, 8 that of capitals. Two digits are a point, "|" begins a new stroke.
constexpr std::string_view kFirst = " ";
constexpr std::array<std::string_view, 95> kGlyphs{
    "",                                    // space
    "2824|2222",                           // !
    "1816|3836",                           // "
    "1217|3237|0434|0636",                 // #
    "47071605354413|2822",                 // $
    "0248|0818170708|3242433332",          // %
    "42061728270513223244",                // &
    "2826",                                // '
    "38262432",                            // (
    "18262412",                            // )
    "0446|0644|2723",                      // *
    "0545|2723",                           // +
    "2211",                                // ,
    "1535",                                // -
    "2222",                                // .
    "0248",                                // /
    "183847433212030718",                  // 0
    "072822|1232",                         // 1
    "07183847460242",                      // 2
    "071838474635|15354443321203",         // 3
    "32380444",                            // 4
    "480805354443321203",                  // 5
    "473818070312324344351504",            // 6
    "084812",                              // 7
    "1535464738180706150403123243443515",  // 8
    "03123243473818070615353546",          // 9
    "2626|2222",                           // :
    "2626|2211",                           // ;
    "460442",                              // <
    "0444|0646",                           // =
    "064402",                              // >
    "07183847462524|2222",                 // ?
    "35251424344645381807031242",          // @
    "022842|1434",                         // A
    "02083847463505|3544433202",           // B
    "4738180703123243",                    // C
    "02082846442202",                      // D
    "48080242|0535",                       // E
    "480802|0535",                         // F
    "47381807031232434525",                // G
    "0208|4248|0545",                      // H
    "1232|2228|1838",                      // I
    "4843321203",                          // J
    "0208|480542",                         // K
    "080242",                              // L
    "0208254842",                          // M
    "02084248",                            // N
    "183847433212030718",                  // O
    "02083847463505",                      // P
    "183847433212030718|2442",             // Q
    "02083847463505|2542",                 // R
    "473818070615354443321203",            // S
    "0848|2822",                           // T
    "080312324348",                        // U
    "082248",                              // V
    "0812253248",                          // W
    "0248|0842",                           // X
    "082548|2522",                         // Y
    "08480242",                            // Z
    "38282232",                            // [
    "0842",                                // backslash
    "18282212",                            // ]
    "062846",                              // ^
    "0141",                                // _
    "1827",                                // `
    "16364542|441403123243",               // a
    "0802|0516364543321203",               // b
    "4536160503123243",                    // c
    "4842|4536160503123243",               // d
    "04444536160503123243",                // e
    "38281712|0636",                       // f
    "4641301001|4536160503123243",         // g
    "0802|0516364542",                     // h
    "2622|2828",                           // i
    "26211001|2828",                       // j
    "0802|360432",                         // k
    "282332",                              // l
    "0602|05162522|25364542",              // m
    "0602|0516364542",                     // n
    "163645433212030516",                  // o
    "0600|0516364543321203",               // p
    "4640|4536160503123243",               // q
    "0602|05163645",                       // r
    "45361605143443321203",                // s
    "282332|1636",                         // t
    "0603123243|4642",                     // u
    "062246",                              // v
    "0612243246",                          // w
    "0642|0246",                           // x
    "0622|4610",                           // y
    "06460242",                            // z
    "38271625141232",                      // {
    "2820",                                // |
    "18273625341212",                      // }
    "05163545",                            // ~
};
constexpr double kUnit = 1.0 / 6.0;  ///< Rows between baseline and cap height.
constexpr double kNarrow = 0.85;     ///< Columns are so much narrower than rows.
constexpr double kGap = 2.2;         ///< Columns between two letters.
constexpr double kSpace = 3.2;       ///< Width of a space, columns.

std::string_view glyph(char c) {
  const auto index = static_cast<std::size_t>(static_cast<unsigned char>(c)) -
                     static_cast<std::size_t>(kFirst.front());
  return index < kGlyphs.size() ? kGlyphs[index] : std::string_view{};
}

/// First and last column that a letter touches.
std::array<int, 2> columns_of(std::string_view points) {
  std::array<int, 2> range{4, 0};
  bool is_column = true;
  for (const char c : points) {
    if (c < '0' || c > '9') {
      continue;
    }
    if (is_column) {
      range = {std::min(range[0], c - '0'), std::max(range[1], c - '0')};
    }
    is_column = !is_column;
  }
  return range;
}

double advance_of(char c) {
  const std::string_view points = glyph(c);
  if (points.empty()) {
    return kSpace * kNarrow * kUnit;
  }
  const auto [first, last] = columns_of(points);
  return (last - first + kGap) * kNarrow * kUnit;
}

}  // namespace

std::vector<Stroke> letter_strokes(std::string_view text) {
  constexpr int kBaseline = 2;
  std::vector<Stroke> strokes;
  double left = 0.0;
  for (const char c : text) {
    const std::string_view points = glyph(c);
    const int first = columns_of(points)[0];
    bool opens = true;
    int column = -1;
    for (const char digit : points) {
      if (digit == '|') {
        opens = true;
      } else if (digit != ' ' && column < 0) {
        column = digit - '0';
      } else if (digit != ' ') {
        if (opens) {
          strokes.emplace_back();
        }
        opens = false;
        strokes.back().push_back(
            {left + (column - first) * kNarrow * kUnit, (digit - '0' - kBaseline) * kUnit});
        column = -1;
      }
    }
    left += advance_of(c);
  }
  return strokes;
}

double lettering_width(std::string_view text) {
  double width = 0.0;
  for (const char c : text) {
    width += advance_of(c);
  }
  return width;
}

}  // namespace vantage
