// SPDX-License-Identifier: MIT
#include "visibility/dense_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "vantage/mesh/measures.h"

#include "spatial/segment.h"

namespace vantage {
namespace {

// Parts are looked for among voxels, so many along the longest side of the samples' box.
constexpr std::size_t kVoxels = 64;
// A part has so many samples, and this share of them all: with less its own picture gains nothing. [ours]
constexpr std::size_t kLeastSamples = 256;
constexpr double kLeastShare = 1.0 / 64.0;
// A part may lie around a corner of so many voxels: each then holds such a share of it.
constexpr double kVoxelsAround = 8.0;
// Samples that a part has in a cell of the whole's picture, where the others have one. [ours]
constexpr double kLeastCrowd = 256.0;

/// Samples by the voxels they lie in.
class Voxels {
 public:
  explicit Voxels(std::span<const Vec3> samples)
      : samples_(samples), counts_(kVoxels * kVoxels * kVoxels) {
    const Box box = bounding_box(samples);
    low_ = box.low;
    side_ = box.longest_side();
    for (const Vec3& p : samples) {
      ++counts_[index_of(voxel_of(p))];
    }
  }

  /// The samples of each group of neighbouring voxels that hold many, without those that are no dense part.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> dense_groups() {
    const double least = std::max(static_cast<double>(kLeastSamples),
                                  kLeastShare * static_cast<double>(samples_.size()));
    std::vector<std::uint32_t> group_of(counts_.size(), 0);
    std::uint32_t groups = 0;
    for (const std::size_t at : densest_first(least / kVoxelsAround)) {
      if (group_of[at] == 0) {
        fill(at, std::max(least, static_cast<double>(counts_[at])) / kVoxelsAround, ++groups,
             group_of);
      }
    }
    std::vector<std::vector<std::uint32_t>> of_group(groups);
    for (std::uint32_t i = 0; groups > 0 && i < samples_.size(); ++i) {
      const std::uint32_t group = group_of[index_of(voxel_of(samples_[i]))];
      if (group > 0) {
        of_group[group - 1].push_back(i);
      }
    }
    std::erase_if(of_group, [&](const std::vector<std::uint32_t>& group) {
      return static_cast<double>(group.size()) < least || crowd(group) < kLeastCrowd;
    });
    return of_group;
  }

 private:
  using Voxel = std::array<std::size_t, 3>;

  [[nodiscard]] Voxel voxel_of(const Vec3& p) const {
    Voxel voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      voxel[axis] =
          std::min(kVoxels - 1, static_cast<std::size_t>((p[k] - low_[k]) / side_ * kVoxels));
    }
    return voxel;
  }

  static std::size_t index_of(const Voxel& voxel) {
    return (voxel[2] * kVoxels + voxel[1]) * kVoxels + voxel[0];
  }

  /// The voxels of at least so many samples.
  [[nodiscard]] std::vector<std::size_t> densest_first(double least) const {
    std::vector<std::size_t> order;
    for (std::size_t at = 0; at < counts_.size(); ++at) {
      if (counts_[at] >= least) {
        order.push_back(at);
      }
    }
    std::sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
      return std::pair(counts_[other], one) < std::pair(counts_[one], other);
    });
    return order;
  }

  /// Gives this voxel a group, and all that it is connected with through voxels with so many samples.
  void fill(std::size_t first, double least, std::uint32_t group,
            std::vector<std::uint32_t>& group_of) const {
    std::vector<std::size_t> open{first};
    group_of[first] = group;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for_each_neighbour({at % kVoxels, at / kVoxels % kVoxels, at / (kVoxels * kVoxels)},
                         [&](std::size_t next) {
                           if (group_of[next] == 0 && counts_[next] >= least) {
                             group_of[next] = group;
                             open.push_back(next);
                           }
                         });
    }
  }

  template <typename Function>
  static void for_each_neighbour(const Voxel& voxel, const Function& call) {
    const auto last = [](std::size_t at) { return std::min(at + 1, kVoxels - 1); };
    const auto first = [](std::size_t at) { return at - std::min<std::size_t>(at, 1); };
    for (std::size_t z = first(voxel[2]); z <= last(voxel[2]); ++z) {
      for (std::size_t y = first(voxel[1]); y <= last(voxel[1]); ++y) {
        for (std::size_t x = first(voxel[0]); x <= last(voxel[0]); ++x) {
          call(index_of({x, y, z}));
        }
      }
    }
  }

  /// The samples of a group for each sample that as large a square of an even picture would hold.
  [[nodiscard]] double crowd(const std::vector<std::uint32_t>& group) const {
    std::vector<Vec3> points;
    points.reserve(group.size());
    for (const std::uint32_t i : group) {
      points.push_back(samples_[i]);
    }
    const double share = bounding_box(points).longest_side() / side_;
    const double even = std::max(1.0, static_cast<double>(samples_.size()) * share * share);
    return static_cast<double>(group.size()) / even;
  }

  std::span<const Vec3> samples_;
  Vec3 low_ = Vec3::Zero();
  double side_ = 0.0;
  std::vector<std::uint32_t> counts_;
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
  return Voxels(samples).dense_groups();
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
