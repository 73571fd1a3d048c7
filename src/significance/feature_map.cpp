// SPDX-License-Identifier: MIT
#include "significance/feature_map.h"

#include <algorithm>
#include <limits>

namespace vantage {

NormalisedField normalised(const std::vector<double>& field, const std::vector<bool>& counted,
                           double flat_span) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  NormalisedField result;
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (counted[v]) {
      low = std::min(low, field[v]);
      if (field[v] > high) {
        high = field[v];
        result.maximum = v;
      }
    }
  }
  result.values.assign(field.size(), 0.0);
  result.flat = !(high - low > flat_span);
  if (!result.flat) {
    for (std::size_t v = 0; v < field.size(); ++v) {
      if (counted[v]) {
        result.values[v] = (field[v] - low) / (high - low);
      }
    }
  }
  return result;
}

double mean_without_maximum(const NormalisedField& field, const std::vector<bool>& counted,
                            const std::vector<double>& weight) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t v = 0; v < field.values.size(); ++v) {
    if (counted[v] && v != field.maximum) {
      sum += weight[v] * field.values[v];
      weights += weight[v];
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

double mean_of_local_maxima(const NormalisedField& field, const IndexLists& rings,
                            const std::vector<double>& weight) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t v = 0; v < field.values.size(); ++v) {
    const double value = field.values[v];
    const auto ring = rings[v];
    const bool peak = !ring.empty() && std::all_of(ring.begin(), ring.end(), [&](std::uint32_t u) {
      return field.values[u] < value;
    });
    if (peak && v != field.maximum) {
      sum += weight[v] * value;
      weights += weight[v];
    }
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace vantage
