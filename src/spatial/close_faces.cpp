// SPDX-License-Identifier: MIT
#include "spatial/close_faces.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <vector>

#include "core/wide_registers.h"

namespace vantage {
namespace {

// Boxes under one box of the next level.
constexpr std::size_t kFan = 8;
constexpr unsigned kBoxesAtOnce = 4;  // compared at a time
// More than rounding a coordinate of a UnitFrame to float.
constexpr float kRoundedBy = 0x1p-22F;
constexpr float kEmpty = std::numeric_limits<float>::infinity();

/// Boxes of one level, padded to whole fans by empty ones.
struct Boxes {
  using Axis = std::vector<float>;

  std::array<Axis, 3> low{}, high{};
  std::size_t count = 0;

  explicit Boxes(std::size_t boxes) : count(boxes) {
    const std::size_t padded = (boxes + kFan - 1) / kFan * kFan;
    low.fill(Axis(padded, kEmpty));
    high.fill(Axis(padded, -kEmpty));
  }

  /// Bit i is set if box `one` overlaps box `first` + i of `others`.
  [[nodiscard]] unsigned overlaps(std::size_t one, const Boxes& others, std::size_t first) const {
    return overlaps_some(one, others, first) | overlaps_some(one, others, first + kBoxesAtOnce)
                                                   << kBoxesAtOnce;
  }

 private:
  [[nodiscard]] unsigned overlaps_some(std::size_t one, const Boxes& others,
                                       std::size_t first) const {
    using Floats = Registers<kBoxesAtOnce>::Floats;
    using Truths = Registers<kBoxesAtOnce>::Truths;
    const auto load = [&](const Axis& axis) {
      Floats floats;
      std::memcpy(&floats, axis.data() + first, sizeof floats);
      return floats;
    };
    Truths apart{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      apart |=
          (load(others.high[axis]) < low[axis][one]) | (high[axis][one] < load(others.low[axis]));
    }
    const Truths bits = ~apart & Truths{1, 2, 4, 8};
    return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
  }
};

Boxes boxes_of_faces(const TriMesh& mesh) {
  Boxes boxes(mesh.triangles.size());
  for (std::size_t f = 0; f < boxes.count; ++f) {
    for (const std::uint32_t v : mesh.triangles[f]) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<float>(mesh.positions[v][axis]);
        float& low = boxes.low[static_cast<std::size_t>(axis)][f];
        float& high = boxes.high[static_cast<std::size_t>(axis)][f];
        low = std::min(low, at - kRoundedBy);
        high = std::max(high, at + kRoundedBy);
      }
    }
  }
  return boxes;
}

Boxes boxes_around(const Boxes& inner) {
  Boxes outer((inner.count + kFan - 1) / kFan);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < inner.count; ++i) {
      float& low = outer.low[axis][i / kFan];
      float& high = outer.high[axis][i / kFan];
      low = std::min(low, inner.low[axis][i]);
      high = std::max(high, inner.high[axis][i]);
    }
  }
  return outer;
}

/// Goes down from pairs of boxes to pairs of faces.
class Descent {
 public:
  Descent(const TriMesh& mesh, std::size_t patience,
          const std::function<void(std::uint32_t, std::uint32_t)>& visit)
      : left_(patience), visit_(visit) {
    levels_.push_back(boxes_of_faces(mesh));
    while (levels_.back().count > 1) {
      levels_.push_back(boxes_around(levels_.back()));
    }
  }

  bool go() {
    if (levels_.front().count > 1) {
      go_down(levels_.size() - 1, 0, 0);
    }
    return !has_stopped_;
  }

 private:
  /// Of boxes a ≤ b of a level that overlap, or the same, those under them.
  void go_down(std::size_t level, std::size_t a, std::size_t b) {
    const Boxes& inner = levels_[level - 1];
    const std::size_t end = std::min(inner.count, (a + 1) * kFan);
    for (std::size_t one = a * kFan; one < end && !has_stopped_; ++one) {
      if (!spend()) {
        return;
      }
      unsigned found = inner.overlaps(one, inner, b * kFan);
      for (std::size_t other = b * kFan; found != 0 && !has_stopped_; ++other, found >>= 1U) {
        if ((found & 1U) == 0 || other < one) {
          continue;
        }
        if (level > 1) {
          go_down(level - 1, one, other);
        } else if (one != other && spend()) {
          visit_(static_cast<std::uint32_t>(one), static_cast<std::uint32_t>(other));
        }
      }
    }
  }

  /// \return false if nothing is left to spend.
  bool spend() {
    has_stopped_ = left_ == 0;
    left_ -= has_stopped_ ? 0 : 1;
    return !has_stopped_;
  }

  std::size_t left_;
  const std::function<void(std::uint32_t, std::uint32_t)>& visit_;
  std::vector<Boxes> levels_{};  // from faces up
  bool has_stopped_ = false;
};

}  // namespace

bool for_each_close_pair(const TriMesh& mesh, std::size_t patience,
                         const std::function<void(std::uint32_t, std::uint32_t)>& visit) {
  return Descent(mesh, patience, visit).go();
}

}  // namespace vantage
