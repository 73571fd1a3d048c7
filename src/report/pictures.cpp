// SPDX-License-Identifier: MIT
#include "vantage/render/colour_map.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

namespace vantage {
namespace {

/// Radius of the skeleton's tubes over D: thin enough for fingers, thick enough to see.
constexpr double kTubeRadius = 0.004;

/// What a picture shows, and in which colours.
class Canvas {
 public:
  /// Sets the size of `look`.
  Canvas(const ShapeAnalysis& shape, Picture picture, const ViewOptions& options,
         RenderOptions& look, const Model* asset)
      : mesh_(&shape.surface) {
    look.width = options.width;
    look.height = options.height;
    if (picture == Picture::Map) {
      colours_ = colour_map(shape.map.of_vertex);
    } else if (picture == Picture::Skeleton) {
      overlay_.graph = &shape.skeleton.graph;
      overlay_.radius = kTubeRadius * shape.sphere.diameter;
    } else if (asset != nullptr && !asset->mesh.triangles.empty()) {
      // The file's own faces: welding would mix colours and materials that meet at an edge.
      mesh_ = &asset->mesh;
      colours_ = asset->vertex_colours;
      appearance_ = &asset->appearance;
    }
  }

  [[nodiscard]] const TriMesh& mesh() const { return *mesh_; }

  [[nodiscard]] Paint paint() const { return {colours_, overlay_, appearance_}; }

 private:
  const TriMesh* mesh_;
  std::vector<Rgb8> colours_{};
  TubeOverlay overlay_{};
  const Appearance* appearance_ = nullptr;
};

}  // namespace

Image take_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, const std::optional<Rgb8>& background,
                   const RunContext& run) {
  RenderOptions look;
  set_quality(look, Quality::Normal);
  look.background = background;
  return draw_picture(shape, camera, picture, options, look, run);
}

std::vector<Image> take_pictures(const ShapeAnalysis& shape, const Camera& camera,
                                 std::span<const Picture> pictures, const ViewOptions& options,
                                 const RunContext& run) {
  RenderOptions look;
  set_quality(look, Quality::Normal);
  std::vector<Canvas> canvases;
  std::vector<Paint> paints;
  canvases.reserve(pictures.size());  // paints look into them
  for (const Picture picture : pictures) {
    canvases.emplace_back(shape, picture, options, look, nullptr);
    paints.push_back(canvases.back().paint());
  }
  return render_coats(shape.surface, camera, paints, look, run);
}

Image draw_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, RenderOptions look, const RunContext& run,
                   const Model* asset) {
  const Canvas canvas(shape, picture, options, look, asset);
  return render_painted(canvas.mesh(), camera, canvas.paint(), look, run);
}

DeepImage draw_picture_deep(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                            const ViewOptions& options, RenderOptions look, const RunContext& run,
                            const Model* asset) {
  const Canvas canvas(shape, picture, options, look, asset);
  return render_deep(canvas.mesh(), camera, canvas.paint(), look, run);
}

}  // namespace vantage
