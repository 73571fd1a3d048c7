// SPDX-License-Identifier: MIT
#include "vantage/report/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "vantage/mesh/measures.h"
#include "vantage/pipeline/find_views.h"
#include "vantage/pipeline/measured_shape.h"
#include "vantage/render/render.h"
#include "vantage/report/view_report.h"

#include "pipeline/view_preparation.h"
#include "report/cloud_picture.h"
#include "report/legend.h"
#include "report/panels.h"
#include "report/point_balls.h"
#include "report/search_figure.h"
#include "report/sphere_figure.h"

namespace vantage {
namespace {

/// Panels of a sequence of levels; more are too small to compare. [ours]
constexpr std::size_t kMostLevels = 6;
/// Contracted surfaces are drawn thicker by this share of D on all sides, lest limbs that have become
/// lines vanish between the samples. [ours]
constexpr double kThickening = 0.004;
constexpr Rgb8 kPaper{255, 255, 255};
constexpr std::array kPlain{Picture::Plain};

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
  Panels(const ShapeAnalysis& shape, const ReportedView& view, const ViewOptions& options,
         RunContext run, const PictureLook& look)
      : shape_(&shape),
        camera_(camera_for(view, {options.width, options.height})),
        run_(std::move(run)),
        normals_(vertex_normals(shape.surface)),
        look_(look.render),
        asset_(look.asset),
        cloud_(cloud_picture(shape)) {
    run_.report = nullptr;
    look_.width = options.width;
    look_.height = options.height;
  }

  [[nodiscard]] Image plain(Picture picture, const ViewOptions& options) const {
    return draw_picture(*shape_, camera_, picture, options, look_, run_, asset_);
  }

  /// The surface at a level of its contraction, in the colours of a field if there is one.
  [[nodiscard]] Image level(std::size_t level, std::span<const double> field) const {
    if (shape_->cloud) {
      return points(shape_->history.levels[level], field);
    }
    TriMesh mesh = shape_->surface;
    mesh.positions = shape_->history.levels[level];
    for (std::size_t v = 0; level > 0 && v < normals_.size(); ++v) {
      mesh.positions[v] += kThickening * shape_->sphere.diameter * normals_[v];
    }
    return coloured(mesh, field);
  }

  /// The surface in the colours of a field.
  [[nodiscard]] Image field(std::span<const double> values) const {
    return cloud_ ? coloured(cloud_->mesh, cloud_->spread(values))
                  : coloured(shape_->surface, values);
  }

 private:
  [[nodiscard]] Image points(std::span<const Vec3> positions, std::span<const double> field) const {
    const PointBalls balls = point_balls(positions, kPointRadius * shape_->sphere.diameter);
    std::vector<double> values;
    for (std::size_t v = 0; !field.empty() && v < balls.point_of_vertex.size(); ++v) {
      values.push_back(field[balls.point_of_vertex[v]]);
    }
    return coloured(balls.mesh, values);
  }

  [[nodiscard]] Image coloured(const TriMesh& mesh, std::span<const double> field) const {
    if (field.empty()) {
      return render(mesh, camera_, {}, {}, look_, run_);
    }
    Image picture = render_painted(mesh, camera_, {.vertex_values = field}, look_, run_);
    draw_legend(picture);
    return picture;
  }

  const ShapeAnalysis* shape_;
  Camera camera_;
  RunContext run_;
  std::vector<Vec3> normals_;
  RenderOptions look_;
  const Model* asset_;
  std::shared_ptr<const CloudPicture> cloud_;
};

/// The same shape with another map.
ShapeAnalysis with_map(ShapeAnalysis shape, std::vector<double> map) {
  shape.significance = std::move(map);
  return shape;
}

/// What mesh saliency makes of the shape.
struct SaliencyView {
  std::vector<double> map;  ///< In full.
  ShapeAnalysis shape;      ///< With the map as it is shown.
  ViewReport report;
};

/// Saliency has few very high values, beside which all else would be blue: past this share of the
/// vertices everything is red. [ours]
constexpr double kShownShare = 0.98;

void clip_for_colours(std::vector<double>& values) {
  std::vector<double> sorted = values;
  const auto last = static_cast<std::ptrdiff_t>(kShownShare * static_cast<double>(sorted.size()));
  const auto place = sorted.begin() + std::min<std::ptrdiff_t>(last, std::ssize(sorted) - 1);
  std::nth_element(sorted.begin(), place, sorted.end());
  const double most = *place;
  for (double& value : values) {
    value = std::min(value, most);
  }
}

SaliencyView saliency_view(const ShapeAnalysis& shape, const ViewReport& report,
                           const ViewOptions& options, const RunContext& run) {
  const std::string method = "mesh-saliency";
  ViewOptions other = options;
  other.method = method;
  other.view_set.reset();
  SaliencyView result{vertex_map(shape, options, method, run.part(0.0, 0.3)), {}, {}};
  result.shape = with_map(shape, result.map);
  result.report = find_views(result.shape, {report.up, report.front}, other, run.part(0.3, 1.0));
  clip_for_colours(result.shape.significance);
  return result;
}

/// Half of figures 7 and 8: a view that a method chose, plain and with its map.
void add_choice(std::vector<Image>& panels, const Panels& of, const ViewOptions& options,
                const std::string& kind, const std::string& method, double share) {
  panels.push_back(
      with_caption(of.plain(Picture::Plain, options),
                   kind + " by " + method + ": sees " + percent_text(share) + " of it"));
  panels.push_back(with_caption(of.plain(Picture::Map, options), method));
}

/// Figures 1, 2 and 3; the last panel is the map.
std::vector<Figure> sequences(const ShapeAnalysis& shape, const Panels& best, const Image& map,
                              Kinematics kinematics, const RunContext& run) {
  std::vector<Image> contraction;
  std::vector<Image> displacement;
  std::vector<Image> shares;
  const std::vector<std::size_t> levels = chosen_levels(shape.history.level_count());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    run.advance("figures", static_cast<double>(i) / static_cast<double>(levels.size()));
    const std::string level = "level " + std::to_string(levels[i]);
    contraction.push_back(with_caption(best.level(levels[i], {}), level));
    displacement.push_back(
        with_caption(best.level(levels[i], shape.kssm.displacement[levels[i]]), level));
    std::vector<double> summand = level_summand(shape.surface, shape.kssm, levels[i], kinematics);
    for (std::size_t v = 0; v < summand.size(); ++v) {
      summand[v] = shape.significance[v] > 0.0 ? summand[v] : 0.0;  // what is out of focus is 0
    }
    shares.push_back(with_caption(best.field(summand), level));
  }
  shares.push_back(with_caption(map, "KSSM, the sum of all levels"));
  return {{"figure-1-contraction", side_by_side(contraction), {}},
          {"figure-2-displacement", side_by_side(displacement), {}},
          {"figure-3-levels", side_by_side(shares), {}}};
}

/// Figure 6. \param saliency null: KSSM alone.
Figure sphere_figure(const ShapeAnalysis& shape, const SaliencyView* saliency,
                     const ViewReport& report, const ViewOptions& options, RenderOptions look,
                     const RunContext& run) {
  look.width = options.width;
  look.height = options.height;
  const auto panel = [&](const ShapeAnalysis& of, const std::vector<double>& shown,
                         const char* name) {
    return with_caption(
        sphere_panel(of, shown, report.best.direction, report.up, options, look, run),
        std::string(name) + " seen from each direction");
  };
  std::vector<Image> panels{panel(shape, shape.significance, "KSSM")};
  if (saliency != nullptr) {
    panels.push_back(
        panel(with_map(shape, saliency->map), saliency->shape.significance, "mesh saliency"));
  }
  return {"figure-6-spheres", side_by_side(panels), {}};
}

Figure rapid_figure(const ShapeAnalysis& shape, const ViewOptions& options, const RunContext& run) {
  const std::shared_ptr<const VertexVisibility> visibility = visibility_of(shape, 200);
  const MapScorer by_map(shape, *visibility, options);
  const ViewScorer& scorer = by_map.scorer();
  const RunContext quiet = run.quiet();
  const ScoreBatch score = [&](const std::vector<Vec3>& directions) {
    return scorer.score_all(directions, quiet);
  };
  const SearchOptions search = preset_options(Preset::Paper).search;
  const FoundView found = search_view({score, scorer.total()}, Goal::Best, search, quiet);
  const LineDrawing drawing =
      search_figure(found.trace, search.base, Goal::Best, scorer.total(), options.height);
  return {"figure-4-search", drawing.image(), drawing.svg()};
}

}  // namespace

Image side_by_side(const std::vector<Image>& panels) {
  return in_rows(panels, panels.size());
}

Image view_sheet(const ShapeAnalysis& shape, const ReportedViewSet& set, const ViewOptions& options,
                 const RunContext& run, const PictureLook& look) {
  ShapePictures pictures(shape, look.on(kPaper));
  std::vector<Image> panels;
  const auto count = static_cast<double>(set.views.size());
  for (std::size_t i = 0; i < set.views.size(); ++i) {
    run.advance("pictures", static_cast<double>(i) / count);
    const ReportedView& view = set.views[i];
    const ChosenView& chosen = set.choice.views[i];
    const RunContext quiet = run.quiet();
    const Camera camera = camera_for(view, {options.width, options.height});
    // Shares of what can be seen at all.
    const double before = i == 0 ? 0.0 : set.choice.views[i - 1].coverage;
    panels.push_back(
        with_caption(pictures.take(camera, kPlain, options, {}, quiet).front(),
                     std::to_string(i + 1) + ": " +
                         (i == 0 ? percent_text(chosen.coverage)
                                 : percent_text(chosen.coverage - before) + " more, together " +
                                       percent_text(chosen.coverage))));
  }
  run.advance("pictures", 1.0);
  return in_rows(panels, static_cast<std::size_t>(std::ceil(std::sqrt(count))));
}

std::vector<Figure> paper_figures(const ShapeAnalysis& shape, const ViewReport& report,
                                  const ViewOptions& options, const RunContext& run,
                                  const PictureLook& look) {
  const PictureLook white = look.on(kPaper);
  const Panels best(shape, report.best, options, run, white);
  const Panels worst(shape, report.worst, options, run, white);
  const Image map = best.plain(Picture::Map, options);
  std::vector<Figure> figures =
      sequences(shape, best, map, options.kssm.kinematics, run.part(0.0, 0.5));
  std::optional<SaliencyView> saliency;
  if (!shape.cloud) {  // mesh saliency is of curvature, which points do not have
    saliency = saliency_view(shape, report, options, run.part(0.5, 0.7));
  }
  const RunContext quiet = run.quiet();
  figures.push_back(rapid_figure(shape, options, quiet));
  run.advance("figures", 0.8);
  figures.push_back(
      {"figure-5-skeleton",
       side_by_side({with_caption(best.plain(Picture::Plain, options), "model"),
                     with_caption(map, "KSSM"),
                     with_caption(best.plain(Picture::Skeleton, options), "skeleton")}),
       {}});
  figures.push_back(
      sphere_figure(shape, saliency ? &*saliency : nullptr, report, options, white.render, quiet));
  run.advance("figures", 0.9);
  const auto add_choices = [&](const char* name, const char* kind, const Panels& kssm,
                               ReportedView ViewReport::*view) {
    std::vector<Image> panels;
    add_choice(panels, kssm, options, kind, "KSSM", (report.*view).score_fraction);
    if (saliency) {
      const ReportedView& theirs = saliency->report.*view;
      add_choice(panels, Panels(saliency->shape, theirs, options, run, white), options, kind,
                 "mesh saliency", theirs.score_fraction);
    }
    figures.push_back({name, side_by_side(panels), {}});
  };
  add_choices("figure-7-best", "best", best, &ViewReport::best);
  add_choices("figure-8-worst", "worst", worst, &ViewReport::worst);
  if (report.set) {
    figures.push_back({"views", view_sheet(shape, *report.set, options, quiet, look), {}});
  }
  run.advance("figures", 1.0);
  return figures;
}

}  // namespace vantage
