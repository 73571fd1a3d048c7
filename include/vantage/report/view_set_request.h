// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "vantage/core/fields.h"
#include "vantage/view/view_set.h"

/// \file
/// What is asked for when several views are wanted. docs/view_sets.md.

namespace vantage {

/// How several views are chosen.
enum class ViewSelection {
  Kssm,     ///< The best view, then greedy by newly seen significance.
  Vazquez,  ///< Greedy by the entropy of faces not yet seen.
  Feixas,   ///< Greedy merge by viewpoint mutual information.
};

/// "kssm", "vazquez" or "feixas".
std::string_view selection_name(ViewSelection selection);

/// Several views: how many, and chosen how.
struct ViewSetRequest {
  ViewSetOptions set{};                           ///< Number, coverage, separation.
  ViewSelection selection = ViewSelection::Kssm;  ///< The others look at `set.views` alone.
  double information = 0.0;  ///< Feixas: stop at this share of I(V;Z); 0: by number alone.
};

/// Names, ranges and help of the numbers in ViewSetRequest itself.
inline constexpr auto kViewSetRequestFields = std::tuple{
    Field{"information", &ViewSetRequest::information, 0.0, 1.0,
          "feixas: stop when the merged view's information falls to this share of the channel's"},
};

}  // namespace vantage
