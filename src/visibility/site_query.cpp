// SPDX-License-Identifier: MIT
#include "visibility/site_query.h"

#include <limits>
#include <utility>

#include "core/parallel.h"
#include "spatial/segment.h"

namespace vantage {
namespace {

constexpr std::size_t kPointsPerTask = 2048;  // a few tenths of a millisecond

}  // namespace

template <typename Holds>
bool SiteScene::hidden(const Vec3& start, const Viewpoint& eye, const Holds& holds) {
  std::call_once(candidates_once_, [&] { candidates_.emplace(surface_.sites, surface_.faces); });
  const bool bounded = eye.projection == Projection::Perspective;
  const Vec3 direction = bounded ? Vec3(eye.position - start) : eye.position;
  if (!(direction.squaredNorm() > 0.0)) {
    return false;  // the eye is at the point itself
  }
  const Segment segment(start, direction, bounded);
  const double length = direction.norm();
  const double reach = bounded ? length : std::numeric_limits<double>::infinity();
  return candidates_->any(start, direction / length, reach, [&](std::uint32_t f) {
    const Triangle& t = surface_.faces[f];
    return !holds(f) && segment.crosses(surface_.sites[t[0]], surface_.sites[t[1]],
                                        surface_.sites[t[2]], surface_.twice_areas[f]);
  });
}

bool SiteScene::hides_site(std::uint32_t site, const Viewpoint& eye) {
  return hidden(surface_.sites[site], eye, [&](std::uint32_t f) {
    const Triangle& t = surface_.faces[f];
    return t[0] == site || t[1] == site || t[2] == site;
  });
}

bool SiteScene::hides_place(const Vec3& place, std::uint32_t face, const Viewpoint& eye) {
  return hidden(place, eye, [&](std::uint32_t f) { return f == face; });
}

SiteQuery::SiteQuery(SiteScene& scene, const Viewpoint& eye, const RunContext& run,
                     std::span<const std::uint8_t> backs)
    : scene_(scene), eye_(eye), run_(run), memory_(scene.memory_) {
  find_turned(scene.surface_, eye, memory_->turned, run);
  memory_->grid.begin(eye, memory_->turned, backs.empty() ? scene.surface_.backs : backs);
}

std::vector<std::uint8_t> SiteQuery::seen_sites() {
  const Surface& surface = scene_.surface_;
  std::vector<std::uint8_t> asked(surface.sites.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (is_turned(f)) {
      for (const std::uint32_t site : surface.faces[f]) {
        asked[site] = 1;
      }
    }
  }
  return not_hidden(std::move(asked));
}

std::vector<std::uint8_t> SiteQuery::turned_among(std::span<const std::uint8_t> sites) const {
  const Surface& surface = scene_.surface_;
  std::vector<std::uint8_t> asked(surface.sites.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    for (const std::uint32_t site : surface.faces[f]) {
      if (sites[site] != 0 && is_turned(f)) {
        asked[site] = 1;
      }
    }
  }
  return asked;
}

std::vector<std::uint8_t> SiteQuery::seen_among(std::span<const std::uint8_t> sites) {
  return not_hidden(turned_among(sites));
}

std::vector<std::uint8_t> SiteQuery::seen_by_segments(std::span<const std::uint8_t> sites) {
  std::vector<std::uint8_t> asked = turned_among(sites);
  strike_hidden(asked);
  return asked;
}

void SiteQuery::strike_hidden(std::vector<std::uint8_t>& asked) {
  parallel_for(run_, asked.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (asked[i] != 0 && scene_.hides_site(static_cast<std::uint32_t>(i), eye_)) {
        asked[i] = 0;
      }
    }
  });
}

std::vector<std::uint8_t> SiteQuery::not_hidden(std::vector<std::uint8_t> asked) {
  if (!memory_->grid.hide(scene_.surface_, asked, run_)) {
    strike_hidden(asked);
  }
  return asked;
}

}  // namespace vantage
