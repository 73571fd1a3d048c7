// SPDX-License-Identifier: MIT
#include "visibility/sight.h"

#include <limits>
#include <utility>

#include "core/parallel.h"
#include "visibility/segment.h"

namespace vantage {
namespace {

constexpr std::size_t kGrain = 2048;  // points per chunk: a few tenths of a millisecond

/// Whether a face counts as turned to the eye, by the component's rule for sides.
bool counts(std::uint8_t turned, FaceSides sides) {
  return turned == 1 || (turned == 2 && sides == FaceSides::Both);
}

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
  const Vec3& start = points.exact[point];
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

void Sight::finish(EyeGrid& grid, const SurfacePoints& points, const Viewpoint& eye,
                   std::vector<std::uint8_t>& seen, const RunContext& run) {
  if (grid.hide(surface_, eye, points, seen, run)) {
    return;
  }
  parallel_for(run, seen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (seen[i] != 0 && hidden(points, static_cast<std::uint32_t>(i), eye)) {
        seen[i] = 0;
      }
    }
  });
}

std::vector<std::uint8_t> Sight::seen_sites(const Viewpoint& eye, const RunContext& run) {
  std::unique_ptr<EyeGrid> grid = grids_.borrow();
  grid->face_sides(surface_, eye, run);
  std::vector<std::uint8_t> seen(surface_.sites.size(), 0);
  for (std::size_t f = 0; f < surface_.faces.size(); ++f) {
    if (counts(grid->turned()[f], surface_.sides[f])) {
      const auto& [a, b, c] = surface_.faces[f];
      seen[a] = seen[b] = seen[c] = 1;
    }
  }
  finish(*grid, sites(), eye, seen, run);
  grids_.give_back(std::move(grid));
  return seen;
}

std::vector<std::uint8_t> Sight::seen_points(const SurfacePoints& points, const Viewpoint& eye,
                                             const RunContext& run) {
  std::unique_ptr<EyeGrid> grid = grids_.borrow();
  grid->face_sides(surface_, eye, run);
  std::vector<std::uint8_t> seen(points.exact.size(), 0);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const std::uint32_t f = points.owner[i];
    seen[i] = counts(grid->turned()[f], surface_.sides[f]) ? 1 : 0;
  }
  finish(*grid, points, eye, seen, run);
  grids_.give_back(std::move(grid));
  return seen;
}

}  // namespace vantage
