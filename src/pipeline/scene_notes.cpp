// SPDX-License-Identifier: MIT
#include "pipeline/scene_notes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <Eigen/Geometry>

#include "vantage/mesh/topology.h"
#include "vantage/spatial/directions.h"

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

/// How many parts show no vertex from any of some directions; 0 as soon as it is less than half.
std::size_t hidden_parts(const ShapeAnalysis& shape, const Parts& parts, std::size_t count,
                         const std::vector<Viewpoint>& eyes, const RunContext& run) {
  std::vector<std::uint8_t> is_hidden(parts.boxes.size());
  std::transform(parts.boxes.begin(), parts.boxes.end(), is_hidden.begin(),
                 [](const PartBox& box) { return box.isEmpty() ? 0 : 1; });
  std::vector<std::uint8_t> asked(parts.of_vertex.size());
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, eyes.size());
  std::size_t hidden = count;
  for (const Viewpoint& eye : eyes) {
    for (std::size_t v = 0; v < asked.size(); ++v) {
      asked[v] = is_hidden[parts.of_vertex[v]];
    }
    const auto seen = visibility->visible_among(asked, eye, run);
    for (std::size_t v = 0; v < seen.size(); ++v) {
      std::uint8_t& of_part = is_hidden[parts.of_vertex[v]];
      if (seen[v] != 0 && of_part != 0) {
        of_part = 0;
        --hidden;
      }
    }
    if (2 * hidden < count) {
      return 0;
    }
  }
  return hidden;
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

void note_parts_hardly_shown(const ShapeAnalysis& shape, const ScoringCamera& camera,
                             std::vector<std::string>& notes, const RunContext& run) {
  const Parts parts = parts_of(shape.surface);
  const auto count = static_cast<std::size_t>(std::count_if(
      parts.boxes.begin(), parts.boxes.end(), [](const PartBox& box) { return !box.isEmpty(); }));
  if (shape.cloud || !shape.focus.empty() || count < 2) {
    return;
  }
  const std::vector<Viewpoint> eyes =
      camera.viewpoints(direction_set(ViewSphereBase::Icosahedron, kHiddenLevel).directions);
  const std::size_t hidden = hidden_parts(shape, parts, count, eyes, run.quiet());
  if (hidden > 0) {
    notes.push_back(std::to_string(hidden) + " of " + std::to_string(count) +
                    " separate parts show no vertex from any of " + std::to_string(eyes.size()) +
                    " directions: others hide them from all views");
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
