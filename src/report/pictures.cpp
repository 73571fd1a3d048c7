// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "vantage/io/write.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "core/parallel.h"
#include "pipeline/required_steps.h"
#include "report/cloud_picture.h"
#include "report/legend.h"

namespace vantage {
namespace {

/// Radius of the skeleton's tubes over D: thin enough for fingers, thick enough to see.
constexpr double kTubeRadius = 0.004;
/// Most pictures that are kept to be made smaller: those of the report's views, and some more.
constexpr std::size_t kMostKept = 32;

bool is_same(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.projection == b.projection &&
         a.fov_y_deg == b.fov_y_deg && a.height == b.height;
}

/// Whether a picture of that size has the image's aspect, but for rounding to pixels.
bool has_aspect_of(const Image& image, int width, int height) {
  const std::int64_t off = std::int64_t{image.width} * height - std::int64_t{image.height} * width;
  return 2 * std::abs(off) <= std::int64_t{image.width} + image.height;
}

/// What a picture shows, and in which colours.
class Canvas {
 public:
  /// Sets the size of `look`. \param cloud cloud_picture() of the shape, which must outlive this.
  Canvas(const ShapeAnalysis& shape, const CloudPicture* cloud, Picture picture,
         const ViewOptions& options, RenderOptions& look, const Model* asset)
      : mesh_(cloud != nullptr ? &cloud->mesh : &shape.surface) {
    look.width = options.width;
    look.height = options.height;
    if (picture == Picture::Map) {
      require_map(shape);
      values_ = shape.significance;
      if (cloud != nullptr) {
        spread_ = cloud->spread(values_);
        values_ = spread_;
      }
    } else if (picture == Picture::Skeleton) {
      require_skeleton(shape);
      overlay_.graph = &shape.skeleton.graph;
      overlay_.radius = kTubeRadius * shape.sphere.diameter;
    } else if (asset != nullptr && !asset->mesh.triangles.empty()) {
      // The file's own faces: welding would mix colours and materials that meet at an edge.
      mesh_ = &asset->mesh;
      colours_ = asset->vertex_colours;
      appearance_ = &asset->appearance;
    } else if (asset != nullptr) {
      colours_ = colours_shown(shape, cloud, asset->vertex_colours);
    }
  }

  [[nodiscard]] const TriMesh& mesh() const { return *mesh_; }

  [[nodiscard]] Paint paint() const {
    return {.vertex_colours = colours_,
            .overlay = overlay_,
            .appearance = appearance_,
            .vertex_values = values_};
  }

 private:
  const TriMesh* mesh_;
  std::vector<Rgb8> colours_{};
  std::span<const double> values_{};
  std::vector<double> spread_{};  // what they look into, if not the shape's own
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

PictureLook PictureLook::on(const Rgb8& background) const {
  PictureLook look = *this;
  if (!look.render.background) {
    look.render.background = background;
  }
  return look;
}

ShapePictures::ShapePictures(const ShapeAnalysis& shape, const PictureLook& look)
    : shape_(&shape), look_(look), cloud_(cloud_picture(shape)) {
  const Model* asset = look.asset;
  const bool is_plain = asset == nullptr || asset->mesh.triangles.empty() ||
                        (asset->vertex_colours.empty() && asset->appearance.materials.empty());
  look_.asset = is_plain ? nullptr : asset;
  if (asset != nullptr && asset->mesh.triangles.empty()) {
    point_colours_ = colours_shown(shape, cloud_.get(), asset->vertex_colours);
  }
}

const PictureSurface& ShapePictures::surface(const RunContext& run) {
  if (!surface_) {
    surface_.emplace(cloud_ ? cloud_->mesh : shape_->surface, nullptr, look_.render.crease_deg,
                     run);
  }
  return *surface_;
}

const PictureSurface& ShapePictures::asset_surface(const RunContext& run) {
  if (!asset_surface_) {
    asset_surface_.emplace(look_.asset->mesh, &look_.asset->appearance, look_.render.crease_deg,
                           run);
  }
  return *asset_surface_;
}

std::vector<Image> ShapePictures::take(const Camera& camera, std::span<const Picture> pictures,
                                       const ViewOptions& options,
                                       const std::optional<Rgb8>& background,
                                       const RunContext& run) {
  RenderOptions look = look_.render;
  look.width = options.width;
  look.height = options.height;
  if (background) {
    look.background = background;
    look.background_bottom.reset();
  }
  std::vector<Canvas> canvases;
  std::vector<Paint> paints;
  canvases.reserve(pictures.size());  // paints look into them
  for (const Picture picture : pictures) {
    if (picture != Picture::Plain || look_.asset == nullptr) {
      canvases.emplace_back(*shape_, cloud_.get(), picture, options, look, nullptr);
      paints.push_back(canvases.back().paint());
      if (picture == Picture::Plain) {
        paints.back().vertex_colours = point_colours_;
      }
    }
  }
  std::vector<Image> painted;
  if (!paints.empty()) {
    painted = surface(run).render(camera, paints, look, run);
  }
  std::vector<Image> images;
  auto next = painted.begin();
  for (const Picture picture : pictures) {
    const bool is_asset = picture == Picture::Plain && look_.asset != nullptr;
    images.push_back(is_asset ? take_plain(camera, look, run) : std::move(*next++));
    if (picture == Picture::Map) {
      draw_legend(images.back());
    }
    if (picture == Picture::Plain && !background) {
      keep_plain(camera, images.back());
    }
  }
  return images;
}

void ShapePictures::keep_plain(const Camera& camera, const Image& image) {
  plain_.emplace_back(camera, image);
  if (plain_.size() > kMostKept) {
    plain_.erase(plain_.begin());
  }
}

Image ShapePictures::take_small(const Camera& camera, int width, int height,
                                const ViewOptions& options, const RunContext& run) {
  const auto taken = std::find_if(plain_.rbegin(), plain_.rend(), [&](const auto& kept) {
    const auto& [of, image] = kept;
    return is_same(of, camera) && image.width >= width && image.height >= height &&
           has_aspect_of(image, width, height);
  });
  if (taken != plain_.rend()) {
    return smaller_picture(taken->second, width, height, run);
  }
  ViewOptions small = options;
  small.width = width;
  small.height = height;
  constexpr std::array kPlain{Picture::Plain};
  return take(camera, kPlain, small, {}, run).front();
}

Image ShapePictures::take_plain(const Camera& camera, const RenderOptions& look,
                                const RunContext& run) {
  if (look_.asset != nullptr) {
    const Paint own{.vertex_colours = look_.asset->vertex_colours,
                    .appearance = &look_.asset->appearance};
    return std::move(asset_surface(run).render(camera, std::span(&own, 1), look, run).front());
  }
  const Paint clay{.vertex_colours = point_colours_};
  return std::move(surface(run).render(camera, std::span(&clay, 1), look, run).front());
}

std::vector<std::string> png_files(std::span<const Image> images, const RunContext& run) {
  std::vector<std::string> files(images.size());
  parallel_for(run, images.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      files[i] = png_bytes(images[i]);
    }
  });
  return files;
}

Image draw_picture(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                   const ViewOptions& options, RenderOptions look, const RunContext& run,
                   const Model* asset) {
  const std::shared_ptr<const CloudPicture> cloud = cloud_picture(shape);
  const Canvas canvas(shape, cloud.get(), picture, options, look, asset);
  Image image = render_painted(canvas.mesh(), camera, canvas.paint(), look, run);
  if (picture == Picture::Map) {
    draw_legend(image);
  }
  return image;
}

DeepImage draw_picture_deep(const ShapeAnalysis& shape, const Camera& camera, Picture picture,
                            const ViewOptions& options, RenderOptions look, const RunContext& run,
                            const Model* asset) {
  const std::shared_ptr<const CloudPicture> cloud = cloud_picture(shape);
  const Canvas canvas(shape, cloud.get(), picture, options, look, asset);
  DeepImage image = render_deep(canvas.mesh(), camera, canvas.paint(), look, run);
  if (picture == Picture::Map) {
    draw_legend(image);
  }
  return image;
}

}  // namespace vantage
