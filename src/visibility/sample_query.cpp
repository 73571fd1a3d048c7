// SPDX-License-Identifier: MIT
#include "visibility/sample_query.h"

#include <limits>
#include <utility>

#include "core/parallel.h"
#include "spatial/segment.h"

namespace vantage {
namespace {

constexpr std::size_t kPointsPerTask = 2048;  // a few tenths of a millisecond

std::vector<std::uint8_t> values_at(std::span<const std::uint8_t> values,
                                    std::span<const std::uint32_t> places) {
  std::vector<std::uint8_t> some;
  some.reserve(places.size());
  for (const std::uint32_t place : places) {
    some.push_back(values[place]);
  }
  return some;
}

}  // namespace

SampleScene::SampleScene(Surface prepared) : surface_(std::move(prepared)) {
  for (std::vector<std::uint32_t>& samples : dense_samples(surface_.samples)) {
    std::vector<std::uint32_t> faces = faces_between(surface_, samples);
    auto scene = std::make_unique<SampleScene>(part_of(surface_, samples, faces));
    parts_.push_back({std::move(samples), std::move(faces), std::move(scene)});
  }
}

template <typename Holds>
bool SampleScene::hidden(const Vec3& start, const Viewpoint& eye, const Holds& holds) {
  const UnitFrame& rounding = surface_.rounding;
  std::call_once(candidates_once_,
                 [&] { candidates_.emplace(rounding.to_frame(surface_.samples), surface_.faces); });
  const bool bounded = eye.projection == Projection::Perspective;
  const Vec3 direction = bounded ? Vec3(eye.position - start) : eye.position;
  if (!(direction.squaredNorm() > 0.0)) {
    return false;  // the eye is at the point itself
  }
  const Segment segment(start, direction, bounded);
  const double length = direction.norm();
  const double reach = bounded ? length * rounding.scale : std::numeric_limits<double>::infinity();
  return candidates_->any(
      rounding.to_frame(start), direction / length, reach, [&](std::uint32_t f) {
        const Triangle& t = surface_.faces[f];
        return !holds(f) && segment.crosses(surface_.samples[t[0]], surface_.samples[t[1]],
                                            surface_.samples[t[2]], surface_.twice_areas[f]);
      });
}

bool SampleScene::hides_sample(std::uint32_t sample, const Viewpoint& eye) {
  return hidden(surface_.samples[sample], eye, [&](std::uint32_t f) {
    const Triangle& t = surface_.faces[f];
    return t[0] == sample || t[1] == sample || t[2] == sample;
  });
}

bool SampleScene::hides_place(const Vec3& place, std::uint32_t face, const Viewpoint& eye) {
  return hidden(place, eye, [&](std::uint32_t f) { return f == face; });
}

SampleQuery::SampleQuery(SampleScene& scene, const Viewpoint& eye, const RunContext& run,
                         std::span<const std::uint8_t> back_faces)
    : scene_(scene),
      eye_(eye),
      run_(run),
      back_faces_(back_faces.empty() ? scene.surface_.back_faces : back_faces),
      memory_(scene.memory_) {
  find_turned(scene.surface_, eye, memory_->turned, run);
  memory_->grid.begin(eye, memory_->turned, back_faces_);
}

std::vector<std::uint8_t> SampleQuery::seen_samples() {
  const Surface& surface = scene_.surface_;
  std::vector<std::uint8_t> asked(surface.samples.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (is_turned(f)) {
      for (const std::uint32_t sample : surface.faces[f]) {
        asked[sample] = 1;
      }
    }
  }
  return not_hidden(std::move(asked));
}

std::vector<std::uint8_t> SampleQuery::turned_among(std::span<const std::uint8_t> samples) const {
  const Surface& surface = scene_.surface_;
  std::vector<std::uint8_t> asked(surface.samples.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    for (const std::uint32_t sample : surface.faces[f]) {
      if (samples[sample] != 0 && is_turned(f)) {
        asked[sample] = 1;
      }
    }
  }
  return asked;
}

std::vector<std::uint8_t> SampleQuery::seen_among(std::span<const std::uint8_t> samples) {
  return not_hidden(turned_among(samples));
}

std::vector<std::uint8_t> SampleQuery::seen_by_segments(std::span<const std::uint8_t> samples) {
  std::vector<std::uint8_t> asked = turned_among(samples);
  clear_hidden(asked);
  return asked;
}

void SampleQuery::clear_hidden(std::vector<std::uint8_t>& asked) {
  parallel_for(run_, asked.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (asked[i] != 0 && scene_.hides_sample(static_cast<std::uint32_t>(i), eye_)) {
        asked[i] = 0;
      }
    }
  });
}

/// Sets what is seen of a part's samples: 1 for those asked about that no face hides.
void SampleQuery::set_seen_of(const DensePart& part, std::span<const std::uint8_t> asked,
                              std::vector<std::uint8_t>& seen) {
  const Surface& surface = scene_.surface_;
  std::vector<std::uint8_t> left = values_at(asked, part.samples);
  const std::vector<std::uint8_t> back_faces =
      back_faces_.empty() ? std::vector<std::uint8_t>{} : values_at(back_faces_, part.faces);
  left = SampleQuery(*part.scene, eye_, run_, back_faces).not_hidden(std::move(left));
  const EyePicture& picture = *memory_->grid.picture();
  const std::vector<FaceBefore> others = faces_before(part, left, surface, picture);
  parallel_for(run_, left.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t sample = part.samples[i];
      seen[sample] = left[i] != 0 && !is_hidden_by(others, sample, surface, picture, eye_) ? 1 : 0;
    }
  });
}

std::vector<std::uint8_t> SampleQuery::not_hidden(std::vector<std::uint8_t> asked) {
  std::vector<std::uint8_t> seen = asked;
  for (const DensePart& part : scene_.parts_) {
    for (const std::uint32_t sample : part.samples) {
      seen[sample] = 0;
    }
  }
  EyeGrid& grid = memory_->grid;
  const bool is_complete = grid.hide(scene_.surface_, seen, run_);
  if (grid.picture() == nullptr) {
    clear_hidden(asked);
    return asked;
  }
  if (!is_complete) {
    clear_hidden(seen);
  }
  for (const DensePart& part : scene_.parts_) {
    set_seen_of(part, asked, seen);
  }
  return seen;
}

}  // namespace vantage
