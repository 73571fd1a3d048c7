// SPDX-License-Identifier: MIT
#include "result_names.h"

#include <algorithm>
#include <array>

namespace vantage::cli {
namespace {

constexpr std::array<std::string_view, 24> kOfView{"view.json",
                                                   "timings.json",
                                                   "report.html",
                                                   "map.ply",
                                                   "skeleton.json",
                                                   "best.png",
                                                   "worst.png",
                                                   "best-kssm.png",
                                                   "worst-kssm.png",
                                                   "best-skeleton.png",
                                                   "worst-skeleton.png",
                                                   "camera-best.gltf",
                                                   "camera-best.transforms.json",
                                                   "camera-best.f3d.txt",
                                                   "camera-best.model-viewer.html",
                                                   "camera-worst.gltf",
                                                   "camera-worst.transforms.json",
                                                   "camera-worst.f3d.txt",
                                                   "camera-worst.model-viewer.html",
                                                   "views.png",
                                                   "views.transforms.json",
                                                   "tour.gltf",
                                                   "tour.webp",
                                                   "tour.png"};
constexpr std::array<std::string_view, 7> kOfCompare{"compare.json", "compare.csv", "agreement.csv",
                                                     "sphere.csv",   "timings.csv", "sheet.png",
                                                     "index.html"};

template <std::size_t Size>
bool is_among(const std::array<std::string_view, Size>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether the name is `before`, a number and `after`.
bool is_numbered(std::string_view name, std::string_view before, std::string_view after) {
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) ||
      !name.ends_with(after)) {
    return false;
  }
  const std::string_view number =
      name.substr(before.size(), name.size() - before.size() - after.size());
  return number.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

bool is_view_file(std::string_view name) {
  return is_among(kOfView, name) || is_numbered(name, "view-", ".png") ||
         is_numbered(name, "camera-view-", ".gltf");
}

bool is_compare_file(std::string_view name) {
  return is_among(kOfCompare, name);
}

bool is_figure_file(std::string_view name) {
  constexpr std::string_view kBefore = "figure-";
  if (name == "views.png" || name == "table-1-times.csv" || name == "table-1-times.md") {
    return true;
  }
  const bool is_picture = name.ends_with(".png") || name.ends_with(".svg");
  return is_picture && name.size() > kBefore.size() && name.starts_with(kBefore) &&
         name[kBefore.size()] >= '1' && name[kBefore.size()] <= '9';
}

bool is_level_file(std::string_view name) {
  return is_numbered(name, "level-", ".ply");
}

}  // namespace vantage::cli
