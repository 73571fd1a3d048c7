// SPDX-License-Identifier: MIT
#include "visibility/sight.h"

#include <limits>
#include <utility>

#include "core/parallel.h"
#include "visibility/segment.h"

namespace vantage {
namespace {

constexpr std::size_t kGrain = 2048;  // points per chunk: a few tenths of a millisecond

}  // namespace

std::unique_ptr<EyeGrid> GridPool::borrow() {
  const std::lock_guard lock(mutex_);
  if (grids_.empty()) {
    return std::make_unique<EyeGrid>();
  }
  std::unique_ptr<EyeGrid> grid = std::move(grids_.back());
  grids_.pop_back();
  return grid;
}

void GridPool::give_back(std::unique_ptr<EyeGrid> grid) {
  const std::lock_guard lock(mutex_);
  grids_.push_back(std::move(grid));
}

bool Sight::hidden(const SurfacePoints& points, std::uint32_t point, const Viewpoint& eye) {
  std::call_once(candidates_once_, [&] { candidates_.emplace(surface_.sites, surface_.faces); });
  const Vec3& start = points.place(point);
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
    return !points.held(point, f, t) &&
           segment.crosses(surface_.sites[t[0]], surface_.sites[t[1]], surface_.sites[t[2]],
                           surface_.twice_areas[f]);
  });
}

Look::Look(Sight& sight, const Viewpoint& eye, const RunContext& run,
           std::span<const std::uint8_t> backs)
    : sight_(sight), eye_(eye), run_(run), grid_(sight.grids_.borrow()) {
  grid_->begin(sight.surface_, eye, backs.empty() ? sight.surface_.backs : backs, run);
}

Look::~Look() {
  sight_.grids_.give_back(std::move(grid_));
}

std::vector<std::uint8_t> Look::faces_at_sites() const {
  const Surface& surface = sight_.surface_;
  std::vector<std::uint8_t> at(surface.sites.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const std::uint8_t turned = is_turned(f) ? kTurned : kNotTurned;
    for (const std::uint32_t site : surface.faces[f]) {
      at[site] |= turned;
    }
  }
  return at;
}

std::vector<std::uint8_t> Look::seen_sites() {
  const Surface& surface = sight_.surface_;
  std::vector<std::uint8_t> asked(surface.sites.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    if (is_turned(f)) {
      for (const std::uint32_t site : surface.faces[f]) {
        asked[site] = 1;
      }
    }
  }
  return not_hidden({.sites = sight_.surface_.sites}, std::move(asked));
}

std::vector<std::uint8_t> Look::seen_points(const SurfacePoints& points) {
  std::vector<std::uint8_t> asked(points.exact.size(), 0);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    asked[i] = is_turned(points.owner[i]) ? 1 : 0;
  }
  return not_hidden(points, std::move(asked));
}

std::vector<std::uint8_t> Look::not_hidden(const SurfacePoints& points,
                                           std::vector<std::uint8_t> asked) {
  std::vector<std::uint8_t> seen = std::move(asked);
  if (!grid_->hide(sight_.surface_, points, seen, run_)) {
    parallel_for(run_, seen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (seen[i] != 0 && sight_.hidden(points, static_cast<std::uint32_t>(i), eye_)) {
          seen[i] = 0;
        }
      }
    });
  }
  return seen;
}

}  // namespace vantage
