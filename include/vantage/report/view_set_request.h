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

/// Names of ViewSelection.
inline constexpr const char* kSelectionWords = "kssm|vazquez|feixas";
/// "kssm", "vazquez" or "feixas".
std::string_view selection_name(ViewSelection selection);

/// Several views: how many, and chosen how.
struct ViewSetRequest {
  ViewSetOptions set{};                           ///< Number, coverage, separation.
  ViewSelection selection = ViewSelection::Kssm;  ///< The others look at `set.views` alone.
  double information = 0.0;  ///< Feixas: stop at this share of I(V;Z); 0: by number alone.
};

/// The table of ViewSetRequest.
inline constexpr auto kViewSetRequestFields = std::tuple{
    Part{&ViewSetRequest::set, kViewSetFields},
    Choice{"select", &ViewSetRequest::selection, kSelectionWords,
           "kssm: newly seen significance; vazquez: entropy of unseen faces; feixas: merging by "
           "mutual information"},
    Field{"information", &ViewSetRequest::information, 0.0, 1.0,
          "feixas: stop when the merged view's information falls to this share of the channel's"},
};

}  // namespace vantage
