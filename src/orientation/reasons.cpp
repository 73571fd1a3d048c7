// SPDX-License-Identifier: MIT
#include "orientation/reasons.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vantage {
namespace {

// Mirror planes of things as they are built and scanned. [ours]
constexpr double kMirror = 0.15;
// Rain that a tub holds, over its height. [ours]
constexpr double kHollow = 0.15;

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(parts.size(), 2); ++i) {
    text += (i == 0 ? "its " : " and its ") + parts[i];
  }
  return text;
}

}  // namespace

std::string reasons_for_up(const Evidence& evidence) {
  const auto value = [&](std::string_view name) { return value_of(name, evidence); };
  std::vector<std::string> parts;
  const bool stands = value("base_margin") > 0.05;
  if (stands && value("base_touch") > 0.5) {
    parts.emplace_back("flat base");
  } else if (stands && value("base_contacts") >= 2.0) {  // log2(1 + 3)
    parts.emplace_back("feet");
  } else if (stands) {
    parts.emplace_back("stable stand");
  }
  if (value("water") > kHollow && value("base_water") < 0.2 * kHollow) {
    parts.emplace_back("hollow above");
  }
  if (value("mirror_most") < kMirror) {
    parts.emplace_back("two upright mirror planes");
  } else if (value("mirror_least") < kMirror) {
    parts.emplace_back("upright mirror plane");
  }
  if (std::abs(value("origin_height")) < 0.01) {
    parts.emplace_back("origin on the ground");
  }
  if (value("area_height") < 0.45) {
    parts.emplace_back("low centre");
  }
  return joined(parts);
}

std::string reasons_for_front(const Evidence& evidence) {
  const auto value = [&](std::string_view name) { return value_of(name, evidence); };
  std::vector<std::string> parts;
  if (value("net_ahead") > kOneSided) {
    parts.emplace_back("open back");
  }
  if (value("mirror_side") < kMirror) {
    parts.emplace_back("mirror plane");
  }
  if (value("back_touch") > 0.5 && value("back_touch") > value("front_touch")) {
    parts.emplace_back("flat back");
  }
  if (value("front_detail") > 1.2 * value("back_detail")) {
    parts.emplace_back("detailed front");
  }
  if (value("high_ahead") < -0.1) {
    parts.emplace_back("high back");
  }
  return joined(parts);
}

}  // namespace vantage
