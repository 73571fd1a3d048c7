// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/mesh/topology.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/channel.h"

#include "core/unit_direction.h"
#include "pipeline/describe_view.h"
#include "pipeline/drawn_points.h"
#include "pipeline/view_preparation.h"
#include "render/picture_room.h"
#include "view/sphere_angles.h"

namespace vantage {
namespace {

// What the table of the channel may take: on every machine alike, as what is found hangs on it. [ours]
constexpr double kMostChannelBytes = 1024.0 * 1024.0 * 1024.0;
// What an exploration sees if nothing is asked for: the last slivers take most of the way. [ours]
constexpr double kExploredShare = 0.95;
// How often the corners of its way, 60 degrees and more on the set of views, are cut. [ours]
constexpr int kCornerPasses = 2;

/// The view sphere and what is seen from it.
struct SeenSphere {
  DirectionSet set{};
  ViewChannel channel{};
};

SeenSphere seen_sphere(const ShapeAnalysis& shape, const ScoringCamera& camera,
                       std::vector<std::string>& warnings, const RunContext& run) {
  int level = kMeasureSetLevel;
  // About half of the faces are seen, eight bytes each.
  while (level > 0 && 10.0 * std::ldexp(1.0, 2 * level) * 4.0 *
                              static_cast<double>(shape.surface.triangles.size()) >
                          kMostChannelBytes) {
    --level;
  }
  SeenSphere sphere{direction_set(ViewSphereBase::Icosahedron, level), {}};
  const std::vector<Vec3>& directions = sphere.set.directions;
  if (level < kMeasureSetLevel) {
    warnings.push_back("the views were chosen from " + std::to_string(directions.size()) +
                       " directions instead of 642 to save memory");
  }
  sphere.channel = channel_of(shape, camera, directions, run);
  return sphere;
}

/// Views chosen on the channel from views to faces, and why there are no more.
struct ChannelViews {
  std::vector<Vec3> directions{};
  ViewSetStop stop = ViewSetStop::Count;
};

ChannelViews channel_views(const SeenSphere& sphere, const ViewSetRequest& request,
                           std::vector<std::string>& warnings, const RunContext& run) {
  const auto& [set, channel] = sphere;
  const std::vector<Vec3>& directions = set.directions;
  const std::size_t count =
      request.set.views ? static_cast<std::size_t>(*request.set.views) : directions.size();
  const std::vector<ChannelPick> picks =
      request.selection == ViewSelection::Vazquez
          ? greedy_entropy_views(channel, count, run)
          : merge_views(channel, count, request.information, run).picks;
  ChannelViews chosen;
  for (const ChannelPick& pick : picks) {
    chosen.directions.push_back(directions[pick.view]);
  }
  if (picks.size() < count) {
    chosen.stop = request.selection == ViewSelection::Feixas && request.information > 0.0
                      ? ViewSetStop::Information
                      : ViewSetStop::Exhausted;
  }
  if (picks.empty()) {
    chosen.directions.push_back(directions.front());
    warnings.emplace_back(
        "no view sees more than one face, so the first of all directions is shown");
  }
  return chosen;
}

/// Cuts the corners of a way; its ends stay.
std::vector<Vec3> without_corners(const std::vector<Vec3>& stops) {
  if (stops.size() < 3) {
    return stops;
  }
  std::vector<Vec3> smooth{stops.front()};
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    smooth.push_back((3.0 * stops[i] + stops[i + 1]).normalized());
    smooth.push_back((stops[i] + 3.0 * stops[i + 1]).normalized());
  }
  smooth.push_back(stops.back());
  return smooth;
}

/// The exploration from the best view, with its corners cut.
CameraWay explored_way(const SeenSphere& sphere, const Vec3& best, const ViewSetRequest& request,
                       const RunContext& run) {
  const std::vector<Vec3>& directions = sphere.set.directions;
  const auto nearest =
      std::max_element(directions.begin(), directions.end(),
                       [&](const Vec3& a, const Vec3& b) { return a.dot(best) < b.dot(best); });
  const Exploration found = explore_by_entropy(
      sphere.channel, vertex_neighbours({sphere.set.directions, sphere.set.triangles}),
      static_cast<std::uint32_t>(nearest - directions.begin()),
      request.set.coverage.value_or(kExploredShare), run);
  CameraWay way;
  way.coverage = found.coverage;
  for (const std::uint32_t view : found.views) {
    way.stops.push_back(directions[view]);
  }
  way.stops.front() = best;
  for (int pass = 0; pass < kCornerPasses; ++pass) {
    way.stops = without_corners(way.stops);
  }
  for (std::size_t i = 0; i < way.stops.size(); ++i) {
    way.length_rad += angle_between(way.stops[i], way.stops[(i + 1) % way.stops.size()]);
  }
  return way;
}

void warn_of(const ViewSet& set, const ViewSetRequest& request,
             std::vector<std::string>& warnings) {
  if (request.selection == ViewSelection::Kssm && set.level < request.set.level) {
    warnings.push_back("the set's views were chosen from " + std::to_string(set.candidates) +
                       " directions to save memory");
  }
  const bool is_enough = (request.set.coverage && set.stop == ViewSetStop::Coverage) ||
                         set.stop == ViewSetStop::Information;
  if (request.set.views && static_cast<std::size_t>(*request.set.views) > set.views.size() &&
      !is_enough) {
    warnings.push_back(std::to_string(set.views.size()) + " of " +
                       std::to_string(*request.set.views) +
                       " views found: a further one would show nothing new" +
                       (request.set.min_separation_deg > 0.0 ? " or stand too near" : ""));
  } else if (request.set.coverage && set.stop == ViewSetStop::Exhausted) {
    warnings.emplace_back(
        request.selection == ViewSelection::Kssm
            ? "the coverage asked for is out of reach with views so far apart"
            : "the coverage asked for is out of reach: the views chosen see every "
              "face that is seen from one of the directions");
  }
}

/// Where a camera on its way looks.
struct Aim {
  Vec3 target;
  Vec3 back;  ///< Unit, from there to the eye.
  Vec3 up;
  double distance;
};

/// At a focus, from where the camera would look at the whole.
Aim aim_at(const Vec3& focus, const TourPose& pose, const ScoringCamera& camera) {
  if (camera.projection == Projection::Orthographic) {
    // So far that nothing of the whole is behind the eye.
    return {focus, pose.direction, pose.up, camera.distance() + camera.sphere.diameter};
  }
  const Vec3 way = camera.eye(pose.direction) - focus;
  const Vec3 back = way.normalized();
  const Vec3 right = pose.up.cross(back).normalized();
  return {focus, back, back.cross(right), way.norm()};
}

}  // namespace

ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ViewScorer& scorer, const Vec3& best, const ModelFrame& frame,
                              const ViewOptions& options, std::vector<std::string>& warnings,
                              const RunContext& run) {
  const Vec3 first = unit_direction(best);
  const ScoringCamera& camera = scorer.camera();
  const ViewSetRequest& request = options.view_set.value();
  check_fields(request, kViewSetRequestFields);
  std::optional<SeenSphere> sphere;
  if (request.selection != ViewSelection::Kssm || request.path == TourPath::Explore) {
    sphere = seen_sphere(shape, camera, warnings, run.part(0.0, 0.3));
  }
  const RunContext rest = run.part(sphere ? 0.3 : 0.0, 1.0);
  const auto select = [&](const auto& visible) {
    return select_views(visible, scorer.shares(), camera, first, request.set, rest);
  };
  const auto measure = [&](const auto& visible, const std::vector<Vec3>& chosen) {
    return measure_views(visible, scorer.shares(), camera, chosen, request.set, rest);
  };
  const FaceVisibility* faces = scorer.faces();
  ReportedViewSet result;
  if (request.selection == ViewSelection::Kssm) {
    result.choice = faces != nullptr ? select(*faces) : select(visibility);
  } else {
    const ChannelViews chosen = channel_views(*sphere, request, warnings, rest.part(0.0, 0.0));
    result.choice = faces != nullptr ? measure(*faces, chosen.directions)
                                     : measure(visibility, chosen.directions);
    result.choice.candidates = sphere->set.directions.size();
    if (result.choice.stop != ViewSetStop::Coverage) {
      result.choice.stop = chosen.stop;
    }
  }
  warn_of(result.choice, request, warnings);
  std::vector<Vec3> directions;
  for (const ChosenView& view : result.choice.views) {
    directions.push_back(view.direction);
    result.views.push_back(
        describe_scored_view(shape, visibility, scorer, view.direction, frame, options, run));
  }
  result.tour = shortest_tour(directions, run);
  if (request.path == TourPath::Explore) {
    result.way = explored_way(*sphere, first, request, run);
  }
  return result;
}

std::vector<Camera> tour_cameras(const ShapeAnalysis& shape, const ReportedViewSet& set,
                                 const ScoringCamera& camera, UpAxis up, double aspect,
                                 std::size_t count, double margin_percent) {
  if (!(aspect > 0.0) || !std::isfinite(aspect) ||
      !(margin_percent >= 0.0 && margin_percent < 50.0)) {
    throw InvalidInput("a tour's pictures need an aspect above 0 and a margin in [0, 50) per cent");
  }
  std::vector<Vec3> stops;
  if (set.way) {
    stops = set.way->stops;
  } else {
    for (const std::size_t i : set.tour.order) {
      stops.push_back(set.choice.views[i].direction);
    }
  }
  const auto [points, margin] = framed_points(shape, margin_percent);
  const Vec3& centre = camera.sphere.centre;
  const Vec3 middle = shape.focus.empty() ? centre : enclosing_sphere(points).centre;
  const bool is_perspective = camera.projection == Projection::Perspective;
  double extent = 0.0;  // half the picture's height; perspective: over the distance
  const Room room = room_for(aspect, margin);
  std::vector<Camera> cameras;
  for (const TourPose& pose : tour_path(stops, up_vector(up), count)) {
    const Aim aim = shape.focus.empty() ? Aim{centre, pose.direction, pose.up, camera.distance()}
                                        : aim_at(middle, pose, camera);
    const Vec3 right = aim.up.cross(aim.back);
    for (const Vec3& p : points) {
      const Vec3 offset = p - aim.target;
      const double depth = is_perspective ? aim.distance - offset.dot(aim.back) : 1.0;
      const double reach =
          std::max(std::abs(offset.dot(right)) / room.x, std::abs(offset.dot(aim.up)) / room.y);
      extent = std::max(extent, reach / depth);
    }
    cameras.push_back({.projection = camera.projection,
                       .eye = aim.target + aim.distance * aim.back,
                       .target = aim.target,
                       .up = aim.up});
  }
  for (Camera& c : cameras) {
    c.fov_y_deg = 2.0 * std::atan(extent) * 180.0 / std::numbers::pi;
    c.height = 2.0 * extent;
  }
  return cameras;
}

}  // namespace vantage
