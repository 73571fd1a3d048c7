// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "vantage/core/run_context.h"

#include "render/drawn_surface.h"
#include "render/fragment.h"

namespace vantage {

/// How much of the sky the surface sees, from probes at every second pixel of every second row. Each
/// is the mean over its neighbours on the same patch of the surface, so that their few rays count
/// together; between probes of one patch it is mixed linearly. Where all are open it stays exactly 1.
class OpennessGrid {
 public:
  /// Neighbours whose probes take part in a mean, across and along; as many sets of rays make one.
  static constexpr int kNeighbours = 3;

  /// Rows beside a pixel's that its value may depend on. Rows are handed over from an even one on.
  static constexpr int kHalo = 8;

  /// Openness of a place by the rays of one of kNeighbours² sets.
  using Probe = std::function<float(const SurfacePlace& place, std::size_t set)>;

  /// \param pixel size of a pixel at the surface, about. \throw Cancelled
  OpennessGrid(const FragmentRows& rows, double pixel, const Probe& probe, const RunContext& run);

  /// At a place that pixel (x, y) shows; nothing if no probe near it is on the same patch.
  [[nodiscard]] std::optional<float> at(const SurfacePlace& place, int x, int y) const;

  /// The set of rays of column x and row y of the grid, or of a picture.
  [[nodiscard]] static std::size_t set_of(int x, int y) {
    return static_cast<std::size_t>(kNeighbours) * static_cast<std::size_t>(y % kNeighbours) +
           static_cast<std::size_t>(x % kNeighbours);
  }

 private:
  struct Value {
    SurfacePlace place{};
    float openness = 1.0F;
    bool hit = false;
  };

  [[nodiscard]] const Value* value(int column, int row) const;
  [[nodiscard]] static const Fragment* shown(const FragmentRows& rows, int column, int row);
  [[nodiscard]] float smoothed(int column, int row) const;

  int columns_;
  int first_;  // row of the grid
  int rows_;
  float pixel_;
  std::vector<Value> values_{};
};

}  // namespace vantage
