// SPDX-License-Identifier: MIT
#include "render/openness_grid.h"

#include "core/parallel.h"

namespace vantage {
namespace {

/// Pixels from probe to probe. [ours]: half as many a side, with four times the rays each, see the
/// same for a quarter of the work around them.
constexpr int kStep = 2;
/// How far from the plane of a probe its neighbours may lie, and what asks it, px. [ours]
constexpr float kNearPx = 1.5F;
constexpr float kSamePatchPx = 2.0F;

}  // namespace

const OpennessGrid::Value* OpennessGrid::value(int column, int row) const {
  if (column < 0 || column >= columns_ || row < first_ || row >= first_ + rows_) {
    return nullptr;
  }
  const Value& found =
      values_[static_cast<std::size_t>(row - first_) * static_cast<std::size_t>(columns_) +
              static_cast<std::size_t>(column)];
  return found.hit ? &found : nullptr;
}

/// What a cell of the grid shows: its first pixel that shows the surface.
const Fragment* OpennessGrid::shown(const FragmentRows& rows, int column, int row) {
  for (int y = kStep * row; y < kStep * (row + 1); ++y) {
    for (int x = kStep * column; x < kStep * (column + 1); ++x) {
      if (rows.has(x, y) && rows.at(x, y).hit) {
        return &rows.at(x, y);
      }
    }
  }
  return nullptr;
}

OpennessGrid::OpennessGrid(const FragmentRows& rows, double pixel, const Probe& probe,
                           const RunContext& run)
    : columns_((rows.width + kStep - 1) / kStep),
      first_(rows.first_row / kStep),
      rows_((rows.first_row + rows.rows + kStep - 1) / kStep - first_),
      pixel_(static_cast<float>(pixel)) {
  const auto columns = static_cast<std::size_t>(columns_);
  values_.resize(columns * static_cast<std::size_t>(rows_));
  std::vector<float> means(values_.size(), 1.0F);
  const auto for_cells = [&](const auto& body) {
    parallel_for(run, static_cast<std::size_t>(rows_), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin * columns; i < end * columns; ++i) {
        body(i, static_cast<int>(i % columns), first_ + static_cast<int>(i / columns));
      }
    });
  };
  for_cells([&](std::size_t i, int column, int row) {
    if (const Fragment* fragment = shown(rows, column, row)) {
      values_[i] = {fragment->place, probe(fragment->place, set_of(column, row)), true};
    }
  });
  for_cells([&](std::size_t i, int column, int row) {
    means[i] = values_[i].hit ? smoothed(column, row) : 1.0F;
  });
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].openness = means[i];
  }
}

float OpennessGrid::smoothed(int column, int row) const {
  constexpr int kRadius = kNeighbours / 2;
  const Value& centre = *value(column, row);
  float closed = 0.0F;
  float count = 0.0F;
  for (int j = row - kRadius; j <= row + kRadius; ++j) {
    for (int i = column - kRadius; i <= column + kRadius; ++i) {
      const Value* other = value(i, j);
      if (other != nullptr && same_patch(centre.place, other->place, kNearPx * pixel_)) {
        closed += 1.0F - other->openness;
        count += 1.0F;
      }
    }
  }
  return count > 0.0F ? 1.0F - closed / count : centre.openness;
}

std::optional<float> OpennessGrid::at(const SurfacePlace& place, int x, int y) const {
  const int column = x / kStep;
  const int row = y / kStep;
  const float right = static_cast<float>(x % kStep) / kStep;
  const float below = static_cast<float>(y % kStep) / kStep;
  float closed = 0.0F;
  float weights = 0.0F;
  const auto add = [&](int i, int j, float weight) {
    const Value* other = value(column + i, row + j);
    if (weight > 0.0F && other != nullptr &&
        same_patch(other->place, place, kSamePatchPx * pixel_)) {
      closed += weight * (1.0F - other->openness);
      weights += weight;
    }
  };
  add(0, 0, (1.0F - right) * (1.0F - below));
  add(1, 0, right * (1.0F - below));
  add(0, 1, (1.0F - right) * below);
  add(1, 1, right * below);
  if (weights == 0.0F) {
    for (int j = -1; j <= 2; ++j) {
      for (int i = -1; i <= 2; ++i) {
        add(i, j, 1.0F);
      }
    }
  }
  return weights > 0.0F ? std::optional(1.0F - closed / weights) : std::nullopt;
}

}  // namespace vantage
