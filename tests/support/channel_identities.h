// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "vantage/view/measure.h"

namespace vantage::test {

/// The measures of the channel between views and faces, whose averages are known (MEASURES).
inline std::vector<Measure> channel_measures() {
  return {find_measure("vmi"), find_measure("i2"), find_measure("i3"),
          find_measure("viewpoint-entropy"), find_measure("instability")};
}

/// H(Z) and I(V;Z) of a set of views, and H(Z|v) of each, all from areas alone: sums over p log p
/// as they are defined, and nothing of the program's own.
struct Entropies {
  double of_faces = 0.0;
  double mutual_information = 0.0;
  std::vector<double> of_view{};
};

inline Entropies entropies_of(std::span<const std::vector<FaceArea>> views, std::size_t faces) {
  std::vector<double> of_face(faces, 0.0);
  double total = 0.0;
  for (const auto& view : views) {
    for (const FaceArea& a : view) {
      of_face[a.face] += a.area;
      total += a.area;
    }
  }
  const auto minus_p_log_p = [](double p) { return p > 0.0 ? -p * std::log2(p) : 0.0; };
  Entropies result;
  for (const double area : of_face) {
    result.of_faces += minus_p_log_p(area / total);
  }
  for (const auto& view : views) {
    double seen = 0.0;
    for (const FaceArea& a : view) {
      seen += a.area;
    }
    result.of_view.push_back(0.0);
    for (const FaceArea& a : view) {
      const double p = a.area / seen;
      result.of_view.back() += minus_p_log_p(p);
      result.mutual_information += a.area / total * std::log2(p / (of_face[a.face] / total));
    }
  }
  return result;
}

/// Expects of the set's views, measured by `channel_measures`, what holds for any set: the averages
/// of VMI, I2 and I3 over the views are the mutual information, I2 and a view's entropy add up to
/// the entropy of the faces, entropy is at most the logarithm of the count, instability is in [0, 1].
inline void expect_channel_identities(ViewMeasurer& measurer) {
  constexpr double kBits = 1e-9;
  const MeasureValues values = measurer.set_values();
  const MeasuredModel& model = measurer.model();
  const Entropies expected = entropies_of(model.set_views, model.face_areas.size());
  double total = 0.0;
  double vmi = 0.0;
  double i2 = 0.0;
  double i3 = 0.0;
  for (std::size_t i = 0; i < model.set_views.size(); ++i) {
    const double area = model.terms.area_of_view[i];
    total += area;
    vmi += area * values[0][i];
    i2 += area * values[1][i];
    i3 += area * values[2][i];
    EXPECT_NEAR(values[3][i], expected.of_view[i], kBits);
    EXPECT_NEAR(values[1][i] + expected.of_view[i], expected.of_faces, kBits);
    EXPECT_GE(values[0][i], 0.0);
    const auto faces = static_cast<double>(model.set_views[i].size());
    EXPECT_LE(values[3][i], std::log2(faces) + kBits);
    EXPECT_GE(values[4][i], 0.0);
    EXPECT_LE(values[4][i], 1.0);
  }
  EXPECT_NEAR(vmi / total, expected.mutual_information, kBits);
  EXPECT_NEAR(i2 / total, expected.mutual_information, kBits);
  EXPECT_NEAR(i3 / total, expected.mutual_information, kBits);
  EXPECT_NEAR(model.terms.mutual_information, expected.mutual_information, kBits);
  EXPECT_NEAR(model.terms.entropy_of_faces, expected.of_faces, kBits);
}

/// Expects that the set's views tell no more where every two faces become one, again and again until
/// one is left: splitting a face never lowers I(V;Z).
inline void expect_merging_tells_no_more(const MeasuredModel& model) {
  constexpr double kBits = 1e-9;
  ViewChannel channel{model.face_areas.size(), {model.set_views.begin(), model.set_views.end()}};
  TriMesh mesh = *model.given.surface;  // only the number of its faces matters
  double before = model.terms.mutual_information;
  EXPECT_GT(before, 0.0);
  while (channel.face_count > 1) {
    for (auto& view : channel.views) {
      std::vector<FaceArea> merged;
      for (const FaceArea& a : view) {
        if (!merged.empty() && merged.back().face == a.face / 2) {
          merged.back().area += a.area;
        } else {
          merged.push_back({a.face / 2, a.area});
        }
      }
      view = std::move(merged);
    }
    channel.face_count = (channel.face_count + 1) / 2;
    mesh.triangles.resize(channel.face_count);
    const double after = channel_terms(channel, mesh).mutual_information;
    EXPECT_LE(after, before + kBits) << channel.face_count << " faces";
    before = after;
  }
  EXPECT_NEAR(before, 0.0, kBits);  // one face tells nothing
}

}  // namespace vantage::test
