// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "vantage/core/error.h"
#include "vantage/mesh/measures.h"
#include "vantage/render/colour_map.h"
#include "vantage/render/render.h"

namespace vantage {
namespace {

/// Panels of a sequence of levels; more are too small to compare. [ours]
constexpr std::size_t kMostLevels = 6;
constexpr int kGapPx = 8;
/// Contracted surfaces are drawn thicker by this share of D on all sides, lest limbs that have become
/// lines vanish between the samples. [ours]
constexpr double kThickening = 0.004;

/// Level 0, the last level, and evenly between them.
std::vector<std::size_t> chosen_levels(std::size_t last) {
  const std::size_t count = std::min(kMostLevels, last + 1);
  std::vector<std::size_t> levels;
  for (std::size_t i = 0; i < count; ++i) {
    levels.push_back(count == 1 ? 0 : (2 * i * last + count - 1) / (2 * (count - 1)));
  }
  return levels;
}

/// Unit normals of the vertices, weighted by area; zero where faces cancel out.
std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
  for (const Triangle& triangle : mesh.triangles) {
    const Vec3 area = area_vector(mesh, triangle);
    for (const std::uint32_t v : triangle) {
      normals[v] += area;
    }
  }
  for (Vec3& normal : normals) {
    const double length = normal.norm();
    normal = length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
  }
  return normals;
}

/// What all panels of a figure share.
class Panels {
 public:
  Panels(const ShapeAnalysis& shape, const Camera& camera, const ViewOptions& options,
         RunContext run)
      : shape_(&shape),
        camera_(&camera),
        run_(std::move(run)),
        normals_(vertex_normals(shape.surface)) {
    run_.report = nullptr;
    set_quality(look_, Quality::Normal);
    look_.width = options.width;
    look_.height = options.height;
    look_.background = Rgb8{255, 255, 255};
  }

  [[nodiscard]] Image plain(Picture picture, const ViewOptions& options) const {
    return draw_picture(*shape_, *camera_, picture, options, look_, run_);
  }

  /// The surface at a level of its contraction, in the colours of a field if there is one.
  [[nodiscard]] Image level(std::size_t level, std::span<const double> field) const {
    TriMesh mesh = shape_->surface;
    mesh.positions = shape_->history.levels[level];
    for (std::size_t v = 0; level > 0 && v < normals_.size(); ++v) {
      mesh.positions[v] += kThickening * shape_->sphere.diameter * normals_[v];
    }
    return render(mesh, *camera_, colours(field), {}, look_, run_);
  }

  /// The surface in the colours of a field.
  [[nodiscard]] Image field(std::span<const double> values) const {
    return render(shape_->surface, *camera_, colours(values), {}, look_, run_);
  }

 private:
  static std::vector<Rgb8> colours(std::span<const double> field) {
    return field.empty() ? std::vector<Rgb8>{} : colour_map(field);
  }

  const ShapeAnalysis* shape_;
  const Camera* camera_;
  RunContext run_;
  std::vector<Vec3> normals_;
  RenderOptions look_{};
};

/// What a level adds to the map: its displacement from 0 to 1, lowered by the level's factor.
std::vector<double> share_of_level(const KssmMap& map, std::size_t level) {
  std::vector<double> values = map.displacement[level];
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  const double low = *least;
  const double span = *largest - low;
  for (double& value : values) {
    value = span > 0.0 ? map.level_factor[level] * (value - low) / span : 0.0;
  }
  return values;
}

}  // namespace

Image side_by_side(const std::vector<Image>& panels) {
  if (panels.empty()) {
    throw InvalidInput("a figure needs a panel");
  }
  const int width = panels.front().width;
  const int height = panels.front().height;
  Image figure;
  figure.width = static_cast<int>(panels.size()) * (width + kGapPx) + kGapPx;
  figure.height = height + 2 * kGapPx;
  figure.rgba.assign(
      4 * static_cast<std::size_t>(figure.width) * static_cast<std::size_t>(figure.height), 255);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels[i].width != width || panels[i].height != height) {
      throw InvalidInput("the panels of a figure must be of one size");
    }
    const int left = kGapPx + static_cast<int>(i) * (width + kGapPx);
    for (int y = 0; y < height; ++y) {
      const auto at = figure.pixel(left, kGapPx + y) - figure.rgba.data();
      std::copy_n(panels[i].pixel(0, y), std::size_t{4} * static_cast<std::size_t>(width),
                  figure.rgba.begin() + at);
    }
  }
  return figure;
}

std::vector<Figure> paper_figures(const ShapeAnalysis& shape, const ViewReport& report,
                                  const ViewOptions& options, const RunContext& run) {
  if (shape.cloud) {
    throw InvalidInput("the paper's figures need a surface, and the model has points only");
  }
  const Panels best(shape, report.best.picture, options, run);
  const Panels worst(shape, report.worst.picture, options, run);
  std::vector<Image> contraction;
  std::vector<Image> displacement;
  std::vector<Image> shares;
  const std::vector<std::size_t> levels = chosen_levels(shape.history.level_count());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    run.advance("figures", 0.8 * static_cast<double>(i) / static_cast<double>(levels.size()));
    contraction.push_back(best.level(levels[i], {}));
    displacement.push_back(best.level(levels[i], shape.map.displacement[levels[i]]));
    shares.push_back(best.field(share_of_level(shape.map, levels[i])));
  }
  shares.push_back(best.plain(Picture::Map, options));
  run.advance("figures", 0.8);
  std::vector<Figure> figures;
  figures.push_back({"figure-1-contraction", side_by_side(contraction)});
  figures.push_back({"figure-2-displacement", side_by_side(displacement)});
  figures.push_back({"figure-3-levels", side_by_side(shares)});
  figures.push_back(
      {"figure-5-skeleton", side_by_side({best.plain(Picture::Plain, options), shares.back(),
                                          best.plain(Picture::Skeleton, options)})});
  figures.push_back(
      {"figure-7-best", side_by_side({best.plain(Picture::Plain, options), shares.back()})});
  figures.push_back({"figure-8-worst", side_by_side({worst.plain(Picture::Plain, options),
                                                     worst.plain(Picture::Map, options)})});
  run.advance("figures", 1.0);
  return figures;
}

}  // namespace vantage
