// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "vantage/mesh/topology.h"

/// \file
/// What KSSM and mesh saliency share: scaling a field to [0, 1] and lowering fields that have
/// many comparable peaks, after Itti, Koch, Niebur 1998.

namespace vantage {

/// A field scaled to [0, 1] over the vertices that count.
struct NormalisedField {
  std::vector<double> values{};  ///< In [0, 1]; 0 for vertices that do not count.
  std::size_t maximum = 0;       ///< Lowest-index vertex that attains 1.
  bool flat = true;              ///< Spans too little to be more than rounding; values are 0.
};

/// Scales `field` to [0, 1]; it is flat unless it spans more than `flat_span`.
NormalisedField normalised(const std::vector<double>& field, const std::vector<bool>& counted,
                           double flat_span);

/// Weighted mean over the vertices that count, the one that attains the maximum left out.
double mean_without_maximum(const NormalisedField& field, const std::vector<bool>& counted,
                            const std::vector<double>& weight);

/// Weighted mean over the strict local maxima over one-rings, the global maximum left out; 0 if
/// there is none.
double mean_of_local_maxima(const NormalisedField& field, const IndexLists& rings,
                            const std::vector<double>& weight);

}  // namespace vantage
