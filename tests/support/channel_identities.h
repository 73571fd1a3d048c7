// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/view/measurer.h"

namespace vantage::test {

/// The measures of the channel between views and faces, whose averages are known (MEASURES).
inline std::vector<Measure> channel_measures() {
  return {find_measure("vmi"), find_measure("i2"), find_measure("i3"),
          find_measure("viewpoint-entropy"), find_measure("instability")};
}

/// Expects of the set's views, measured by `channel_measures`, what holds for any set: the averages
/// of VMI, I2 and I3 over the views are the mutual information, I2 and the views' entropy add up to
/// the entropy of the faces, entropy is at most the logarithm of the count, instability is in [0, 1].
inline void expect_channel_identities(ViewMeasurer& measurer) {
  constexpr double kBits = 1e-9;
  const MeasureValues values = measurer.set_values();
  const ChannelTerms& terms = measurer.model().terms;
  double total = 0.0;
  double vmi = 0.0;
  double i2 = 0.0;
  double i3 = 0.0;
  for (std::size_t i = 0; i < terms.area_of_view.size(); ++i) {
    const double area = terms.area_of_view[i];
    total += area;
    vmi += area * values[0][i];
    i2 += area * values[1][i];
    i3 += area * values[2][i];
    EXPECT_NEAR(values[1][i] + values[3][i], terms.entropy_of_faces, kBits);
    EXPECT_GE(values[0][i], 0.0);
    const auto faces = static_cast<double>(measurer.model().set_views[i].size());
    EXPECT_LE(values[3][i], std::log2(faces) + kBits);
    EXPECT_GE(values[4][i], 0.0);
    EXPECT_LE(values[4][i], 1.0);
  }
  EXPECT_NEAR(vmi / total, terms.mutual_information, kBits);
  EXPECT_NEAR(i2 / total, terms.mutual_information, kBits);
  EXPECT_NEAR(i3 / total, terms.mutual_information, kBits);
}

}  // namespace vantage::test
