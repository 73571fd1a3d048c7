// SPDX-License-Identifier: MIT
#include "vantage/visibility/vertex_visibility.h"

#include <cmath>
#include <mutex>
#include <optional>

#include "vantage/core/error.h"

#include "core/parallel.h"
#include "visibility/eye_grid.h"
#include "visibility/segment.h"
#include "visibility/surface.h"

namespace vantage {
namespace {

// A face whose normal is this close to a right angle with the line of sight is seen edge on: the
// rounding of positions in a UnitFrame and of the dot product, in radians.
constexpr double kEdgeOn = 0x1p-46;
// With more candidates than this in its grid cells a site asks the hierarchy in space instead.
constexpr std::size_t kMaxCandidates = 1024;
constexpr std::uint32_t kNoFace = ~std::uint32_t{0};
// Sites per chunk: a few tenths of a millisecond.
constexpr std::size_t kGrain = 2048;

/// Grids that queries borrow, so that their memory is reused; at most one per thread exists.
class GridPool {
 public:
  std::unique_ptr<EyeGrid> borrow() {
    const std::lock_guard lock(mutex_);
    if (grids_.empty()) {
      return std::make_unique<EyeGrid>();
    }
    std::unique_ptr<EyeGrid> grid = std::move(grids_.back());
    grids_.pop_back();
    return grid;
  }

  void give_back(std::unique_ptr<EyeGrid> grid) {
    const std::lock_guard lock(mutex_);
    grids_.push_back(std::move(grid));
  }

 private:
  std::mutex mutex_{};
  std::vector<std::unique_ptr<EyeGrid>> grids_{};
};

/// The hierarchy in space, built when first needed: most queries never need it.
class LazyCandidates {
 public:
  const CandidateScene& of(const Surface& surface) {
    std::call_once(once_, [&] { scene_.emplace(surface.sites, surface.faces); });
    return *scene_;
  }

 private:
  std::once_flag once_{};
  std::optional<CandidateScene> scene_{};
};

/// 1 for each site with a face turned to the eye, by the component's rule for sides.
std::vector<std::uint8_t> turned_to(const Surface& surface, const Viewpoint& eye) {
  std::vector<std::uint8_t> turned(surface.sites.size(), 0);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f];
    const Vec3 sight = eye.projection == Projection::Perspective
                           ? Vec3(eye.position - surface.sites[a])
                           : eye.position;
    double height = surface.area_vectors[f].dot(sight);
    if (surface.sides[f] == FaceSides::Both) {
      height = std::abs(height);
    }
    if (height > 0.0 && height > kEdgeOn * surface.twice_areas[f] * sight.norm()) {
      turned[a] = turned[b] = turned[c] = 1;
    }
  }
  return turned;
}

Viewpoint in_frame(const Viewpoint& eye, const UnitFrame& frame) {
  if (!eye.position.allFinite()) {
    throw InvalidInput("the eye of a visibility query must be finite");
  }
  if (eye.projection == Projection::Perspective) {
    return {eye.projection, frame.to_frame(eye.position)};
  }
  if (!(eye.position.squaredNorm() > 0.0)) {
    throw InvalidInput("the direction of an orthographic view must not be zero");
  }
  return {eye.projection, eye.position.normalized()};
}

}  // namespace

struct VertexVisibility::Scene {
  Surface surface{};
  GridPool grids{};
  LazyCandidates candidates{};

  /// The face found between a site and the eye, or kNoFace. \param grid may be null.
  /// \param hint a face worth asking first, or kNoFace: what hid a site hides most neighbours too.
  std::uint32_t blocker(std::uint32_t site, const Viewpoint& eye, const EyeGrid* grid,
                        std::uint32_t hint) {
    const Vec3& start = surface.sites[site];
    const bool bounded = eye.projection == Projection::Perspective;
    const Vec3 direction = bounded ? Vec3(eye.position - start) : eye.position;
    if (!(direction.squaredNorm() > 0.0)) {
      return kNoFace;  // the eye is at the vertex itself
    }
    const Segment segment(start, direction, bounded);
    std::uint32_t found = kNoFace;
    const auto decide = [&](std::uint32_t f) {
      const auto& [a, b, c] = surface.faces[f];
      const bool blocks = a != site && b != site && c != site &&
                          segment.crosses(surface.sites[a], surface.sites[b], surface.sites[c],
                                          surface.twice_areas[f]);
      found = blocks ? f : kNoFace;
      return blocks;
    };
    if (hint != kNoFace && decide(hint)) {
      return found;
    }
    if (grid != nullptr && grid->candidate_count(site) <= kMaxCandidates) {
      static_cast<void>(grid->any(site, decide));
      return found;
    }
    const double length = direction.norm();
    const double reach = bounded ? length : std::numeric_limits<double>::infinity();
    static_cast<void>(candidates.of(surface).any(start, direction / length, reach, decide));
    return found;
  }
};

VertexVisibility::VertexVisibility(const TriMesh& mesh, std::vector<FaceSides> sides)
    : scene_(std::make_unique<Scene>()) {
  scene_->surface = prepare_surface(mesh, sides);
}

VertexVisibility::~VertexVisibility() = default;
VertexVisibility::VertexVisibility(VertexVisibility&&) noexcept = default;
VertexVisibility& VertexVisibility::operator=(VertexVisibility&&) noexcept = default;

std::vector<std::uint8_t> VertexVisibility::visible_vertices(const Viewpoint& eye,
                                                             const RunContext& run) const {
  const Surface& surface = scene_->surface;
  const Viewpoint local = in_frame(eye, surface.frame);
  std::vector<std::uint8_t> seen = turned_to(surface, local);
  std::unique_ptr<EyeGrid> grid = scene_->grids.borrow();
  const EyeGrid* usable = grid->build(surface, local) ? grid.get() : nullptr;
  parallel_for(run, seen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint32_t last = kNoFace;
    for (std::size_t site = begin; site < end; ++site) {
      if (seen[site] != 0) {
        const std::uint32_t found =
            scene_->blocker(static_cast<std::uint32_t>(site), local, usable, last);
        seen[site] = found == kNoFace ? 1 : 0;
        last = found == kNoFace ? last : found;
      }
    }
  });
  scene_->grids.give_back(std::move(grid));

  std::vector<std::uint8_t> visible(surface.site_of_vertex.size(), 0);
  for (std::size_t v = 0; v < visible.size(); ++v) {
    const std::uint32_t site = surface.site_of_vertex[v];
    visible[v] = site == Surface::kNoSite ? std::uint8_t{0} : seen[site];
  }
  return visible;
}

}  // namespace vantage
