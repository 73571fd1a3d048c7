// SPDX-License-Identifier: MIT
#include "pipeline/scene_notes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/spatial/directions.h"
#include "vantage/visibility/face_visibility.h"

#include "pipeline/percent.h"
#include "pipeline/view_preparation.h"

namespace vantage {
namespace {

using PartBox = Eigen::AlignedBox3d;

/// Of the shape's diameter: smaller is a speck in its pictures. [ours]
constexpr double kSpeck = 0.02;
/// Icosahedron level of the directions from which a hidden part is looked for. [ours]
constexpr int kHiddenLevel = 2;

/// The components of a surface by faces.
struct Parts {
  std::vector<std::uint32_t> of_vertex;
  std::vector<PartBox> boxes;
};

Parts parts_of(const TriMesh& surface) {
  Components components = connected_components(surface);
  Parts parts{std::move(components.of_vertex), std::vector<PartBox>(components.count)};
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t v : t) {
      parts.boxes[parts.of_vertex[v]].extend(surface.positions[v]);
    }
  }
  return parts;
}

/// How many parts show no vertex from any of some directions, nor a face if there are `faces`; 0 as soon
/// as it is less than half.
std::size_t hidden_parts(const ShapeAnalysis& shape, const Parts& parts, std::size_t count,
                         const std::vector<Viewpoint>& eyes, const FaceVisibility* faces,
                         const RunContext& run) {
  std::vector<std::uint8_t> is_hidden(parts.boxes.size());
  std::transform(parts.boxes.begin(), parts.boxes.end(), is_hidden.begin(),
                 [](const PartBox& box) { return box.isEmpty() ? 0 : 1; });
  std::vector<std::uint8_t> asked(parts.of_vertex.size());
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, eyes.size());
  std::size_t hidden = count;
  const auto show = [&](std::uint32_t vertex) {
    hidden -= std::exchange(is_hidden[parts.of_vertex[vertex]], std::uint8_t{0});
  };
  for (const Viewpoint& eye : eyes) {
    for (std::size_t v = 0; v < asked.size(); ++v) {
      asked[v] = is_hidden[parts.of_vertex[v]];
    }
    const auto seen = visibility->visible_among(asked, eye, run);
    for (std::uint32_t v = 0; v < seen.size(); ++v) {
      if (seen[v] != 0) {
        show(v);
      }
    }
    if (2 * hidden < count) {
      return 0;
    }
  }
  for (auto eye = eyes.begin(); faces != nullptr && 2 * hidden >= count && eye != eyes.end();
       ++eye) {
    for (const SeenFace& seen : faces->seen_faces(*eye, run)) {
      show(shape.surface.triangles[seen.face][0]);
    }
  }
  return 2 * hidden < count ? 0 : hidden;
}

/// Of the significance what specks hold that lie together in a place that is one, too.
double share_of_specks(const ShapeAnalysis& shape, const Parts& parts) {
  const double speck = kSpeck * shape.sphere.diameter;
  const auto is_speck = [&](const PartBox& box) { return box.diagonal().norm() < speck; };
  PartBox together;
  for (const PartBox& box : parts.boxes) {
    if (!box.isEmpty() && is_speck(box)) {
      together.extend(box);
    }
  }
  if (together.isEmpty() || !is_speck(together)) {
    return 0.0;
  }
  double all = 0.0;
  double of_specks = 0.0;
  for (std::size_t v = 0; v < parts.of_vertex.size(); ++v) {
    const PartBox& box = parts.boxes[parts.of_vertex[v]];
    all += shape.significance[v];
    of_specks += !box.isEmpty() && is_speck(box) ? shape.significance[v] : 0.0;
  }
  return all > 0.0 ? of_specks / all : 0.0;
}

}  // namespace

void note_parts_hardly_shown(const ShapeAnalysis& shape, const ViewOptions& options,
                             std::vector<std::string>& notes, const RunContext& run) {
  const Parts parts = parts_of(shape.surface);
  const auto count = static_cast<std::size_t>(std::count_if(
      parts.boxes.begin(), parts.boxes.end(), [](const PartBox& box) { return !box.isEmpty(); }));
  if (shape.cloud || !shape.focus.empty() || count < 2) {
    return;
  }
  const std::vector<Viewpoint> eyes =
      scoring_camera(shape, options)
          .viewpoints(direction_set(ViewSphereBase::Icosahedron, kHiddenLevel).directions);
  std::optional<FaceVisibility> faces;
  if (options.weight == Weight::Area) {
    faces.emplace(shape.surface, shape.sides);
  }
  const std::size_t hidden =
      hidden_parts(shape, parts, count, eyes, faces ? &*faces : nullptr, run.quiet());
  if (hidden > 0) {
    const std::string from = " from any of " + std::to_string(eyes.size()) + " directions";
    notes.push_back(std::to_string(hidden) + " of " + std::to_string(count) +
                    (faces ? " separate parts show nothing" + from + ": others hide them"
                           : " separate parts show no vertex" + from +
                                 ", so that no view counts them: others hide them or their "
                                 "ends; --weight area counts faces"));
  }
  constexpr double kMuch = 0.2;  // [ours]
  const double of_specks = share_of_specks(shape, parts);
  if (of_specks > kMuch) {
    notes.push_back(percent(of_specks) +
                    " of the significance is in a place that spans less than " + percent(kSpeck) +
                    " of the model: --focus frames one of its objects (vantage info lists them)");
  }
}

}  // namespace vantage
