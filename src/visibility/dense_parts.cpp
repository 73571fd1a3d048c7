// SPDX-License-Identifier: MIT
#include "visibility/dense_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"

#include "spatial/segment.h"

namespace vantage {
namespace {

// Parts are looked for among voxels, so many along the longest side of the samples' box.
constexpr std::size_t kVoxels = 64;
// A part has so many samples, and this share of them all: with less its own picture gains nothing. [ours]
constexpr std::size_t kLeastSamples = 256;
constexpr double kLeastShare = 1.0 / 64.0;
// Samples that a part has in a cell of the whole's picture, where the others have one. [ours]
constexpr double kLeastCrowd = 256.0;

/// Samples by the voxels they lie in.
class Voxels {
 public:
  explicit Voxels(std::span<const Vec3> samples)
      : samples_(samples), place_of_(kVoxels * kVoxels * kVoxels, kEmpty) {
    const Box box = bounding_box(samples);
    low_ = box.low;
    side_ = box.longest_side();
    for (const Vec3& p : samples) {
      const Index at = index_of(p);
      std::uint32_t& place = place_of_[number_of(at)];
      if (place == kEmpty) {
        place = static_cast<std::uint32_t>(occupied_.size());
        occupied_.push_back({.at = at});
      }
      ++occupied_[place].count;
      occupied_[place].box.extend(p);
    }
  }

  /// The samples of each dense part. Voxels that hold samples are connected with their neighbours; where
  /// that leads to no dense part, by those that hold 2, 4, 8, … So a part reaches to where samples
  /// get few. It is as large as it can be, because faces beside it are tested against each of its samples.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> dense_parts() {
    std::uint32_t most = 0;
    for (const Voxel& voxel : occupied_) {
      most = std::max(most, voxel.count);
    }
    std::uint32_t parts = 0;
    for (std::uint32_t least = 1; least <= most; least *= 2) {
      for (const std::vector<std::uint32_t>& group : connected(least)) {
        if (is_dense(group)) {
          ++parts;
          for (const std::uint32_t place : group) {
            occupied_[place].part = parts;
          }
        }
      }
    }
    std::vector<std::vector<std::uint32_t>> of_part(parts);
    for (std::uint32_t i = 0; parts > 0 && i < samples_.size(); ++i) {
      const std::uint32_t part = occupied_[place_of_[number_of(index_of(samples_[i]))]].part;
      if (part > 0) {
        of_part[part - 1].push_back(i);
      }
    }
    return of_part;
  }

 private:
  using Index = std::array<std::size_t, 3>;

  struct Voxel {
    Index at{};
    std::uint32_t count = 0;
    Eigen::AlignedBox3d box{};  // of its samples
    std::uint32_t part = 0;     // counted from 1; 0: none
  };

  static constexpr std::uint32_t kEmpty = ~std::uint32_t{0};

  [[nodiscard]] Index index_of(const Vec3& p) const {
    Index at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      at[axis] =
          std::min(kVoxels - 1, static_cast<std::size_t>((p[k] - low_[k]) / side_ * kVoxels));
    }
    return at;
  }

  static std::size_t number_of(const Index& at) {
    return (at[2] * kVoxels + at[1]) * kVoxels + at[0];
  }

  /// The voxels of at least so many samples that have no part yet, each with those it is connected with.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> connected(std::uint32_t least) const {
    std::vector<std::uint8_t> is_left(occupied_.size(), 0);
    for (std::size_t place = 0; place < occupied_.size(); ++place) {
      is_left[place] = occupied_[place].part == 0 && occupied_[place].count >= least ? 1 : 0;
    }
    std::vector<std::vector<std::uint32_t>> groups;
    for (std::uint32_t first = 0; first < occupied_.size(); ++first) {
      if (is_left[first] == 0) {
        continue;
      }
      is_left[first] = 0;
      std::vector<std::uint32_t>& group = groups.emplace_back(1, first);
      for (std::size_t next = 0; next < group.size(); ++next) {
        for_each_neighbour(occupied_[group[next]].at, [&](const Index& beside) {
          const std::uint32_t place = place_of_[number_of(beside)];
          if (place != kEmpty && is_left[place] != 0) {
            is_left[place] = 0;
            group.push_back(place);
          }
        });
      }
    }
    return groups;
  }

  template <typename Function>
  static void for_each_neighbour(const Index& at, const Function& call) {
    const auto last = [](std::size_t k) { return std::min(k + 1, kVoxels - 1); };
    const auto first = [](std::size_t k) { return k - std::min<std::size_t>(k, 1); };
    for (std::size_t z = first(at[2]); z <= last(at[2]); ++z) {
      for (std::size_t y = first(at[1]); y <= last(at[1]); ++y) {
        for (std::size_t x = first(at[0]); x <= last(at[0]); ++x) {
          call({x, y, z});
        }
      }
    }
  }

  /// Whether the voxels hold many samples, and many for each that as large a square of an even picture would.
  [[nodiscard]] bool is_dense(const std::vector<std::uint32_t>& group) const {
    std::size_t held = 0;
    Eigen::AlignedBox3d box;
    for (const std::uint32_t place : group) {
      held += occupied_[place].count;
      box.extend(occupied_[place].box);
    }
    const auto all = static_cast<double>(samples_.size());
    const double share = box.sizes().maxCoeff() / side_;
    const double even = std::max(1.0, all * share * share);
    const auto count = static_cast<double>(held);
    return held >= kLeastSamples && count >= kLeastShare * all && count >= kLeastCrowd * even;
  }

  std::span<const Vec3> samples_;
  Vec3 low_ = Vec3::Zero();
  double side_ = 0.0;
  std::vector<Voxel> occupied_{};
  std::vector<std::uint32_t> place_of_;  // of each voxel, among those occupied; or kEmpty
};

/// What places span; nothing at first.
class Span {
 public:
  void add(const EyePicture::Place& place) {
    low_ = place < low_ ? place : low_;
    high_ = high_ < place ? place : high_;
  }

  /// Wider by so much in the picture, and in depth.
  [[nodiscard]] EyePicture::Extent widened(float reach, float depth) const {
    const EyePicture::Place more{reach, reach, depth, 0.0F};
    return {low_ - more, high_ + more};
  }

 private:
  static constexpr float kNone = std::numeric_limits<float>::max();
  EyePicture::Place low_{kNone, kNone, kNone, 0.0F};
  EyePicture::Place high_{-kNone, -kNone, -kNone, 0.0F};
};

/// Whether what spans the first may hide what spans the second.
bool may_hide(const EyePicture::Extent& face, const EyePicture::Extent& samples) {
  return face.low[0] <= samples.high[0] && samples.low[0] <= face.high[0] &&
         face.low[1] <= samples.high[1] && samples.low[1] <= face.high[1] &&
         face.low[2] <= samples.high[2];
}

}  // namespace

std::vector<std::vector<std::uint32_t>> dense_samples(std::span<const Vec3> samples) {
  if (samples.size() < kLeastSamples || !(bounding_box(samples).longest_side() > 0.0)) {
    return {};
  }
  return Voxels(samples).dense_parts();
}

std::vector<std::uint32_t> faces_between(const Surface& whole,
                                         std::span<const std::uint32_t> samples) {
  std::vector<std::uint8_t> is_inside(whole.samples.size(), 0);
  for (const std::uint32_t i : samples) {
    is_inside[i] = 1;
  }
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < whole.faces.size(); ++f) {
    const auto& [a, b, c] = whole.faces[f];
    if (is_inside[a] != 0 && is_inside[b] != 0 && is_inside[c] != 0) {
      faces.push_back(f);
    }
  }
  return faces;
}

std::vector<FaceBefore> faces_before(const DensePart& part, std::span<const std::uint8_t> asked,
                                     const Surface& whole, const EyePicture& picture) {
  const std::vector<EyePicture::Place>& places = picture.places();
  Span span;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (asked[i] != 0) {
      span.add(places[part.samples[i]]);
    }
  }
  // The samples' errors here, the faces' below.
  const EyePicture::Extent samples = span.widened(picture.margin(), EyePicture::kAxisError);
  std::vector<FaceBefore> before;
  for (std::size_t first = 0; first < whole.faces.size(); first += FaceBlocks::kFaces) {
    if (!may_hide(picture.extent_of(first / FaceBlocks::kFaces), samples)) {
      continue;
    }
    const std::size_t last = std::min(whole.faces.size(), first + FaceBlocks::kFaces);
    for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) {
      Span of_face;
      for (const std::uint32_t corner : whole.faces[f]) {
        of_face.add(places[corner]);
      }
      // The face's error and the sample's.
      const EyePicture::Extent extent =
          of_face.widened(2.0F * picture.margin(), 2.0F * EyePicture::kAxisError);
      if (may_hide(extent, samples) &&
          !std::binary_search(part.faces.begin(), part.faces.end(), f)) {
        before.push_back({f, extent});
      }
    }
  }
  return before;
}

bool is_hidden_by(std::span<const FaceBefore> faces, std::uint32_t sample, const Surface& whole,
                  const EyePicture& picture, const Viewpoint& eye) {
  const EyePicture::Place& place = picture.places()[sample];
  const Segment segment = segment_to(whole.samples[sample], eye);
  return std::any_of(faces.begin(), faces.end(), [&](const FaceBefore& before) {
    const auto& [a, b, c] = whole.faces[before.face];
    return may_hide(before.extent, {place, place}) && a != sample && b != sample && c != sample &&
           segment.crosses(whole.samples[a], whole.samples[b], whole.samples[c],
                           whole.twice_areas[before.face]);
  });
}

}  // namespace vantage
