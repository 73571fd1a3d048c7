// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/spatial/directions.h"
#include "vantage/view/channel.h"

#include "pipeline/describe_view.h"

namespace vantage {
namespace {

// The view set of measures built on the channel, and what its table may take. [ours]
constexpr int kChannelLevel = 3;
constexpr double kMostChannelBytes = 1024.0 * 1024.0 * 1024.0;
// Empty border of the tour's pictures, as frame_points() leaves it.
constexpr double kMargin = 0.04;

/// Views chosen on the channel from views to faces, as directions.
std::vector<Vec3> channel_views(const ShapeAnalysis& shape, const ScoringCamera& camera,
                                const ViewSetRequest& request, std::vector<std::string>& warnings,
                                const RunContext& run) {
  int level = kChannelLevel;
  // About half of the faces are seen, eight bytes each.
  while (level > 0 && 10.0 * std::ldexp(1.0, 2 * level) * 4.0 *
                              static_cast<double>(shape.surface.triangles.size()) >
                          kMostChannelBytes) {
    --level;
  }
  const std::vector<Vec3> directions = direction_set(ViewSphereBase::Icosahedron, level).directions;
  if (level < kChannelLevel) {
    warnings.push_back("the views were chosen from " + std::to_string(directions.size()) +
                       " directions instead of 642 to save memory");
  }
  std::vector<Viewpoint> eyes;
  eyes.reserve(directions.size());
  for (const Vec3& d : directions) {
    eyes.push_back(camera.viewpoint(d));
  }
  const FaceVisibility faces(shape.surface, shape.sides);
  const ViewChannel channel = channel_table(faces, shape.surface.triangles.size(), eyes, run);
  const std::size_t count =
      request.set.views ? static_cast<std::size_t>(*request.set.views) : directions.size();
  const std::vector<ChannelPick> picks =
      request.selection == ViewSelection::Vazquez
          ? greedy_entropy_views(channel, count, run)
          : merge_views(channel, count, request.information, run).picks;
  std::vector<Vec3> chosen;
  chosen.reserve(picks.size());
  for (const ChannelPick& pick : picks) {
    chosen.push_back(directions[pick.view]);
  }
  if (chosen.empty()) {
    chosen.push_back(directions.front());
    warnings.emplace_back(
        "no view sees more than one face, so the first of all directions is shown");
  }
  return chosen;
}

void warn_of(const ViewSet& set, const ViewSetRequest& request,
             std::vector<std::string>& warnings) {
  if (set.level < request.set.level) {
    warnings.push_back("the set's views were chosen from " + std::to_string(set.candidates) +
                       " directions to save memory");
  }
  const bool is_enough = request.set.coverage && set.stop == ViewSetStop::Coverage;
  if (request.set.views && static_cast<std::size_t>(*request.set.views) > set.views.size() &&
      !is_enough) {
    warnings.push_back(std::to_string(set.views.size()) + " of " +
                       std::to_string(*request.set.views) +
                       " views found: a further one would show nothing new" +
                       (request.set.min_separation_deg > 0.0 ? " or stand too near" : ""));
  } else if (set.stop == ViewSetStop::Exhausted) {
    warnings.emplace_back(
        request.selection == ViewSelection::Kssm
            ? "the coverage asked for is out of reach with views so far apart"
            : "the coverage asked for is out of reach: the views chosen see every "
              "face that is seen from one of the directions");
  }
}

}  // namespace

ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ScoringCamera& camera, const Vec3& best,
                              const ModelFrame& frame, const ViewOptions& options,
                              std::vector<std::string>& warnings, const RunContext& run) {
  const std::optional<FaceVisibility> faces = faces_to_score(shape, options);
  const ViewScorer scorer = faces ? ViewScorer(*faces, shape.map.of_vertex, camera)
                                  : ViewScorer(visibility, shape.map.of_vertex, camera);
  return find_view_set(shape, visibility, scorer, best, frame, options, warnings, run);
}

ReportedViewSet find_view_set(const ShapeAnalysis& shape, const VertexVisibility& visibility,
                              const ViewScorer& scorer, const Vec3& best, const ModelFrame& frame,
                              const ViewOptions& options, std::vector<std::string>& warnings,
                              const RunContext& run) {
  const ScoringCamera& camera = scorer.camera();
  const ViewSetRequest& request = options.view_set.value();
  check_fields(request, kViewSetRequestFields);
  const auto select = [&](const auto& visible) {
    return select_views(visible, scorer.shares(), camera, best, request.set, run);
  };
  const auto measure = [&](const auto& visible, const std::vector<Vec3>& chosen) {
    return measure_views(visible, scorer.shares(), camera, chosen, request.set, run.part(0.3, 1.0));
  };
  const FaceVisibility* faces = scorer.faces();
  ReportedViewSet result;
  if (request.selection == ViewSelection::Kssm) {
    result.choice = faces != nullptr ? select(*faces) : select(visibility);
  } else {
    const std::vector<Vec3> chosen =
        channel_views(shape, camera, request, warnings, run.part(0.0, 0.3));
    result.choice = faces != nullptr ? measure(*faces, chosen) : measure(visibility, chosen);
  }
  warn_of(result.choice, request, warnings);
  std::vector<Vec3> directions;
  for (const ChosenView& view : result.choice.views) {
    directions.push_back(view.direction);
    result.views.push_back(
        describe_scored_view(shape, visibility, scorer, view.direction, frame, options));
  }
  if (faces != nullptr) {  // sets know what is seen of a face to an eighth; nothing was seen before
    result.choice.views.front().gain = result.views.front().score;
  }
  result.tour = shortest_tour(directions, run);
  return result;
}

std::vector<Camera> tour_cameras(const ShapeAnalysis& shape, const ReportedViewSet& set,
                                 const ScoringCamera& camera, UpAxis up, double aspect,
                                 std::size_t count) {
  std::vector<Vec3> stops;
  for (const std::size_t i : set.tour.order) {
    stops.push_back(set.choice.views[i].direction);
  }
  const std::vector<Vec3> points = referenced_points(shape.surface);
  const Vec3& centre = camera.sphere.centre;
  const double distance = camera.distance();
  const bool is_perspective = camera.projection == Projection::Perspective;
  double extent = 0.0;  // half the picture's height; perspective: over the distance
  std::vector<Camera> cameras;
  for (const TourPose& pose : tour_path(stops, up_vector(up), count)) {
    const Vec3 right = pose.up.cross(pose.direction);
    for (const Vec3& p : points) {
      const Vec3 offset = p - centre;
      const double depth = is_perspective ? distance - offset.dot(pose.direction) : 1.0;
      const double reach =
          std::max(std::abs(offset.dot(right)) / aspect, std::abs(offset.dot(pose.up)));
      extent = std::max(extent, reach / depth);
    }
    cameras.push_back({.projection = camera.projection,
                       .eye = centre + distance * pose.direction,
                       .target = centre,
                       .up = pose.up});
  }
  // The border is a part of the shorter side.
  extent /= 1.0 - 2.0 * kMargin * std::min(1.0, aspect) / std::max(1.0, aspect);
  for (Camera& c : cameras) {
    c.fov_y_deg = 2.0 * std::atan(extent) * 180.0 / std::numbers::pi;
    c.height = 2.0 * extent;
  }
  return cameras;
}

}  // namespace vantage
